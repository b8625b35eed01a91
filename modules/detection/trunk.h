#pragma once

#include <vector>

#include "saker/core/config.h"
#include "saker/detection/cylinder_fit.h"
#include "saker/objects/measurement.h"

/// The virtual sensor of trunks and poles: a cluster's points to a cylinder with covariance, its
/// root on the local ground. Refuses what leans, is too thick, too short, or floats.
namespace saker::detection {

struct TrunkConfig {
  int least_points = 12;
  double lowest_m = 0.15;
  double highest_m = 12;
  double least_height_m = 1.0;
  double most_gap_m = 1.5;
  double least_radius_m = 0.02;
  double most_radius_m = 0.5;
  double least_slenderness = 3;
  double most_lean_deg = 20;
  double most_residual_m = 0.12;
  double ground_m = 0.06;
  double pose_m = 0.03;
  CylinderFitConfig fit;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("least_points", least_points, {3, 100000}, "points", "fewer are refused");
    v.field("lowest_m", lowest_m, {-1, 5}, "m",
            "points lower above the ground are left out: grass");
    v.field("highest_m", highest_m, {0.5, 50}, "m", "points higher are left out: the crown");
    v.field("least_height_m", least_height_m, {0.1, 20}, "m", "a shorter piece is refused");
    v.field("most_gap_m", most_gap_m, {0, 10}, "m",
            "between the ground and the lowest point; what floats higher is refused");
    v.field("least_radius_m", least_radius_m, {0.001, 1}, "m", "a thinner one is refused");
    v.field("most_radius_m", most_radius_m, {0.01, 5}, "m", "a thicker one is refused");
    v.field("least_slenderness", least_slenderness, {0, 100}, "",
            "of the height that was seen to the diameter: a pier between two windows is stouter");
    v.field("most_lean_deg", most_lean_deg, {1, 80}, "deg", "off the ground's normal");
    v.field("most_residual_m", most_residual_m, {0.01, 1}, "m",
            "root mean square distance to the surface; more is no cylinder");
    v.field("ground_m", ground_m, {0.001, 2}, "m",
            "standard deviation of the local ground's height: of the root along the axis");
    v.field("pose_m", pose_m, {0, 1}, "m",
            "standard deviation of the root in x-y that no number of points reduces: odometry "
            "within the window");
    v.group("fit", fit, "cylinder");
  }
};

enum class TrunkStatus { fitted, too_few, too_short, floats, leans, no_cylinder };

struct TrunkFit {
  TrunkStatus status = TrunkStatus::too_few;
  objects::Cylinder cylinder;                     ///< local ground's frame
  Matrix6d covariance = Matrix6d::Constant(NAN);  ///< [root, axis, radius], same frame
};

/// \param points in the local ground's frame, z = 0 the ground
[[nodiscard]] TrunkFit fit_trunk(const std::vector<Eigen::Vector3d>& points,
                                 const Eigen::Vector3d& sensor, const TrunkConfig& config);

/// The same covariance where the axis is rotated: the tangent basis belongs to the axis's frame.
[[nodiscard]] Matrix6d rotated(const Matrix6d& covariance, const Eigen::Matrix3d& R_b_a,
                               const Eigen::Vector3d& axis_in_a);

}  // namespace saker::detection
