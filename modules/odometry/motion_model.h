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

/// Where the lidar is expected at the next scan's stamp.
struct Prediction {
  Time stamp = 0;
  double seconds = 0;  ///< since the last scan
  PosePrior prior;     ///< its covariance is that of the motion since the last scan
  std::optional<RotationTrack> rotation;  ///< since the last scan, when the gyroscope covers it
};

/// The lidar's motion between scans: a constant twist, or with an IMU the gyroscope's rotation and
/// a constant velocity in `odom`. The covariance of the twist grows with every scan that could not
/// be registered, and in directions that registration leaves open.
class MotionModel {
 public:
  explicit MotionModel(const MotionConfig& config);

  /// `span`: of the first scan.
  void start(Time stamp, Time span, std::span<const lidar::ImuSample> imu);

  [[nodiscard]] Prediction predict(Time stamp, std::span<const lidar::ImuSample> imu) const;

  /// The motion during a scan of length `span` that ends with the lidar at `T_odom_lidar`.
  [[nodiscard]] Sweep sweep(const Prediction& prediction, const SE3& T_odom_lidar, Time span,
                            std::span<const lidar::ImuSample> imu) const;
  /// The motion during the first scan: before the second one is registered, what the gyroscope
  /// says, then the motion between the two.
  [[nodiscard]] Sweep first_sweep(Time span) const;
  [[nodiscard]] Sweep first_sweep(const Prediction& prediction, const SE3& T_odom_lidar,
                                  Time span) const;

  void accept(const Prediction& prediction, const SE3& T_odom_lidar, const Matrix6d& covariance);
  void coast(const Prediction& prediction);

  [[nodiscard]] Time stamp() const { return stamp_; }
  [[nodiscard]] const SE3& T_odom_lidar() const { return T_odom_lidar_; }
  [[nodiscard]] double usual_interval_s() const { return usual_interval_s_; }
  [[nodiscard]] const Gyro& gyro() const { return gyro_; }

 private:
  [[nodiscard]] Matrix6d motion_covariance(double seconds, bool gyro_used) const;

  MotionConfig config_;
  Gyro gyro_;
  Time stamp_ = 0;
  Time registered_stamp_ = 0;
  double usual_interval_s_ = 0.1;
  SE3 T_odom_lidar_ = SE3::Identity();
  std::optional<RotationTrack> first_rotation_;         // during the first scan
  bool moved_ = false;                                  // whether the twist was measured
  Vector6d twist_ = Vector6d::Zero();                   // a second, in the lidar frame
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // in `odom`
  Matrix6d twist_covariance_;
};

}  // namespace saker::odometry
