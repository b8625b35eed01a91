#pragma once

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/lidar/scan.h"

namespace saker::simulation {

struct InertialEstimatorConfig {
  double attitude_time_s = 4.0;
  double bias_time_s = 30;
  double trusted_g = 0.15;
  double height_time_s = 1.2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("attitude_time_s", attitude_time_s, {0.1, 100}, "s",
            "in which the accelerometer levels the gyroscope's attitude");
    v.field("bias_time_s", bias_time_s, {1, 1000}, "s",
            "in which it corrects the gyroscope's error");
    v.field("trusted_g", trusted_g, {0.01, 1}, "g",
            "readings farther from 1 g than this say nothing of the vertical");
    v.field("height_time_s", height_time_s, {0.1, 30}, "s",
            "in which the barometer corrects the accelerometer's height");
  }
};

/// What can be known without odometry: which way is up, and the height.
///
/// In: readings of the inertial unit in body axes, heights of the barometer. Out: attitude (its
/// heading is the gyroscope's, from 0), height and rate of climb. Method: the explicit
/// complementary filter of Mahony, Hamel, Pflimlin, TAC 2008, and a third-order observer of the
/// height.
class InertialEstimator {
 public:
  explicit InertialEstimator(const InertialEstimatorConfig& config);

  void propagate(const lidar::ImuSample& sample, double dt);
  void correct_height(double barometer_m, double dt);

  [[nodiscard]] const Eigen::Matrix3d& attitude() const { return R_; }
  [[nodiscard]] const Eigen::Vector3d& angular_velocity() const { return angular_velocity_; }
  [[nodiscard]] double height() const { return height_; }          ///< m, the barometer's
  [[nodiscard]] double climb_rate() const { return climb_rate_; }  ///< m/s
  [[nodiscard]] bool ready() const { return has_up_ && has_height_; }

 private:
  void propagate_attitude(const lidar::ImuSample& sample, double dt);

  InertialEstimatorConfig config_;
  bool has_up_ = false;
  bool has_height_ = false;
  double levelled_s_ = 0;
  Eigen::Matrix3d R_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d gyro_bias_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_ = Eigen::Vector3d::Zero();
  double height_ = 0;
  double climb_rate_ = 0;
  double climb_bias_ = 0;  // m/s², of the vertical acceleration
};

}  // namespace saker::simulation
