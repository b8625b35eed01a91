#include "tools/saker/evaluate/window_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "saker/core/statistics.h"

namespace saker::tools {
namespace {

constexpr double kWithin_m = 1.5;
constexpr double kLeastPoints = 100, kFarthest_m = 30;
constexpr std::array<double, 4> kRanges = {0, 10, 20, kFarthest_m};  // m, edges of the cells
constexpr std::array<double, 4> kAngles = {0, 15, 75, 90};  // degrees; the middle: two faces

/// A label of a scan with its vehicle's size.
struct Box {
  const VehicleLabel* label;
  Eigen::Vector2d size;
};

std::map<std::size_t, std::vector<Box>> boxes_by_scan(const LabelledVehicles& labelled) {
  std::map<std::size_t, std::vector<Box>> boxes;
  for (const auto& [track, vehicle] : labelled.tracks) {
    for (const VehicleLabel& label : vehicle.labels) {
      if (label.points < kLeastPoints || label.position.head<2>().norm() > kFarthest_m) continue;
      boxes[label.scan].push_back({&label, vehicle.size.head<2>()});
    }
  }
  return boxes;
}

/// Measured vehicles by the scan whose stamp is theirs, to 1 ms.
std::map<std::size_t, std::vector<const objects::Cuboid*>> measured_by_scan(
    std::span<const objects::Measurement> measurements, const objects::ClassTable& table,
    const std::vector<StampedPose>& poses) {
  std::map<std::size_t, std::vector<const objects::Cuboid*>> measured;
  for (const objects::Measurement& m : measurements) {
    const StampedPose* pose = pose_at(poses, to_seconds(m.stamp));
    if (pose == nullptr || table[m.class_id].shape != objects::Shape::cuboid) continue;
    measured[static_cast<std::size_t>(pose - poses.data())].push_back(
        &std::get<objects::Cuboid>(m.model));
  }
  return measured;
}

/// From the lidar at the origin of the label's frame.
double angle_deg(const VehicleLabel& label) {
  const double towards = std::atan2(-label.position.y(), -label.position.x()) - label.yaw;
  return std::atan2(std::abs(std::sin(towards)), std::abs(std::cos(towards))) * 180 /
         std::numbers::pi;
}

WindowResult result_of(const Box& box, const std::vector<const objects::Cuboid*>& measured) {
  WindowResult result;
  result.range_m = box.label->position.head<2>().norm();
  result.angle_deg = angle_deg(*box.label);
  result.size = box.size;
  double nearest = kWithin_m;
  for (const objects::Cuboid* cuboid : measured) {
    const Eigen::Vector3d off = cuboid->pose.translation() - box.label->position;
    if (off.head<2>().norm() >= nearest) continue;
    nearest = off.head<2>().norm();
    result.error = cuboid->size.head<2>() - box.size;
  }
  return result;
}

/// A figure of nothing is null.
nlohmann::ordered_json rounded_or_null(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::nearbyint(value * 1e4) / 1e4;
}

/// Of the windows that measured the vehicle.
struct Sums {
  int labelled = 0;
  std::vector<double> length, width, of_box;

  void add(const WindowResult& window, const Eigen::Vector2d& box) {
    ++labelled;
    if (!window.error.allFinite()) return;
    length.push_back(window.error[0]);
    width.push_back(window.error[1]);
    const Eigen::Vector2d error = box - window.size;
    of_box.insert(of_box.end(), {error[0], error[1]});
  }

  [[nodiscard]] nlohmann::ordered_json json() const {
    return {{"labelled", labelled},
            {"measured", length.size()},
            {"length_mae_m", rounded_or_null(core::mean_absolute(length))},
            {"width_mae_m", rounded_or_null(core::mean_absolute(width))},
            {"size_mae_m",
             rounded_or_null(0.5 * (core::mean_absolute(length) + core::mean_absolute(width)))},
            {"length_bias_m", rounded_or_null(core::mean(length))},
            {"width_bias_m", rounded_or_null(core::mean(width))},
            {"box_size_mae_m", rounded_or_null(core::mean_absolute(of_box))}};
  }
};

std::size_t cell_of(double value, const std::array<double, 4>& edges) {
  const auto above = std::ranges::upper_bound(edges.begin() + 1, edges.end() - 1, value);
  return static_cast<std::size_t>(above - edges.begin()) - 1;
}

}  // namespace

std::vector<WindowResult> window_results(std::span<const objects::Measurement> measurements,
                                         const objects::ClassTable& table,
                                         const std::vector<StampedPose>& poses,
                                         const LabelledVehicles& labelled) {
  const auto boxes = boxes_by_scan(labelled);
  std::vector<WindowResult> results;
  for (const auto& [scan, measured] : measured_by_scan(measurements, table, poses)) {
    const auto of_scan = boxes.find(scan);
    if (of_scan == boxes.end()) continue;
    for (const Box& box : of_scan->second) results.push_back(result_of(box, measured));
  }
  return results;
}

nlohmann::ordered_json window_json(std::span<const WindowResult> windows,
                                   const Eigen::Vector2d& box) {
  Sums all;
  std::map<std::pair<std::size_t, std::size_t>, Sums> cells;
  for (const WindowResult& window : windows) {
    all.add(window, box);
    cells[{cell_of(window.range_m, kRanges), cell_of(window.angle_deg, kAngles)}].add(window, box);
  }
  nlohmann::ordered_json figures = all.json();
  figures["cells"] = nlohmann::ordered_json::array();
  for (const auto& [at, sums] : cells) {
    nlohmann::ordered_json cell = {{"range_m", {kRanges[at.first], kRanges[at.first + 1]}},
                                   {"angle_deg", {kAngles[at.second], kAngles[at.second + 1]}}};
    cell.update(sums.json());
    figures["cells"].push_back(cell);
  }
  return figures;
}

}  // namespace saker::tools
