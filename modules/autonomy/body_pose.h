#pragma once

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/core/vehicle.h"
#include "saker/lidar/scan.h"
#include "saker/odometry/imu_buffer.h"
#include "saker/odometry/inertial_filter.h"

/// Where the body is between scans, 100 Hz — reads registered scans (from odometry, tens of
/// milliseconds late) and the IMU's samples, makes the body's pose and velocity (for the flight
/// controller, guidance, safety).
///
/// Frames: `odom`, z up. IMU samples and scans are the lidar's; the body's pose follows by the
/// extrinsics, its velocity by the lever. Method: the error-state Kalman filter of
/// `odometry/inertial_filter.h` from the newest registered scan on; a scan is weighed against the
/// inertial unit by both covariances, however long ago the one before was: milliseconds (what came
/// of a revolution before the network fell silent) or half a second. Two scans in a row that are
/// off in the same direction by more than those of a flight ever are say that the inertial unit is
/// not what it was: the filter doubts what it knows, its covariance says so, and biases are learnt
/// anew. One scan alone may be wrong itself. Cost: microseconds a sample; a correction integrates
/// the samples since its stamp again.
namespace saker::autonomy {

struct BodyPoseConfig {
  double fresh_s = 0.4;
  double lost_s = 1.0;
  double coast_sd_m = 0.6;
  double coast_s = 6.0;
  double jump_m = 0.5;
  double jump_deg = 20;
  double sd_position_m = 0.03;
  double sd_rotation_deg = 0.3;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("fresh_s", fresh_s, {0.1, 5}, "s",
            "age of the newest registered scan up to which the pose is ok: three scans, one late");
    v.field("lost_s", lost_s, {0.2, 10}, "s",
            "age beyond which it is lost, unless the inertial unit knows the place");
    v.field("coast_sd_m", coast_sd_m, {0.01, 10}, "m",
            "stated sd of the place up to which it does: what a vehicle at rest has about it");
    v.field("coast_s", coast_s, {0.2, 60}, "s", "age beyond which it is lost in any case");
    v.field("jump_m", jump_m, {0.05, 20}, "m",
            "off the prediction: odometry began anew; taken over, reset counted. What an autopilot "
            "takes for a lie without a reset");
    v.field("jump_deg", jump_deg, {1, 180}, "°", "the same for attitude");
    v.field("sd_position_m", sd_position_m, {1e-3, 5}, "m",
            "of a registered scan, each axis, beside its own covariance");
    v.field("sd_rotation_deg", sd_rotation_deg, {1e-3, 20}, "°", "the same of its attitude");
  }
};

class BodyPose {
 public:
  /// Throws Error on an invalid value.
  BodyPose(const BodyPoseConfig& config, const odometry::InertialConfig& inertial,
           const SE3& T_body_lidar);

  /// A sample that is not newer than the last one, not finite, or of 0.25 s after `now`, is left
  /// out: it would shut out those that are due.
  void add(const lidar::ImuSample& sample, Time now);

  /// The pose of a registered scan, not of a predicted one, with its covariance (right tangent).
  /// Older than the last one, or not finite: left out.
  void correct(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance);

  /// At `now`, propagated from the newest sample with its reading, but by 0.05 s at most: then its
  /// stamp stays too. Not ok where the newest sample is that far ahead. Lost before the first scan,
  /// and where no scan was registered for so long that the stated covariance, or the silence of the
  /// inertial unit, leaves the place open.
  [[nodiscard]] VehicleOdometry at(Time now) const;

 private:
  [[nodiscard]] VehicleOdometryStatus status(Time now, const Matrix6d& covariance) const;
  [[nodiscard]] bool jumped(const SE3& predicted, const SE3& measured) const;
  void weigh(const SE3& measured, const Matrix6d& noise);

  BodyPoseConfig config_;
  SE3 T_body_lidar_;
  Matrix6d scan_noise_;
  odometry::ImuBuffer imu_;  // since the last registered scan, bounded
  bool started_ = false;
  odometry::InertialFilter scan_;                  // at the last registered scan
  odometry::InertialFilter newest_;                // at the newest sample
  Eigen::Vector3d off_ = Eigen::Vector3d::Zero();  // of the last scan, m, where it surprised
  int reset_counter_ = 0;
};

}  // namespace saker::autonomy
