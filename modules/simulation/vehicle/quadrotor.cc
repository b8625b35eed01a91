#include "saker/simulation/vehicle/quadrotor.h"

#include <algorithm>

namespace saker::simulation {
namespace {

constexpr double kLegStiffness = 2500;  ///< N/m: a leg gives 3 mm under the standing vehicle
constexpr double kLegDamping = 60;      ///< N s/m
constexpr double kFriction = 0.7;
constexpr double kSliding = 0.05;  ///< m/s at which friction is full; slower, it sticks
constexpr double kTurning = 0.1;   ///< rad/s

/// Signs of (x, y) of the motors, and of the torque of their drag: rotors on a diagonal turn alike.
constexpr std::array<std::array<double, 3>, 4> kMotors = {
    {{1, 1, -1}, {-1, 1, 1}, {-1, -1, -1}, {1, -1, 1}}};

}  // namespace

Eigen::Matrix4d allocation(const AirframeConfig& airframe) {
  const double a = airframe.arm_m / std::sqrt(2.0);
  Eigen::Matrix4d m;
  for (int i = 0; i < 4; ++i) {
    const auto& [x, y, turn] = kMotors[static_cast<std::size_t>(i)];
    m.col(i) << 1, a * y, -a * x, turn * airframe.torque_per_thrust_m;
  }
  return m;
}

Quadrotor::Quadrotor(const AirframeConfig& airframe, const SE3& T_sim_body)
    : airframe_(core::checked(airframe, "airframe")), allocation_(allocation(airframe)) {
  state_.pose = T_sim_body;
}

std::array<Eigen::Vector3d, 4> Quadrotor::feet() const {
  const double a = airframe_.arm_m / std::sqrt(2.0);
  std::array<Eigen::Vector3d, 4> feet;
  for (std::size_t i = 0; i < 4; ++i) {
    feet[i] = state_.pose * Eigen::Vector3d(a * kMotors[i][0], a * kMotors[i][1], -airframe_.leg_m);
  }
  return feet;
}

Quadrotor::Wrench Quadrotor::rotors() const {
  const Eigen::Vector4d all = allocation_ * thrusts_.matrix();
  return {all[0] * state_.pose.linear().col(2), all.tail<3>()};
}

Eigen::Vector3d Quadrotor::drag(const Eigen::Vector3d& wind) const {
  const Eigen::Vector3d through_air = state_.velocity - wind;
  const Eigen::Vector3d up = state_.pose.linear().col(2);
  const Eigen::Vector3d in_rotor_plane = through_air - up.dot(through_air) * up;
  return -airframe_.rotor_drag * in_rotor_plane -
         airframe_.air_drag * through_air.norm() * through_air;
}

Quadrotor::Wrench Quadrotor::legs(const GroundHeights& ground) {
  const std::array<Eigen::Vector3d, 4> feet_at = feet();
  const Eigen::Matrix3d& R = state_.pose.linear();
  const int down_before = feet_down_;
  feet_down_ = 0;
  Wrench wrench;
  for (std::size_t i = 0; i < 4; ++i) {
    const double depth = ground[i] - feet_at[i].z();
    if (depth < 0) continue;
    ++feet_down_;
    const Eigen::Vector3d arm = R.transpose() * (feet_at[i] - state_.pose.translation());
    const Eigen::Vector3d v = state_.velocity + R * state_.angular_velocity.cross(arm);
    const double push = std::max(0.0, kLegStiffness * depth - kLegDamping * v.z());
    Eigen::Vector3d force(-v.x(), -v.y(), 0);
    force *= kFriction * push / std::max(kSliding, force.norm());
    force.z() = push;
    wrench.force += force;
    wrench.torque += arm.cross(R.transpose() * force);
  }
  if (down_before == 0 && feet_down_ > 0) touchdown_speed_ = -state_.velocity.z();
  return wrench;
}

/// Dry friction holds what stands.
bool Quadrotor::sticks() const {
  return feet_down_ >= 3 && thrusts_.sum() < airframe_.mass_kg * kStandardGravity / 2 &&
         state_.velocity.norm() < kSliding && state_.angular_velocity.norm() < kTurning;
}

void Quadrotor::integrate(double dt, const Wrench& wrench) {
  const Eigen::Vector3d J = airframe_.inertia();
  const Eigen::Vector3d w = state_.angular_velocity;
  const Eigen::Vector3d v = state_.velocity;
  state_.velocity +=
      dt * (wrench.force / airframe_.mass_kg - kStandardGravity * Eigen::Vector3d::UnitZ());
  state_.angular_velocity += dt * (wrench.torque - w.cross(J.cwiseProduct(w))).cwiseQuotient(J);
  if (sticks()) {
    state_.velocity.head<2>().setZero();
    state_.angular_velocity.z() = 0;
  }
  state_.acceleration = (state_.velocity - v) / dt;
  state_.angular_acceleration = (state_.angular_velocity - w) / dt;
  state_.pose.translation() += dt * state_.velocity;
  const Eigen::Matrix3d turned = state_.pose.linear() * core::so3_exp(dt * state_.angular_velocity);
  state_.pose.linear() = Eigen::Quaterniond(turned).normalized().toRotationMatrix();
}

void Quadrotor::step(double dt, const MotorThrusts& commanded, const Eigen::Vector3d& wind,
                     const GroundHeights& ground) {
  const MotorThrusts wanted = commanded.max(0).min(airframe_.most_thrust_n);
  thrusts_ += (1 - std::exp(-dt / airframe_.motor_lag_s)) * (wanted - thrusts_);
  Wrench wrench = rotors();
  const Wrench standing = legs(ground);
  wrench.force += standing.force + drag(wind);
  wrench.torque += standing.torque;
  integrate(dt, wrench);
}

}  // namespace saker::simulation
