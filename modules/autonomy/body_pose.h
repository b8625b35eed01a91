#pragma once

#include <deque>
#include <vector>

#include "core/config.h"
#include "core/se3.h"
#include "core/vehicle.h"
#include "lidar/scan.h"

/// Where the body is between scans, 100 Hz — reads registered scans (from odometry, tens of
/// milliseconds late) and the IMU's samples, makes the body's pose and velocity (for the flight
/// controller, guidance, safety).
///
/// Frames: `odom`, z up. IMU samples and scans are the lidar's; the body's pose follows by the
/// extrinsics, its velocity by the lever. Method: strapdown integration from the newest registered
/// scan on; at each scan the prediction is corrected by fading-memory filters (Morrison 1969;
/// Brookner, "Tracking and Kalman Filtering Made Easy", 1998, sec. 1.2.10): degree 2 for position,
/// velocity and the accelerometer's bias, degree 1 for attitude and the gyroscope's bias. Cost:
/// microseconds a sample; a correction integrates the samples since its stamp again.
namespace saker::autonomy {

struct BodyPoseConfig {
  double memory = 0.6;
  double fresh_s = 0.4;
  double lost_s = 1.0;
  double jump_m = 1.0;
  double jump_deg = 20;
  double sd_position_m = 0.03;
  double sd_rotation_deg = 0.3;
  double sd_acceleration_mps2 = 0.2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("memory", memory, {0, 0.99}, "",
            "share of the past kept at a scan: 0 believes each scan, 1 the IMU alone");
    v.field("fresh_s", fresh_s, {0.1, 5}, "s",
            "age of the newest registered scan up to which the pose is ok: three scans, one late");
    v.field("lost_s", lost_s, {0.2, 10}, "s", "age beyond which it is lost");
    v.field("jump_m", jump_m, {0.05, 20}, "m",
            "off the prediction: odometry began anew; taken over, reset counted");
    v.field("jump_deg", jump_deg, {1, 180}, "°", "the same for attitude");
    v.field("sd_position_m", sd_position_m, {1e-3, 5}, "m", "of a registered scan, each axis");
    v.field("sd_rotation_deg", sd_rotation_deg, {1e-3, 20}, "°", "of a registered scan, each axis");
    v.field("sd_acceleration_mps2", sd_acceleration_mps2, {1e-3, 10}, "m/s²",
            "of the propagation since: tilt, bias, vibration");
  }
};

class BodyPose {
 public:
  /// Throws Error on an invalid value.
  BodyPose(const BodyPoseConfig& config, const SE3& T_body_lidar);

  /// A sample that is not newer than the last one, or not finite, is left out.
  void add(const lidar::ImuSample& sample);

  /// The pose of a registered scan; not for predicted ones. Older than the last one: left out.
  void correct(Time stamp, const SE3& T_odom_lidar);

  /// At `now`, propagated from the newest sample at constant velocity and turn, but by 0.05 s at
  /// most: then its stamp stays too. Lost before the first scan.
  [[nodiscard]] VehicleOdometry at(Time now) const;

 private:
  struct State {
    Time stamp = 0;
    Eigen::Matrix3d R_odom_lidar = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();  // rad/s, lidar frame, without bias
  };

  [[nodiscard]] State moved(State state, const lidar::ImuSample& sample) const;
  [[nodiscard]] State propagated(Time stamp) const;
  void learn(const State& predicted, Time stamp, const SE3& measured);
  void begin(Time stamp, const SE3& T_odom_lidar);
  [[nodiscard]] bool jumped(const State& predicted, const SE3& measured) const;

  BodyPoseConfig config_;
  SE3 T_body_lidar_;
  std::deque<lidar::ImuSample> samples_;  // since the last registered scan, bounded
  bool started_ = false;
  State scan_;                                                   // at the last registered scan
  State newest_;                                                 // at the newest sample
  Eigen::Vector3d gyro_bias_ = Eigen::Vector3d::Zero();          // rad/s, lidar frame
  Eigen::Vector3d acceleration_bias_ = Eigen::Vector3d::Zero();  // m/s², lidar frame
  int reset_counter_ = 0;
};

}  // namespace saker::autonomy
