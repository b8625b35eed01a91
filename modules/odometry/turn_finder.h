#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/odometry/turn.h"
#include "saker/odometry/voxel_index.h"
#include "saker/odometry/voxel_map.h"

namespace saker::odometry {

struct TurnFinderConfig {
  double noise_m = 0.02;
  double kernel_m = 0.06;
  double correlation = 4;
  double least_gain = 500;
  double least_share = 0.08;
  int least_scans = 8;
  double least_contradiction = 0.3;
  int trial_scans = 40;
  double compensated_sd = 0.003;
  double longest_period_s = 0.13;
  double usual_period_s = 0.1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("noise_m", noise_m, {0.001, 0.5}, "m", "sd of a range");
    v.field("kernel_m", kernel_m, {0.005, 2}, "m", "width of the robust kernel");
    v.field("correlation", correlation, {1, 1000}, "",
            "points per independent residual: neighbours share their plane's error");
    v.field("least_gain", least_gain, {1, 1e6}, "",
            "of the log-likelihood, twice, until a turn is believed: its beginning is then known "
            "to 15°; "
            "compensated scans reach 300 by errors of planes and angles");
    v.field("least_share", least_share, {0, 1}, "",
            "of the sweep that is seen: poses and planes hide most of it, 0.1 to 0.3 remain; of "
            "compensated scans 0.05 is seen");
    v.field("least_scans", least_scans, {1, 1000}, "", "that moved, until a turn is believed");
    v.field(
        "least_contradiction", least_contradiction, {0, 1}, "",
        "share of the opposite turn at which a turn is dropped: scans that had been compensated "
        "show 0.5 to 0.9 of it, others at most 0.15");
    v.field("trial_scans", trial_scans, {1, 1000}, "", "so long a turn is on trial");
    v.field("compensated_sd", compensated_sd, {0.0001, 1}, "",
            "sd of the share at which scans without a turn count as compensated");
    v.field("longest_period_s", longest_period_s, {0.01, 2}, "s",
            "between scans: a longer one leaves scans out");
    v.field("usual_period_s", usual_period_s, {0.01, 2}, "s",
            "of a sweep, where scans are left out");
  }
};

/// Finds how a sensor turns from scans that move and have no times of points.
///
/// Reads registered scans, before and as they go into the local map. A sweep that moves by the
/// twist V in a period, of which the point i is measured at the part t(φ) after its middle, by its
/// azimuth φ, puts the point p wrong by −t(φ) u, u = v + ω × p. Map planes are means of such points
/// of earlier scans, seen at other azimuths. So a point's distance to its plane with the normal n
/// is
///
///     r = −nᵀ u t(φ) + mean over the plane's points of nᵀ u′ t(φ′) + J ξ + noise,
///
/// J ξ being what an error of the pose makes of it. With t = Σ a_k f_k(φ), f_k = cos φ, sin φ, …
/// sin 3φ (a constant is a shift of the pose), this is linear in a: each voxel keeps the mean of
/// u′ f_k(φ′), and the normal equations of a, with ξ eliminated in each scan, add up. A turn is the
/// sawtooth of a direction and a beginning, t(φ) = −Σ_k sin k(φ_passed) / (πk); the share c of it
/// that explains most is sought over 2 × 72 of them. Earlier poses and robust weights hide a part
/// of the skew, which shrinks c and not its sign: of scans that were compensated or taken at one
/// instant c is at most 0.05, of those that were skewed 0.1 to 1.
/// Cost: a hash look-up a point and 25 MB, until the answer is known.
class TurnFinder {
 public:
  /// \param voxel_m, most_voxels  of the local map
  TurnFinder(const TurnFinderConfig& config, double voxel_m, int most_voxels);

  /// A registered scan's points in the lidar frame and their azimuths; `twist` is the motion in a
  /// period, `map` what was seen before.
  void compare(std::span<const Eigen::Vector3d> points, std::span<const float> azimuths,
               const SE3& T_odom_lidar, const Vector6d& twist, double period_s, VoxelMap& map);

  /// The points that go into the map after that.
  void insert(std::span<const Eigen::Vector3d> points, std::span<const float> azimuths,
              const SE3& T_odom_lidar, const Vector6d& twist);

  /// The map of the scans that were inserted is gone.
  void clear_map();

  /// Time of a sweep where scans are so far apart, s.
  [[nodiscard]] double period_of(double seconds) const;

  /// The median of those of the scans that were compared, s.
  [[nodiscard]] double usual_period_s() const;

  struct Answer {
    Turn turn;
    double share = 0;  ///< c
    double sd = 0;     ///< of c
    double gain = 0;   ///< (c / sd)²
  };
  [[nodiscard]] Answer best() const;

  /// The answer, where it is significant.
  [[nodiscard]] std::optional<Turn> found() const;

  /// Scans with times by this turn are skewed the other way: they had been compensated.
  [[nodiscard]] bool contradicts(const Turn& turn) const;

  /// That moved and were compared; at most 1000 are counted.
  [[nodiscard]] int scans() const { return static_cast<int>(periods_s_.size()); }

  /// No turn is seen where one would be.
  [[nodiscard]] bool compensated() const;

  static constexpr int kHarmonics = 3;
  static constexpr int kTerms = 2 * kHarmonics;
  using Terms = Eigen::Matrix<double, kTerms, 1>;

 private:
  using Moved = Eigen::Matrix<float, 3, kTerms>;  // u f_k
  struct Voxel {
    Moved sum = Moved::Zero();
    int count = 0;
  };
  struct Match {
    Eigen::Vector3d point, normal;  // in the lidar frame
    Terms sensitivity;              // of the distance to a
    double distance = 0;
    double variance = 0;
  };

  void match(const Eigen::Vector3d& point, float azimuth, const SE3& T_odom_lidar,
             const Vector6d& twist, VoxelMap& map);
  [[nodiscard]] Answer answer(const Turn& turn) const;

  TurnFinderConfig config_;
  double voxel_m_;
  VoxelIndex index_;
  std::vector<Voxel> voxels_;
  std::vector<Match> matches_;
  Eigen::Matrix<double, kTerms, kTerms> information_ =
      Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Terms weighted_ = Terms::Zero();
  std::vector<double> periods_s_;  // of the scans that were compared
};

}  // namespace saker::odometry
