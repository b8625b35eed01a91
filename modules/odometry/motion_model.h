#pragma once

#include <optional>
#include <span>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/lidar/scan.h"
#include "saker/odometry/inertial_filter.h"
#include "saker/odometry/registration.h"
#include "saker/odometry/sweep.h"

namespace saker::odometry {

struct MotionConfig {
  double initial_speed_mps = 8;
  double initial_rate_rps = 1;
  double acceleration_mps2 = 5;
  double angular_acceleration_rps2 = 5;
  double max_coast_s = 1;
  InertialConfig inertial;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("initial_speed_mps", initial_speed_mps, {0.01, 100}, "m/s",
            "sd of the speed before the first two scans");
    v.field("initial_rate_rps", initial_rate_rps, {0.01, 20}, "rad/s",
            "sd of the turn rate before the first two scans");
    v.field("acceleration_mps2", acceleration_mps2, {0.01, 200}, "m/s²",
            "sd of the acceleration between scans, where no IMU measures it: a multirotor's");
    v.field("angular_acceleration_rps2", angular_acceleration_rps2, {0.01, 500}, "rad/s²",
            "the same of the turn");
    v.field("max_coast_s", max_coast_s, {0, 60}, "s",
            "so long the last twist is taken to go on where no IMU measures the motion");
    v.group("inertial", inertial, "the inertial unit");
  }
};

/// Where the lidar is expected at a moment. Covariances: tangent [rotation, translation], right.
struct Prediction {
  Time moment = 0;
  double seconds = 0;  ///< since the moment of the last registered scan
  PosePrior prior;
  /// What the motion since the last scan, registered or not, adds.
  Matrix6d motion_covariance = Matrix6d::Constant(NAN);
  std::optional<InertialFilter> inertial;  ///< there, when the IMU covers the motion
};

/// The lidar's motion from scan to scan, at a moment in each: by the inertial unit, its velocity
/// and biases learnt from the poses that registration found, or where there is none by a constant
/// twist, that within a scan changes as fast as it did over the last two intervals. The covariance
/// grows with time since the last registration, and in directions that registration leaves open:
/// there the inertial unit decides. Scans that are not registered are bridged by the inertial unit
/// until it knows less than that a multirotor does not fly faster than `initial_speed_mps`.
class MotionModel {
 public:
  explicit MotionModel(const MotionConfig& config);

  void start(Time moment, const SE3& T_odom_lidar);

  [[nodiscard]] Prediction predict(Time moment, std::span<const lidar::ImuSample> imu) const;

  /// The same without the inertial unit, for one that contradicts what the scans show.
  [[nodiscard]] Prediction predict_without_imu(Time moment) const;

  /// The same had no more than the usual interval passed since the last registered scan: where
  /// stamps say that it was longer and no inertial sample proves it, the clock may have stepped.
  [[nodiscard]] std::optional<Prediction> predict_stepped(
      Time moment, std::span<const lidar::ImuSample> imu) const;

  /// The motion during a scan of length `span` in whose middle, the prediction's moment, the lidar
  /// is at `T_odom_lidar`.
  [[nodiscard]] Sweep sweep(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                            std::span<const lidar::ImuSample> imu) const;

  /// The same of the scan before, taken to have moved as from it to `T_odom_lidar` in `seconds`.
  [[nodiscard]] Sweep sweep_before(const SE3& T_odom_lidar, double seconds, Time span,
                                   std::span<const lidar::ImuSample> imu) const;

  /// What the way from the middle of a scan of length `span` to its end adds to a registered pose
  /// where the turn was not measured for longer than usual; tangent at the end.
  [[nodiscard]] Matrix6d half_sweep_covariance(const Prediction& prediction, Time span) const;

  void accept(const Prediction& prediction, const SE3& T_odom_lidar, const Matrix6d& covariance);
  void coast(const Prediction& prediction);

  [[nodiscard]] Time moment() const { return moment_; }
  [[nodiscard]] const SE3& T_odom_lidar() const { return T_odom_lidar_; }
  [[nodiscard]] double usual_interval_s() const { return usual_interval_s_; }
  [[nodiscard]] const InertialFilter& inertial() const { return inertial_; }

 private:
  [[nodiscard]] Prediction by_twist(Time moment, double seconds) const;
  [[nodiscard]] Matrix6d twist_motion_covariance(double seconds) const;
  [[nodiscard]] bool covered(std::span<const lidar::ImuSample> imu, Time begin, Time end) const;
  [[nodiscard]] Vector6d twist_to(const SE3& T_odom_lidar, double seconds) const;
  [[nodiscard]] Eigen::Vector3d velocity_to(const SE3& T_odom_lidar, double seconds) const;

  MotionConfig config_;
  InertialFilter inertial_;  // at moment_
  Time moment_ = 0;          // of the last scan
  SE3 T_odom_lidar_ = SE3::Identity();
  Time registered_moment_ = 0;  // of the last one that was registered
  SE3 T_odom_registered_ = SE3::Identity();
  double usual_interval_s_ = 0.1;
  double moved_over_s_ = 0;            // over which the twist was measured; 0: it was not
  Vector6d twist_ = Vector6d::Zero();  // a second, in the lidar frame
  Matrix6d twist_covariance_;
};

}  // namespace saker::odometry
