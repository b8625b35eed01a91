#pragma once

#include <vector>

#include "saker/core/rng.h"
#include "saker/detection/detection.h"

/// Clusters and scans of known truth.
namespace saker::detection::testing {

struct MadeBox {
  double x = 0, y = 0, yaw = 0;
  double length = 4.5, width = 1.8, height = 1.5;
  double z = 0;  ///< of its bottom
};

/// Whether a box stands between a sensor and a point.
bool hides(const MadeBox& box, const Eigen::Vector3d& sensor, const Eigen::Vector3d& point);

/// Points on those sides of the box that a sensor sees, the roof too where it stands higher.
std::vector<Eigen::Vector3d> visible_box(const MadeBox& box, const Eigen::Vector3d& sensor,
                                         int points, double noise, core::Rng& rng);

/// The half of a cylinder's surface that faces the sensor.
std::vector<Eigen::Vector3d> visible_cylinder(const Eigen::Vector3d& root,
                                              const Eigen::Vector3d& axis, double radius,
                                              double height, const Eigen::Vector3d& sensor,
                                              int points, double noise, core::Rng& rng);

/// Beams from one place that meet the ground, but where a box hides it, and whatever else was hit.
Beams ground_beams(const Eigen::Vector3d& sensor, const std::vector<MadeBox>& boxes, int beams,
                   const std::vector<Eigen::Vector3d>& hits = {});

/// Points in the world, with their class, to a scan.
struct SceneBuilder {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint8_t> classes;
  std::vector<float> probability;  ///< of the classes
  std::vector<MadeBox> solids;     ///< the ground behind them is not seen

  void add(const std::vector<Eigen::Vector3d>& more, std::uint8_t class_id,
           float class_probability = 0.9f);
  /// A plane z = slope · x under the whole scene.
  void add_ground(double slope, double half, core::Rng& rng);
  [[nodiscard]] LabelledScan scan(double seconds, const SE3& T_odom_lidar) const;
};

}  // namespace saker::detection::testing
