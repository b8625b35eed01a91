#include "saker/detection/detection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "saker/detection/local_frame.h"

namespace saker::detection {
namespace {

Eigen::Vector3d mean_of(const std::vector<ClassPoint>& points, const std::vector<int>& indices) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int i : indices) sum += points[i].position.cast<double>();
  return sum / static_cast<double>(indices.size());
}

/// Of the points that have one; NaN where none has.
double mean_reflectivity(const std::vector<ClassPoint>& points, const std::vector<int>& indices) {
  double sum = 0;
  int count = 0;
  for (const int i : indices) {
    if (!std::isfinite(points[i].reflectivity)) continue;
    sum += points[i].reflectivity;
    ++count;
  }
  return count > 0 ? sum / count : NAN;
}

std::vector<Eigen::Vector3d> moved(const SE3& T, const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector3d> result;
  for (const Eigen::Vector3d& p : points) result.push_back(T * p);
  return result;
}

}  // namespace

Detection::Detection(const DetectionConfig& config, const objects::ClassTable& table)
    : config_(core::checked(config, "detection")),
      table_(table),
      kinds_(vehicle_kinds(table)),
      fitter_(make_fitter(config.vehicle, kinds_)),
      ground_(config.ground),
      surroundings_(config.surroundings) {}

objects::Detections Detection::detect(std::span<const LabelledScan> window) {
  objects::Detections result;
  if (window.empty()) return result;
  result.stamp = window.back().stamp;
  gather(window, table_, config_.window, window_);
  ground_.fit(window_.ground, window_.cuboids, config_.window.range_m);
  surroundings_.fill(window_.others, config_.window.other_stride, ground_);
  beams_.fill(window_);
  detect_vehicles(result);
  detect_trunks(result);
  for (const objects::GroundPlane& plane : ground_.planes()) {
    result.ground.push_back(transformed(window_.T_lidar_level, plane));
  }
  return result;
}

void Detection::detect_vehicles(objects::Detections& result) {
  keep_above_ground(window_.cuboids, config_.vehicle.lowest_m, config_.vehicle.highest_m);
  for (const Indices& cluster : clusters(window_.cuboids, nullptr, config_.vehicle_clusters)) {
    add_vehicle(cluster, 0, result);
  }
}

void Detection::detect_trunks(objects::Detections& result) {
  keep_above_ground(window_.cylinders, config_.trunk.lowest_m, config_.trunk.highest_m);
  for (const Indices& cluster : clusters(window_.cylinders, nullptr, config_.trunk_clusters)) {
    add_trunk(cluster, result);
  }
}

void Detection::keep_above_ground(std::vector<ClassPoint>& points, double lowest,
                                  double highest) const {
  std::erase_if(points, [&](const ClassPoint& point) {
    const Eigen::Vector3d p = point.position.cast<double>();
    const objects::GroundPlane* ground = ground_.at(p);
    if (!ground) return true;
    const double height = ground->height_of(p);
    return height < lowest || height > highest;
  });
}

/// Clusters of all points, or of some, as indices of `points`.
std::vector<Detection::Indices> Detection::clusters(const std::vector<ClassPoint>& points,
                                                    const Indices* of,
                                                    const ClusterConfig& config) {
  places_.clear();
  const std::size_t count = of ? of->size() : points.size();
  for (std::size_t i = 0; i < count; ++i) {
    places_.push_back(points[of ? (*of)[i] : i].position.head<2>());
  }
  std::vector<Indices> found = clusters_.find(places_, config);
  if (!of) return found;
  for (Indices& cluster : found) {
    for (int& i : cluster) i = (*of)[i];
  }
  return found;
}

bool Detection::seen_often(const std::vector<ClassPoint>& points, const Indices& indices) const {
  std::vector<char> seen(window_.sensors.size(), 0);
  for (const int i : indices) seen[points[i].scan] = 1;
  const auto count = static_cast<double>(std::count(seen.begin(), seen.end(), 1));
  return count >= config_.least_scan_share * static_cast<double>(seen.size());
}

/// Compares with the object's own points between the same heights.
bool Detection::stands_free(const Indices& indices, const objects::Cylinder& cylinder) const {
  const SurroundingsConfig& c = config_.surroundings;
  int own = 0;
  for (const int i : indices) {
    const double height = window_.cylinders[i].position.z() - cylinder.root.z();
    own += height >= c.lowest_m && height <= c.highest_m ? 1 : 0;
  }
  const int around = surroundings_.around(cylinder.root.head<2>().cast<float>(), cylinder.radius);
  return around <= c.most_share * own;
}

void Detection::add_vehicle(const Indices& indices, int splits, objects::Detections& result) {
  if (!seen_often(window_.cuboids, indices)) return;
  const Eigen::Vector3d middle = mean_of(window_.cuboids, indices);
  const objects::GroundPlane* ground = ground_.at(middle);
  if (!ground) return;
  const SE3 T_level_local = local_frame(*ground, middle);
  const SE3 T_local_level = T_level_local.inverse();
  std::vector<BodyPoint> points;
  points.reserve(indices.size());
  for (const int i : indices) {
    const ClassPoint& p = window_.cuboids[i];
    points.push_back({(T_local_level * p.position.cast<double>()).cast<float>(),
                      static_cast<float>(window_.seconds[p.scan])});
  }
  const Sight sight{moved(T_local_level, window_.sensors), beams_, surroundings_, T_level_local};
  const VehicleFit fit = fit_vehicle(points, sight, *fitter_, config_.vehicle, kinds_);
  if (fit.status == VehicleStatus::too_large || fit.status == VehicleStatus::parted) {
    split_vehicle(indices, splits, result);
  }
  if (fit.status != VehicleStatus::fitted) return;
  const int others = surroundings_.inside(transformed(T_level_local, fit.cuboid));
  objects::Measurement m = classified(class_probability({window_.cuboids, indices, others}),
                                      static_cast<int>(indices.size()), result.stamp);
  m.model = transformed(window_.T_lidar_level * T_level_local, fit.cuboid);
  m.covariance = fit.covariance;
  m.front_log_odds = fit.front_log_odds;
  m.reflectivity = mean_reflectivity(window_.cuboids, indices);
  m.moving = fit.motion.moving;
  result.measurements.push_back(std::move(m));
}

void Detection::split_vehicle(const Indices& indices, int splits, objects::Detections& result) {
  if (splits >= config_.most_splits) return;
  ClusterConfig finer = config_.vehicle_clusters;
  for (int i = 0; i <= splits; ++i) finer.reach_m *= config_.split_ratio;
  for (const Indices& part : clusters(window_.cuboids, &indices, finer)) {
    add_vehicle(part, splits + 1, result);
  }
}

void Detection::add_trunk(const Indices& indices, objects::Detections& result) {
  if (!seen_often(window_.cylinders, indices)) return;
  const Eigen::Vector3d middle = mean_of(window_.cylinders, indices);
  const objects::GroundPlane* ground = ground_.at(middle);
  if (!ground) return;
  const SE3 T_level_local = local_frame(*ground, middle);
  const SE3 T_local_level = T_level_local.inverse();
  std::vector<Eigen::Vector3d> points;
  points.reserve(indices.size());
  for (const int i : indices) {
    points.push_back(T_local_level * window_.cylinders[i].position.cast<double>());
  }
  const TrunkFit fit = fit_trunk(points, T_local_level * window_.sensors.front(), config_.trunk);
  if (fit.status != TrunkStatus::fitted) return;
  const objects::Cylinder cylinder = transformed(T_level_local, fit.cylinder);
  if (!stands_free(indices, cylinder)) return;
  const SE3 T_lidar_local = window_.T_lidar_level * T_level_local;
  const int own = static_cast<int>(indices.size());
  std::vector<double> probability =
      class_probability({window_.cylinders, indices, surroundings_.inside(cylinder)});
  weigh_crown(surroundings_.crown_odds(cylinder, own), probability);
  objects::Measurement m = classified(std::move(probability), own, result.stamp);
  m.model = transformed(T_lidar_local, fit.cylinder);
  m.covariance = rotated(fit.covariance, T_lidar_local.linear(), fit.cylinder.axis);
  m.reflectivity = mean_reflectivity(window_.cylinders, indices);
  result.measurements.push_back(std::move(m));
}

objects::Measurement Detection::classified(std::vector<double> class_probability, int points,
                                           Time stamp) const {
  objects::Measurement m;
  m.stamp = stamp;
  m.points = points;
  m.class_probability = std::move(class_probability);
  m.class_id = static_cast<objects::ClassId>(
      std::max_element(m.class_probability.begin(), m.class_probability.end()) -
      m.class_probability.begin());
  return m;
}

void Detection::weigh_crown(double odds, std::vector<double>& class_probability) const {
  double sum = 0;
  for (std::size_t id = 0; id < class_probability.size(); ++id) {
    const objects::ObjectClass& c = table_.classes[id];
    if (c.shape == objects::Shape::cylinder) {
      class_probability[id] *= c.crowned ? std::sqrt(odds) : 1 / std::sqrt(odds);
    }
    sum += class_probability[id];
  }
  for (double& p : class_probability) p /= sum;
}

/// Mean over the points inside the model (paper, "Uncertainty modeling"), those of no object (class
/// 0) included; what a label leaves is spread over the other classes.
std::vector<double> Detection::class_probability(const Inside& inside) const {
  std::vector<double> sum(table_.classes.size(), 0);
  double rest = 0;
  for (const int i : inside.indices) {
    const double p = inside.points[i].probability;
    const double share = (1 - p) / std::max(table_.size() - 1, 1);
    sum[inside.points[i].class_id] += p - share;
    rest += share;
  }
  sum[0] += inside.others;
  const double count = static_cast<double>(inside.indices.size()) + inside.others;
  for (double& p : sum) p = (p + rest) / count;
  return sum;
}

}  // namespace saker::detection
