#include "saker/simulation/vehicle/geometric_controller.h"

#include <algorithm>
#include <numbers>

namespace saker::simulation {
namespace {

Eigen::Vector3d shortened(const Eigen::Vector3d& v, double most) {
  const double norm = v.norm();
  return norm > most ? Eigen::Vector3d(v * (most / norm)) : v;
}

/// R_d of Lee et al., section III-B: z along the wanted thrust, x as near to the heading as can be.
Eigen::Matrix3d wanted_attitude(const Eigen::Vector3d& thrust, double yaw) {
  const Eigen::Vector3d z = thrust.normalized();
  const Eigen::Vector3d heading(std::cos(yaw), std::sin(yaw), 0);
  const Eigen::Vector3d y = z.cross(heading).normalized();
  Eigen::Matrix3d R;
  R << y.cross(z), y, z;
  return R;
}

Eigen::Vector3d vee(const Eigen::Matrix3d& m) { return {m(2, 1), m(0, 2), m(1, 0)}; }

}  // namespace

GeometricController::GeometricController(const GeometricControllerConfig& config,
                                         const AirframeConfig& airframe)
    : config_(core::checked(config, "geometric_controller")),
      airframe_(core::checked(airframe, "airframe")),
      inverse_allocation_(allocation(airframe_).inverse()) {}

/// Tilt and size within limits; the height is kept before the place.
Eigen::Vector3d GeometricController::limited(const Eigen::Vector3d& wanted) const {
  Eigen::Vector3d a = wanted;
  a.z() = std::clamp(a.z(), config_.least_thrust * kStandardGravity,
                     config_.most_thrust * kStandardGravity);
  const double most = a.z() * std::tan(config_.most_tilt_deg * std::numbers::pi / 180);
  const double across = a.head<2>().norm();
  if (across > most) a.head<2>() *= most / across;
  return a;
}

Eigen::Vector3d GeometricController::track(const FlightReference& reference,
                                           const Eigen::Vector3d& position,
                                           const Eigen::Vector3d& velocity, double dt) {
  const Eigen::Vector3d error =
      shortened(reference.position - position, config_.most_position_error_m);
  integral_ = shortened(integral_ + dt * config_.integral_gain * error, config_.most_integral);
  return limited(config_.position_gain * error +
                 config_.velocity_gain * (reference.velocity - velocity) + integral_ +
                 reference.acceleration + kStandardGravity * Eigen::Vector3d::UnitZ());
}

Eigen::Vector3d GeometricController::follow_velocity(const Eigen::Vector3d& wanted,
                                                     const Eigen::Vector3d& velocity) const {
  return limited(config_.velocity_gain * (wanted - velocity) + integral_ +
                 kStandardGravity * Eigen::Vector3d::UnitZ());
}

Eigen::Vector3d GeometricController::turn(const Eigen::Vector3d& wanted, double yaw_rate,
                                          double dt) {
  const Eigen::Vector3d up = wanted.normalized();
  const Eigen::Vector3d tilting = late_up_.cross(up) / config_.turn_time_s;
  late_up_ += std::min(1.0, dt / config_.turn_time_s) * (up - late_up_);
  return tilting + yaw_rate * Eigen::Vector3d::UnitZ();
}

MotorThrusts GeometricController::thrusts(const Eigen::Vector3d& wanted, double yaw,
                                          const Eigen::Vector3d& turn, const Eigen::Matrix3d& R,
                                          const Eigen::Vector3d& angular_velocity) const {
  const Eigen::Matrix3d R_wanted = wanted_attitude(wanted, yaw);
  const Eigen::Matrix3d R_error = R_wanted.transpose() * R;
  const Eigen::Vector3d attitude_error = 0.5 * vee(R_error - R_error.transpose());  // eq. 10
  const Eigen::Vector3d rate_error = angular_velocity - R.transpose() * turn;       // eq. 11
  const Eigen::Vector3d gains(config_.attitude_gain, config_.attitude_gain, config_.yaw_gain);
  const Eigen::Vector3d rate_gains(config_.rate_gain, config_.rate_gain, config_.yaw_rate_gain);
  const Eigen::Vector3d J = airframe_.inertia();
  const Eigen::Vector3d torque =
      J.cwiseProduct(-gains.cwiseProduct(attitude_error) - rate_gains.cwiseProduct(rate_error)) +
      angular_velocity.cross(J.cwiseProduct(angular_velocity));                   // eq. 16
  const double thrust = airframe_.mass_kg * std::max(0.0, wanted.dot(R.col(2)));  // eq. 15
  return allocate(thrust, torque);
}

/// Where the motors cannot do all: attitude first, then lift, yaw last.
MotorThrusts GeometricController::allocate(double thrust, const Eigen::Vector3d& torque) const {
  const double most = airframe_.most_thrust_n;
  MotorThrusts base =
      (inverse_allocation_ * Eigen::Vector4d(thrust, torque.x(), torque.y(), 0)).array();
  base -= std::max(0.0, base.maxCoeff() - most);
  base = base.max(0);
  const MotorThrusts turn = (inverse_allocation_ * Eigen::Vector4d(0, 0, 0, torque.z())).array();
  double share = 1;
  for (int i = 0; i < 4; ++i) {
    const double room = turn[i] > 0 ? most - base[i] : base[i];
    if (std::abs(turn[i]) > room) share = std::min(share, room / std::abs(turn[i]));
  }
  return base + share * turn;
}

}  // namespace saker::simulation
