#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "saker/objects/measurement.h"
#include "tools/saker/evaluate/vehicle_figures.h"
#include "tools/saker/replay/trajectory_truth.h"

/// Single windows against labelled boxes. Reads what was measured of vehicles in each window
/// (detections.jsonl) and the labels of its last scan; makes the errors of length and width by
/// range and by the angle from which the vehicle was seen. Method: a measurement is of the nearest
/// labelled vehicle within 1.5 m; labels with fewer than 100 points or beyond 30 m do not count.
namespace saker::tools {

/// Of one labelled vehicle in one window; errors are measured − labelled, m.
struct WindowResult {
  double range_m = 0;
  double angle_deg = 0;                            ///< 0: along the vehicle's length, 90: across it
  Eigen::Vector2d size = Eigen::Vector2d::Zero();  ///< labelled length and width, m
  Eigen::Vector2d error = Eigen::Vector2d::Constant(NAN);  ///< NaN where nothing was measured
};

/// \param poses  of every scan, in their order
[[nodiscard]] std::vector<WindowResult> window_results(
    std::span<const objects::Measurement> measurements, const objects::ClassTable& table,
    const std::vector<StampedPose>& poses, const LabelledVehicles& labelled);

/// Mean absolute errors of all windows and of each cell of range and angle, beside those of one
/// constant box. \param box  length and width, m
[[nodiscard]] nlohmann::ordered_json window_json(std::span<const WindowResult> windows,
                                                 const Eigen::Vector2d& box);

}  // namespace saker::tools
