#include "saker/simulation/vehicle/flight_controller.h"

#include <algorithm>

namespace saker::simulation {
namespace {

constexpr double kMostStep = 0.05;   ///< s between two readings; more is a gap
constexpr double kIdleThrust = 0.4;  ///< N of a motor that idles
constexpr double kTakeoffSlack = 5;  ///< s beyond the time that the climb should take
constexpr double kReached = 0.2;     ///< m from the height of take-off

Eigen::Vector3d shortened_by(const Eigen::Vector3d& v, double amount) {
  const double norm = v.norm();
  return norm <= amount ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                        : Eigen::Vector3d(v * (1 - amount / norm));
}

}  // namespace

FlightController::FlightController(const FlightControllerConfig& config,
                                   const AirframeConfig& airframe)
    : config_(core::checked(config, "flight_controller")),
      airframe_(core::checked(airframe, "airframe")),
      controller_(config.control, airframe),
      estimator_(config.estimator) {}

void FlightController::receive(const VehicleOdometry& odometry) {
  if (lied_to_) return;
  const std::optional<SE3> T_after_before = estimator_.receive(odometry);
  if (!T_after_before) return;
  reference_.position = *T_after_before * reference_.position;
  reference_.velocity = T_after_before->linear() * reference_.velocity;
  reference_.yaw += core::yaw(T_after_before->linear());
}

void FlightController::receive(const Setpoint& setpoint) {
  const bool whole = setpoint.position.allFinite() && setpoint.velocity.allFinite() &&
                     setpoint.acceleration.allFinite() && std::isfinite(setpoint.yaw) &&
                     std::isfinite(setpoint.yaw_rate);
  if (whole) setpoint_ = setpoint;
}

MotorThrusts FlightController::update(const lidar::ImuSample& sample,
                                      std::optional<double> barometer_m, double battery_share) {
  const double dt = now_ == 0 ? 0 : std::min(kMostStep, to_seconds(sample.stamp - now_));
  now_ = sample.stamp;
  battery_share_ = battery_share;
  estimator_.propagate(sample, dt);
  if (barometer_m) {
    const double since = last_barometer_ == 0 ? 0 : to_seconds(now_ - last_barometer_);
    estimator_.correct_height(*barometer_m, std::min(since, kMostStep));
    last_barometer_ = now_;
  }
  if (armed_) advance_mode(dt);
  const MotorThrusts thrusts = armed_ ? control(dt) : MotorThrusts(MotorThrusts::Zero());
  thrust_ = thrusts.sum();
  return thrusts;
}

VehicleState FlightController::state() const {
  VehicleState state;
  state.stamp = now_;
  state.armed = armed_;
  state.mode = mode_;
  state.attitude = Eigen::Quaterniond(estimator_.inertial().attitude());
  state.height_m = estimator_.inertial().height() - armed_height_;
  state.battery_share = battery_share_;
  state.faults = estimator_.faults() | (setpoint_expired_ ? kSetpointExpired : 0U) |
                 (battery_share_ < config_.battery_low ? kBatteryLow : 0U);
  return state;
}

// Modes.

void FlightController::enter(VehicleMode mode) {
  mode_ = mode;
  mode_since_ = now_;
  standing_s_ = 0;
  reference_.acceleration.setZero();
  reference_.yaw_rate = 0;
  if (mode != VehicleMode::descend) return;
  descend_height_ = estimator_.inertial().height();
  descend_yaw_ = core::yaw(estimator_.inertial().attitude());
  coasts_ = true;
  lied_to_ = (estimator_.faults() & kOdometryRejected) != 0;
  if (!lied_to_) return;
  estimator_.take_back();
  controller_.forget();
}

void FlightController::disarm() {
  armed_ = false;
  setpoint_expired_ = false;
  lied_to_ = false;
  setpoint_.reset();
  controller_.forget();
  enter(VehicleMode::idle);
}

bool FlightController::has_setpoint() const {
  return setpoint_ && now_ <= setpoint_->expiry && setpoint_->stamp > setpoints_after_;
}

void FlightController::advance_mode(double dt) {
  if (flying() && mode_ != VehicleMode::descend && !estimator_.trusted())
    enter(VehicleMode::descend);
  const bool may_go_on =
      mode_ == VehicleMode::takeoff || mode_ == VehicleMode::guided || mode_ == VehicleMode::hold;
  if (may_go_on && battery_share_ < config_.battery_critical) enter(VehicleMode::land);
  switch (mode_) {
    case VehicleMode::idle:
      if (seconds_in_mode() > config_.idle_s) disarm();
      return;
    case VehicleMode::takeoff:
      return advance_takeoff();
    case VehicleMode::guided:
      setpoint_expired_ = !has_setpoint();
      if (setpoint_expired_) enter(VehicleMode::hold);
      return;
    case VehicleMode::hold:
      if (has_setpoint()) {
        setpoint_expired_ = false;
        enter(VehicleMode::guided);
      } else if (seconds_in_mode() > config_.hold_s) {
        enter(VehicleMode::land);
      }
      return;
    case VehicleMode::land:
    case VehicleMode::descend:
      return watch_touchdown(dt);
  }
}

void FlightController::advance_takeoff() {
  const double left = takeoff_to_ - estimator_.odometry().position().z();
  const double allowed = config_.most_takeoff_m / config_.takeoff_speed_mps + kTakeoffSlack;
  if (std::abs(left) < kReached && reference_.position.z() >= takeoff_to_) {
    enter(VehicleMode::hold);
  } else if (seconds_in_mode() > allowed) {
    enter(VehicleMode::land);
  }
}

void FlightController::watch_touchdown(double dt) {
  const double weight = airframe_.mass_kg * kStandardGravity;
  const bool stands = std::abs(estimator_.inertial().climb_rate()) < config_.touchdown_speed_mps &&
                      thrust_ < config_.touchdown_thrust * weight;
  standing_s_ = stands ? standing_s_ + dt : 0;
  if (standing_s_ > config_.touchdown_s) disarm();
}

// Control.

MotorThrusts FlightController::control(double dt) {
  if (mode_ == VehicleMode::idle) return MotorThrusts::Constant(kIdleThrust);
  return mode_ == VehicleMode::descend ? descend(dt) : follow(dt);
}

MotorThrusts FlightController::follow(double dt) {
  advance_reference(dt);
  const OdometryEstimator& at = estimator_.odometry();
  const Eigen::Vector3d wanted = controller_.track(reference_, at.position(), at.velocity(), dt);
  return controller_.thrusts(wanted, reference_.yaw,
                             controller_.turn(wanted, reference_.yaw_rate, dt), at.attitude(),
                             at.angular_velocity());
}

void FlightController::advance_reference(double dt) {
  switch (mode_) {
    case VehicleMode::takeoff: {
      const double z = reference_.position.z() + dt * config_.takeoff_speed_mps;
      reference_.position.z() = std::min(z, takeoff_to_);
      reference_.velocity = {0, 0, z < takeoff_to_ ? config_.takeoff_speed_mps : 0};
      return;
    }
    case VehicleMode::guided:
      reference_ = at_now(*setpoint_);
      return;
    case VehicleMode::land:
      reference_.velocity.z() = 0;
      brake(dt);
      reference_.velocity.z() = -config_.land_speed_mps;
      reference_.position.z() -= dt * config_.land_speed_mps;
      return;
    default:
      brake(dt);
  }
}

/// To a standstill where braking ends.
void FlightController::brake(double dt) {
  const Eigen::Vector3d before = reference_.velocity;
  reference_.velocity = shortened_by(before, dt * config_.brake_mps2);
  reference_.position += dt * reference_.velocity;
  reference_.acceleration =
      before.normalized() * (reference_.velocity.norm() > 0 ? -config_.brake_mps2 : 0.0);
}

FlightReference FlightController::at_now(const Setpoint& s) const {
  const double t = std::max(0.0, to_seconds(now_ - s.stamp));
  FlightReference reference;
  reference.position = s.position + t * s.velocity + 0.5 * t * t * s.acceleration;
  reference.velocity = s.velocity + t * s.acceleration;
  reference.acceleration = s.acceleration;
  reference.yaw = s.yaw + t * s.yaw_rate;
  reference.yaw_rate = s.yaw_rate;
  return reference;
}

/// Brakes on the inertial unit for a moment, then level; down by the barometer.
MotorThrusts FlightController::descend(double dt) {
  const InertialEstimator& level = estimator_.inertial();
  const OdometryEstimator& last = estimator_.odometry();
  if (coasts_ && seconds_in_mode() > config_.coast_s) {
    coasts_ = false;
    controller_.forget();
    descend_yaw_ = core::yaw(level.attitude());
  }
  descend_height_ -= dt * config_.descend_speed_mps;
  FlightReference down;
  down.position = {0, 0, descend_height_};
  down.velocity = {0, 0, -config_.descend_speed_mps};
  Eigen::Vector3d wanted =
      controller_.track(down, {0, 0, level.height()}, {0, 0, level.climb_rate()}, dt);
  if (!coasts_) {
    return controller_.thrusts(wanted, descend_yaw_, controller_.turn(wanted, 0, dt),
                               level.attitude(), level.angular_velocity());
  }
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  wanted.head<2>() = controller_.follow_velocity(still, last.velocity()).head<2>();
  return controller_.thrusts(wanted, reference_.yaw, controller_.turn(wanted, 0, dt),
                             last.attitude(), last.angular_velocity());
}

}  // namespace saker::simulation
