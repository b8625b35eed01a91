#pragma once

#include <deque>

#include "saker/core/config.h"
#include "saker/core/vehicle.h"
#include "saker/lidar/scan.h"

namespace saker::simulation {

struct OdometryEstimatorConfig {
  double position_time_s = 0.08;
  double velocity_time_s = 0.15;
  double attitude_time_s = 0.3;
  double bias_time_s = 5;
  double most_latency_s = 0.5;
  double take_back_s = 2.0;
  double position_gate_m = 0.8;
  double velocity_gate_mps = 1.0;
  double attitude_gate_deg = 12;
  double drift_time_s = 2.0;
  double velocity_drift_gate_mps = 0.8;
  double position_drift_gate_m = 0.8;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("position_time_s", position_time_s, {0.01, 10}, "s",
            "in which odometry corrects the propagated position");
    v.field("velocity_time_s", velocity_time_s, {0.01, 10}, "s", "the same of the velocity");
    v.field("attitude_time_s", attitude_time_s, {0.01, 10}, "s", "the same of the attitude");
    v.field("bias_time_s", bias_time_s, {0.5, 1000}, "s", "the same of the inertial unit's errors");
    v.field("most_latency_s", most_latency_s, {0.05, 2}, "s",
            "odometry older than this is of no use: so much is kept to propagate again");
    v.field(
        "take_back_s", take_back_s, {0.05, 5}, "s",
        "of corrections that are undone when odometry turns out to lie: it was believed so long");
    v.field("position_gate_m", position_gate_m, {0.05, 10}, "m",
            "distance from what was propagated at which odometry is not believed");
    v.field("velocity_gate_mps", velocity_gate_mps, {0.05, 10}, "m/s", "the same of the velocity");
    v.field("attitude_gate_deg", attitude_gate_deg, {1, 90}, "°", "the same of the attitude");
    v.field("drift_time_s", drift_time_s, {0.2, 30}, "s",
            "over which its changes are compared with the inertial unit's");
    v.field("velocity_drift_gate_mps", velocity_drift_gate_mps, {0.05, 10}, "m/s",
            "change of velocity that the accelerometer did not see");
    v.field("position_drift_gate_m", position_drift_gate_m, {0.05, 10}, "m",
            "change of place that its own velocity does not explain");
  }
};

/// Why odometry is not believed; null where it is.
using OdometryDoubt = const char*;

/// Where the body is in `odom`: odometry, which comes late, brought up to now by the inertial unit.
///
/// In: readings in body axes in the order of time, odometry up to `most_latency_s` old. Out: pose
/// and velocity at the last reading. Method: a complementary filter with fixed gains; each
/// correction is made at the odometry's stamp, and what was read since is propagated again, so that
/// latency costs nothing. Odometry that contradicts the readings is not used (`correct` says why).
/// Cost: about 15 µs a correction at 500 Hz and 0.1 s of latency; memory has a ceiling.
class OdometryEstimator {
 public:
  explicit OdometryEstimator(const OdometryEstimatorConfig& config);

  void propagate(const lidar::ImuSample& sample, double dt);

  /// Starts anew at this odometry: the first one, or after a jump of `odom`.
  void restart(const VehicleOdometry& odometry);
  [[nodiscard]] OdometryDoubt correct(const VehicleOdometry& odometry);
  /// What odometry said over the last `take_back_s` is undone: the inertial unit alone since then.
  void take_back();

  [[nodiscard]] bool started() const { return started_; }
  [[nodiscard]] const Eigen::Matrix3d& attitude() const { return now_.R; }
  [[nodiscard]] const Eigen::Vector3d& position() const { return now_.position; }  ///< odom
  [[nodiscard]] const Eigen::Vector3d& velocity() const { return now_.velocity; }  ///< odom
  [[nodiscard]] Eigen::Vector3d angular_velocity() const;                          ///< rad/s, body

 private:
  struct State {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration_bias = Eigen::Vector3d::Zero();
    Eigen::Vector3d seen_velocity = Eigen::Vector3d::Zero();  // integral of the accelerometer alone
  };
  struct Entry {
    lidar::ImuSample sample;
    double dt;
    State after;
  };

  void advance(State& state, const lidar::ImuSample& sample, double dt) const;
  [[nodiscard]] std::size_t entry_at(Time stamp) const;
  void replay_after(std::size_t entry);
  [[nodiscard]] OdometryDoubt doubt(const VehicleOdometry& odometry, const State& then) const;
  void watch_drift(const VehicleOdometry& odometry, const State& then);

  OdometryEstimatorConfig config_;
  bool started_ = false;
  State now_;
  lidar::ImuSample last_sample_;
  std::deque<Entry> past_;
  VehicleOdometry last_odometry_;
  Eigen::Vector3d seen_at_last_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_drift_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_drift_ = Eigen::Vector3d::Zero();
};

}  // namespace saker::simulation
