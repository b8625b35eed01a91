#pragma once

#include <deque>
#include <functional>

#include "saker/simulation/vehicle/flight_controller.h"
#include "saker/simulation/vehicle/instruments.h"
#include "saker/simulation/vehicle/wind.h"

namespace saker::simulation {

/// A vehicle over a flat plain at z = 0 with its flight controller, in steps of 2 ms. Odometry is
/// truth, late by `latency_s` and changed by `distort`: what is between truth and controller is
/// seen here and nowhere else.
class MadeVehicle {
 public:
  static constexpr double kControlStep = 0.002;
  static constexpr double kPhysicsStep = 0.001;

  explicit MadeVehicle(const WindConfig& wind = {}, const FlightControllerConfig& config = {})
      : controller(config, airframe),
        body(airframe, resting()),
        imu_({.rate_hz = 500}, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity(), core::Rng(1)),
        barometer_({}, core::Rng(2)),
        wind_(wind, core::Rng(3)) {}

  void run(double seconds) {
    const Time end = now + from_seconds(seconds);
    while (now < end) step();
  }
  /// Runs until `done` or for `most` seconds. \return whether it was done.
  bool run_until(const std::function<bool()>& done, double most) {
    const Time end = now + from_seconds(most);
    while (now < end && !done()) step();
    return done();
  }

  CommandAck command(CommandKind kind, double height_m = NAN) {
    controller.receive(Command{now, ++last_id, kind, height_m});
    return controller.take_acks().back();
  }

  /// Armed, taken off, holding at `height`.
  bool fly(double height) {
    run(1);
    if (!command(CommandKind::arm).accepted) return false;
    if (!command(CommandKind::takeoff, height).accepted) return false;
    return run_until([&] { return controller.state().mode == VehicleMode::hold; }, 20);
  }

  void setpoint(const Eigen::Vector3d& position, double yaw = 0, double valid_s = 0.2,
                const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero(),
                const Eigen::Vector3d& acceleration = Eigen::Vector3d::Zero()) {
    controller.receive(
        Setpoint{now, now + from_seconds(valid_s), position, velocity, acceleration, yaw, 0});
  }
  /// Setpoints at 50 Hz for `seconds`.
  void guide(const Eigen::Vector3d& position, double seconds, double yaw = 0) {
    for (int i = 0; i < static_cast<int>(seconds * 50); ++i) {
      setpoint(position, yaw);
      run(0.02);
    }
  }

  [[nodiscard]] Eigen::Vector3d position() const {
    return body.state().pose.translation() - Eigen::Vector3d(0, 0, airframe.leg_m);
  }
  [[nodiscard]] VehicleState state() const { return controller.state(); }

  AirframeConfig airframe;
  FlightController controller;
  Quadrotor body;
  Time now = 1000 * kNanosecondsPerSecond;
  double latency_s = 0.06;
  double battery_share = 1;
  bool odometry_on = true;
  std::function<void(VehicleOdometry&)> distort;
  std::int64_t last_id = 0;

 private:
  [[nodiscard]] SE3 resting() const {
    SE3 T = SE3::Identity();
    T.translation().z() = airframe.leg_m;
    return T;
  }

  void step() {
    for (int i = 0; i < 2; ++i) body.step(kPhysicsStep, thrusts_, air_, {0, 0, 0, 0});
    now += from_seconds(kControlStep);
    ++steps_;
    if (steps_ % 5 == 0) {
      air_ = wind_.step(5 * kControlStep);
      send_odometry();
    }
    std::optional<double> height;
    if (steps_ % 10 == 0) height = barometer_.read(position().z() + 31, 10 * kControlStep);
    thrusts_ = controller.update(imu_.sample(body.state(), now), height, battery_share);
  }

  void send_odometry() {
    VehicleOdometry odometry;
    odometry.stamp = now;
    odometry.T_odom_body = body.state().pose;
    odometry.T_odom_body.translation() = position();
    odometry.velocity = body.state().velocity;
    odometry.angular_velocity = body.state().angular_velocity;
    odometry.status = VehicleOdometryStatus::ok;
    late_.push_back(odometry);
    while (!late_.empty() && to_seconds(now - late_.front().stamp) >= latency_s) {
      VehicleOdometry said = late_.front();
      late_.pop_front();
      if (distort) distort(said);
      if (odometry_on) controller.receive(said);
    }
  }

  InertialUnit imu_;
  Barometer barometer_;
  Wind wind_;
  MotorThrusts thrusts_ = MotorThrusts::Zero();
  Eigen::Vector3d air_ = Eigen::Vector3d::Zero();
  std::deque<VehicleOdometry> late_;
  int steps_ = 0;
};

inline WindConfig calm() { return {.mean_mps = 0, .gust_mps = 0}; }
inline WindConfig windy() { return {.mean_mps = 4, .gust_mps = 1}; }

}  // namespace saker::simulation
