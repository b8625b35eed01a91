#pragma once

#include <optional>
#include <span>

#include "core/config.h"
#include "core/se3.h"
#include "lidar/scan.h"
#include "odometry/gyro.h"
#include "odometry/registration.h"
#include "odometry/sweep.h"

namespace saker::odometry {

struct MotionConfig {
  double initial_speed_mps = 8;
  double initial_rate_rps = 1;
  double acceleration_mps2 = 5;
  double angular_acceleration_rps2 = 5;
  double max_coast_s = 1;
  double max_interval_s = 2;
  GyroConfig gyro;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("initial_speed_mps", initial_speed_mps, {0.01, 100}, "m/s",
            "sd of the speed before the first two scans");
    v.field("initial_rate_rps", initial_rate_rps, {0.01, 20}, "rad/s",
            "sd of the turn rate before the first two scans");
    v.field("acceleration_mps2", acceleration_mps2, {0.01, 200}, "m/s²",
            "sd of the acceleration between scans: a multirotor's");
    v.field("angular_acceleration_rps2", angular_acceleration_rps2, {0.01, 500}, "rad/s²",
            "sd of the turn's, where no gyroscope measures it");
    v.field("max_coast_s", max_coast_s, {0, 60}, "s",
            "after so long without a registration it is taken to stand still");
    v.field("max_interval_s", max_interval_s, {0.05, 60}, "s",
            "a longer gap between scans is predicted as if it were this long");
    v.group("gyro", gyro, "the IMU's gyroscope");
  }
};

/// Where the lidar is expected at a moment.
struct Prediction {
  Time moment = 0;
  double seconds = 0;                     ///< since the last scan's moment
  PosePrior prior;                        ///< its covariance is that of the motion since then
  std::optional<RotationTrack> rotation;  ///< since then, when the gyroscope covers it
};

/// The lidar's motion from scan to scan, at a moment in each: predicted by a constant twist, or
/// with an IMU by the gyroscope's rotation and a constant velocity in `odom`. Within a scan the
/// twist (the velocity) changes as fast as it did over the last two intervals. The covariance of
/// the twist grows with every scan that could not be registered, and in directions that
/// registration leaves open.
class MotionModel {
 public:
  explicit MotionModel(const MotionConfig& config);

  void start(Time moment, const SE3& T_odom_lidar);

  [[nodiscard]] Prediction predict(Time moment, std::span<const lidar::ImuSample> imu) const;

  /// The motion during a scan of length `span` in whose middle, the prediction's moment, the lidar
  /// is at `T_odom_lidar`.
  [[nodiscard]] Sweep sweep(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                            std::span<const lidar::ImuSample> imu) const;

  /// The same of the scan before, taken to have moved as from it to `T_odom_lidar`.
  [[nodiscard]] Sweep sweep_before(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                                   std::span<const lidar::ImuSample> imu) const;

  void accept(const Prediction& prediction, const SE3& T_odom_lidar, const Matrix6d& covariance);
  void coast(const Prediction& prediction);

  [[nodiscard]] Time moment() const { return moment_; }
  [[nodiscard]] const SE3& T_odom_lidar() const { return T_odom_lidar_; }
  [[nodiscard]] double usual_interval_s() const { return usual_interval_s_; }
  [[nodiscard]] const Gyro& gyro() const { return gyro_; }

 private:
  [[nodiscard]] Matrix6d motion_covariance(double seconds, bool gyro_used) const;
  [[nodiscard]] Vector6d twist_to(const SE3& T_odom_lidar, double seconds) const;
  [[nodiscard]] Eigen::Vector3d velocity_to(const SE3& T_odom_lidar, double seconds) const;

  MotionConfig config_;
  Gyro gyro_;
  Time moment_ = 0;
  Time registered_moment_ = 0;
  double usual_interval_s_ = 0.1;
  SE3 T_odom_lidar_ = SE3::Identity();
  double moved_over_s_ =
      0;  // the interval over which twist and velocity were measured; 0: they were not
  Vector6d twist_ = Vector6d::Zero();                   // a second, in the lidar frame
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // in `odom`
  Matrix6d twist_covariance_;
};

}  // namespace saker::odometry
