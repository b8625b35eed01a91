#pragma once

#include <span>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/lidar/scan.h"

namespace saker::odometry {

using Matrix15d = Eigen::Matrix<double, 15, 15>;

struct InertialConfig {
  double max_gap_s = 0.05;
  double rate_noise = 0.003;
  double acceleration_noise = 0.03;
  double rate_bias_walk = 0.0005;
  double acceleration_bias_walk = 0.02;
  double initial_rate_bias_rps = 0.02;
  double initial_acceleration_bias_mps2 = 0.1;
  double unknown_acceleration_mps2 = 5;
  double unknown_rate_rps = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("max_gap_s", max_gap_s, {0.001, 1}, "s",
            "longest stretch without a sample; beyond, nothing is known of the motion in it");
    v.field("rate_noise", rate_noise, {1e-6, 1}, "rad/s/sqrt(Hz)",
            "density of the gyroscope's noise: ten times a data sheet's, for vibration and scale");
    v.field("acceleration_noise", acceleration_noise, {1e-5, 10}, "m/s²/sqrt(Hz)",
            "the same of the accelerometer");
    v.field("rate_bias_walk", rate_bias_walk, {0, 0.1}, "rad/s/sqrt(s)",
            "random walk of the gyroscope's bias");
    v.field("acceleration_bias_walk", acceleration_bias_walk, {0, 1}, "m/s²/sqrt(s)",
            "the same of the accelerometer's: that of the tilt of `odom` turns with the heading");
    v.field("initial_rate_bias_rps", initial_rate_bias_rps, {1e-6, 1}, "rad/s",
            "sd of the gyroscope's bias at switch-on");
    v.field("initial_acceleration_bias_mps2", initial_acceleration_bias_mps2, {1e-5, 5}, "m/s²",
            "sd of the accelerometer's, and of gravity by the tilt of `odom`");
    v.field("unknown_acceleration_mps2", unknown_acceleration_mps2, {0.01, 200}, "m/s²",
            "sd of the acceleration over a gap between samples: a multirotor's");
    v.field("unknown_rate_rps", unknown_rate_rps, {0.01, 50}, "rad/s",
            "sd of the change of the turn rate over such a gap");
  }
};

/// Where the lidar is by its inertial unit, and how well that is known: strapdown integration from
/// one known pose to the next, with the biases as part of the state.
///
/// Where measurements keep lying off by more than they and the state allow for, the model is wrong
/// (a bias that stepped): `doubt` gives all that is known up by the factor that explains them,
/// after Zhou and Frank, "Strong tracking filtering of nonlinear time-varying stochastic systems
/// with coloured noise", Int. J. Control 65(2), 1996.
///
/// Frames: `odom`, z up; errors are right ones in the lidar frame: [rotation, translation,
/// velocity, bias of the gyroscope, bias of the accelerometer]. Method: error-state Kalman filter,
/// Solà, "Quaternion kinematics for the error-state Kalman filter" (2017), sec. 5; a reading is
/// taken to change linearly between two samples. Cost: some microseconds a sample.
class InertialFilter {
 public:
  explicit InertialFilter(const InertialConfig& config);

  /// At a pose with this covariance; what is known of the biases is kept.
  void start(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance,
             const Eigen::Vector3d& velocity, double velocity_sd);

  /// On to the sample's stamp. A sample that is not newer or not finite is left out.
  void propagate(const lidar::ImuSample& sample);
  /// Through all samples up to `until`, and on to it.
  void propagate(std::span<const lidar::ImuSample> imu, Time until);
  /// On to `until` with the last reading.
  void coast(Time until);

  /// The pose turned out to be this, N(pose, covariance), the prior included: velocity and biases
  /// follow by what they share with it.
  void condition(const SE3& T_odom_lidar, const Matrix6d& covariance);
  /// How far a measured place is off, m in the lidar frame, and the square of that in its sd: 3 on
  /// average where state and measurement err as they say.
  struct Surprise {
    Eigen::Vector3d off = Eigen::Vector3d::Zero();
    double square = 0;
  };
  [[nodiscard]] Surprise surprise(const SE3& T_odom_lidar, const Matrix6d& noise) const;
  /// All is known less well, by the factor (of variances, at most 100) with which that place was to
  /// be expected.
  void doubt(const Surprise& surprise, const Matrix6d& noise);

  /// The pose was measured with this error.
  void correct(const SE3& T_odom_lidar, const Matrix6d& noise);
  /// `odom` jumped: the body's velocity and the biases did not.
  void jump(const SE3& T_odom_lidar, const Matrix6d& covariance);
  /// Counts from here: the pose is taken for exact.
  void fix_pose();

  /// The velocity if the pose turned out to be this; m/s in `odom`.
  [[nodiscard]] Eigen::Vector3d velocity_at(const SE3& T_odom_lidar) const;

  [[nodiscard]] Time stamp() const { return reading_.stamp; }
  [[nodiscard]] const SE3& T_odom_lidar() const { return T_odom_lidar_; }
  [[nodiscard]] const Eigen::Vector3d& velocity() const { return velocity_; }  ///< m/s, `odom`
  [[nodiscard]] Eigen::Vector3d rate() const;  ///< rad/s, lidar, without bias
  /// m/s², lidar, of a reading of the accelerometer.
  [[nodiscard]] Eigen::Vector3d acceleration(const Eigen::Vector3d& force) const;
  [[nodiscard]] const Eigen::Vector3d& rate_bias() const { return rate_bias_; }
  [[nodiscard]] Matrix6d pose_covariance() const { return covariance_.topLeftCorner<6, 6>(); }
  [[nodiscard]] const Matrix15d& covariance() const { return covariance_; }

 private:
  using Gain = Eigen::Matrix<double, 15, 6>;

  void advance(const lidar::ImuSample& reading);
  void grow(const Eigen::Matrix3d& turn, const Eigen::Vector3d& force, double dt, bool gap);
  [[nodiscard]] Gain gain() const;

  InertialConfig config_;
  bool has_reading_ = false;
  lidar::ImuSample reading_;  // at the state's stamp
  SE3 T_odom_lidar_ = SE3::Identity();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_bias_ = Eigen::Vector3d::Zero();
  Matrix15d covariance_ = Matrix15d::Zero();
};

}  // namespace saker::odometry
