#include "saker/detection/window.h"

#include <algorithm>

namespace saker::detection {
namespace {

bool usable(const LabelledScan& scan) {
  return scan.points && scan.labels && scan.T_odom_lidar.matrix().allFinite() &&
         scan.labels->classes.size() == scan.points->size() &&
         scan.labels->probability.size() == scan.points->size();
}

/// The shape of each class; a label outside the table is no object.
std::vector<objects::Shape> shapes_of(const objects::ClassTable& table) {
  std::vector<objects::Shape> shapes(256, objects::Shape::none);
  for (int i = 0; i < table.size(); ++i) shapes[i] = table.classes[i].shape;
  return shapes;
}

class Gatherer {
 public:
  Gatherer(const objects::ClassTable& table, const WindowConfig& config, Window& window)
      : config_(config),
        shapes_(shapes_of(table)),
        range_squared_(static_cast<float>(config.range_m * config.range_m)),
        most_(static_cast<std::size_t>(config.most_points)),
        window_(window) {}

  void add(const LabelledScan& scan, const SE3& T_level_lidar) {
    const Eigen::Matrix3f R = T_level_lidar.linear().cast<float>();
    const Eigen::Vector3f t = T_level_lidar.translation().cast<float>();
    const auto& points = *scan.points;
    const bool reflective = scan.reflectivity && scan.reflectivity->size() == points.size();
    const auto index = static_cast<std::uint16_t>(window_.sensors.size() - 1);
    for (std::size_t i = 0; i < points.size(); i += config_.beam_stride) {
      if (in_range(points[i])) window_.beams.push_back({R * points[i] + t, index});
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const objects::Shape shape = shapes_[scan.labels->classes[i]];
      const bool other = shape == objects::Shape::none, ground = shape == objects::Shape::plane;
      if (other && ++others_seen_ % config_.other_stride != 0) continue;
      if (ground && ++ground_seen_ % config_.ground_stride != 0) continue;
      if (!in_range(points[i])) continue;
      const Eigen::Vector3f position = R * points[i] + t;
      if (other) {
        if (window_.others.size() < most_) window_.others.push_back(position);
      } else if (ground) {
        window_.ground.push_back(position);
      } else {
        add_object(shape, {position, scan.labels->probability[i], scan.labels->classes[i], index,
                           reflective ? (*scan.reflectivity)[i] : NAN});
      }
    }
  }

 private:
  /// False of what is not finite.
  [[nodiscard]] bool in_range(const Eigen::Vector3f& point) const {
    return point.squaredNorm() <= range_squared_;
  }

  void add_object(objects::Shape shape, ClassPoint point) {
    if (!(point.probability >= config_.least_probability)) return;
    point.probability = std::min(point.probability, 1.0f);
    auto& points = shape == objects::Shape::cuboid ? window_.cuboids : window_.cylinders;
    if (points.size() >= most_) return;
    points.push_back(point);
  }

  WindowConfig config_;
  std::vector<objects::Shape> shapes_;
  float range_squared_;
  std::size_t most_;
  int ground_seen_ = 0;
  int others_seen_ = 0;
  Window& window_;
};

}  // namespace

void gather(std::span<const LabelledScan> scans, const objects::ClassTable& table,
            const WindowConfig& config, Window& window) {
  window.sensors.clear();
  window.seconds.clear();
  window.cuboids.clear();
  window.cylinders.clear();
  window.ground.clear();
  window.others.clear();
  window.beams.clear();
  if (scans.empty() || !scans.back().T_odom_lidar.matrix().allFinite()) return;
  SE3 T_odom_level = SE3::Identity();
  T_odom_level.translation() = scans.back().T_odom_lidar.translation();
  window.T_lidar_level = scans.back().T_odom_lidar.inverse() * T_odom_level;
  Gatherer gatherer(table, config, window);
  // The newest first: where there are too many points, the oldest are left out.
  for (auto scan = scans.rbegin(); scan != scans.rend(); ++scan) {
    if (!usable(*scan)) continue;
    const SE3 T_level_lidar = T_odom_level.inverse() * scan->T_odom_lidar;
    window.sensors.emplace_back(T_level_lidar * scan->sensor);
    window.seconds.push_back(to_seconds(scan->stamp - scans.back().stamp));
    gatherer.add(*scan, T_level_lidar);
  }
}

}  // namespace saker::detection
