#pragma once

#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/odometry/voxel_map.h"

namespace saker::odometry {

struct RegistrationConfig {
  int max_iterations = 20;
  double stop_m = 2e-4;
  double stop_rad = 1e-5;
  double keep_planes_m = 0.01;
  double noise_m = 0.02;
  double least_kernel_m = 0.06;
  double correlation = 4;
  double plane_correlation = 32;
  int min_inliers = 60;
  double min_inlier_ratio = 0.05;
  double max_rms_m = 0.15;
  double max_deviation_sd = 6;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("max_iterations", max_iterations, {1, 200}, "", "most Gauss-Newton steps");
    v.field("stop_m", stop_m, {1e-7, 0.1}, "m",
            "a step shorter than this ends it: a tenth of the noise of a pose");
    v.field("stop_rad", stop_rad, {1e-8, 0.1}, "rad", "and turned by less than this");
    v.field("keep_planes_m", keep_planes_m, {0, 0.5}, "m",
            "points that moved less, in the mean, keep their planes: a fraction of a voxel");
    v.field("noise_m", noise_m, {0.001, 0.5}, "m",
            "sd of a range; a plane's own thickness is added");
    v.field("least_kernel_m", least_kernel_m, {0.005, 2}, "m",
            "least width of the robust kernel: three times the noise");
    v.field("correlation", correlation, {1, 1000}, "",
            "points per independent residual: neighbours share their plane's error");
    v.field("plane_correlation", plane_correlation, {1, 1000}, "",
            "points per independent one of those that a plane was fitted to: each scan leaves some "
            "ten in a voxel, with one error of its pose");
    v.field("min_inliers", min_inliers, {6, 1e5}, "",
            "fewer points on planes of the map: not registered");
    v.field("min_inlier_ratio", min_inlier_ratio, {0, 1}, "",
            "a smaller share of the points: not registered");
    v.field("max_rms_m", max_rms_m, {0.01, 2}, "m",
            "inliers farther from their planes in the mean: not registered");
    v.field("max_deviation_sd", max_deviation_sd, {1, 100}, "",
            "farther from the prediction, in its standard deviations: not registered");
  }
};

/// The pose before the scan is looked at: N(pose, covariance), tangent [rotation, translation],
/// right.
struct PosePrior {
  SE3 T_odom_lidar = SE3::Identity();
  Matrix6d covariance = Matrix6d::Constant(NAN);
};

struct RegistrationResult {
  SE3 T_odom_lidar = SE3::Identity();
  Matrix6d covariance = Matrix6d::Constant(NAN);  ///< right tangent
  Matrix6d held_covariance =
      Matrix6d::Constant(NAN);  ///< without what noise of normals seems to hold
  int iterations = 0;
  int inliers = 0;          ///< points on a plane, with at least half their weight
  int established = 0;      ///< of these, on planes first seen before the time given
  double rms_m = 0;         ///< of the inliers' distances to their planes
  double deviation_sd = 0;  ///< from the prior, Mahalanobis, per root of dimension
  bool converged = false;
};

/// Point-to-plane ICP with a prior: the pose that maximises N(prior) · Π robust N(distance to the
/// map's plane | 0, σ²). In directions that the planes leave open the prior decides, and the
/// covariance says so. σ² is the noise of both and what the plane's normal may be off by at the
/// point's distance from its middle (Yuan et al., "VoxelMap", RA-L 2022, sec. III): over bare
/// ground, where little but the normals holds the pose sideways, the scan slipped without it.
///
/// Gauss-Newton; Geman-McClure weights, their width from the median distance of the last step
/// (Huber, "Robust Statistics", sec. 5.1), closing in from the gate. The planes of the points are
/// looked up again as long as steps are long. Cost: points × a hash look-up for each long step.
///
/// Noisy normals seem to hold what nothing holds: along smooth walls J Jᵀ sums up their errors
/// alone. `held_covariance` counts what is left of the information without the expected share of
/// these errors, direction by direction (Hatleskog and Alexis, "Probabilistic Degeneracy Detection
/// for Point-to-Plane Error Minimization", RA-L 2024; bias-compensated least squares). The pose and
/// the filter keep all of it: over bare ground they drift twice as far without.
class Registration {
 public:
  explicit Registration(const RegistrationConfig& config) : config_(config) {}

  /// Points in the lidar frame, finite; `start` is where the search begins; planes first seen
  /// before `established` are counted apart.
  [[nodiscard]] RegistrationResult align(std::span<const Eigen::Vector3d> points,
                                         const PosePrior& prior, const SE3& start, VoxelMap& map,
                                         double gate_m, Time established = 0);

  /// Whether so many points can be registered at all.
  [[nodiscard]] bool enough(std::size_t points) const {
    return points >= static_cast<std::size_t>(config_.min_inliers);
  }

  [[nodiscard]] bool trustworthy(const RegistrationResult& result, std::size_t points) const;

 private:
  struct NormalEquations {
    Matrix6d H = Matrix6d::Zero();
    Matrix6d of_tilt = Matrix6d::Zero();  ///< expected part of H by errors of the normals
    Vector6d g = Vector6d::Zero();
    double chi2 = 0;
    double weights = 0;
    double square_sum = 0;
    int inliers = 0;
    int established = 0;
  };

  /// A point in the lidar frame and the plane it should lie on.
  struct Match {
    Eigen::Vector3d point;
    Plane plane;
  };

  void associate(std::span<const Eigen::Vector3d> points, const SE3& T, VoxelMap& map, bool wide);
  [[nodiscard]] NormalEquations linearise(const SE3& T, double gate_m, double kernel_m,
                                          bool with_tilt = false);
  [[nodiscard]] double next_kernel(double gate_m);
  [[nodiscard]] double inflation_of(const NormalEquations& sum) const;
  [[nodiscard]] Matrix6d held_covariance(const NormalEquations& sum,
                                         const Matrix6d& prior_information) const;

  RegistrationConfig config_;
  std::vector<Match> matches_;
  Time established_ = 0;
  std::vector<float> distances_;
};

}  // namespace saker::odometry
