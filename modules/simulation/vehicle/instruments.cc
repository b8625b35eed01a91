#include "saker/simulation/vehicle/instruments.h"

#include <algorithm>
#include <cmath>

namespace saker::simulation {
namespace {

constexpr double kSecondsPerHour = 3600;

}  // namespace

InertialUnit::InertialUnit(const ImuConfig& config, const Eigen::Vector3d& place_in_body,
                           const Eigen::Matrix3d& R_axes_body, core::Rng rng)
    : config_(core::checked(config, "imu")),
      place_(place_in_body),
      R_axes_body_(R_axes_body),
      rng_(rng) {
  acceleration_bias_ = noise(config_.acceleration_bias);
  rotation_bias_ = noise(config_.rotation_bias);
}

Eigen::Vector3d InertialUnit::noise(double sd) {
  const double x = rng_.normal(0, sd);
  const double y = rng_.normal(0, sd);
  return {x, y, rng_.normal(0, sd)};
}

lidar::ImuSample InertialUnit::sample(const RigidState& state, Time stamp) {
  const Eigen::Vector3d gravity(0, 0, -kStandardGravity);
  const Eigen::Vector3d& w = state.angular_velocity;
  const Eigen::Vector3d force = state.pose.linear().transpose() * (state.acceleration - gravity) +
                                state.angular_acceleration.cross(place_) + w.cross(w.cross(place_));
  lidar::ImuSample sample;
  sample.stamp = stamp;
  sample.acceleration =
      R_axes_body_ * force + acceleration_bias_ + noise(config_.acceleration_noise);
  sample.angular_velocity = R_axes_body_ * w + rotation_bias_ + noise(config_.rotation_noise);
  return sample;
}

Barometer::Barometer(const BarometerConfig& config, core::Rng rng)
    : config_(core::checked(config, "barometer")), rng_(rng) {
  drift_ = rng_.normal(0, config_.drift_m);
}

double Barometer::read(double height_m, double dt) {
  const double kept = std::exp(-dt / config_.drift_time_s);
  drift_ = kept * drift_ + rng_.normal(0, config_.drift_m * std::sqrt(1 - kept * kept));
  return height_m + drift_ + rng_.normal(0, config_.noise_m);
}

Battery::Battery(const BatteryConfig& config)
    : config_(core::checked(config, "battery")),
      capacity_j_(config.capacity_wh * kSecondsPerHour),
      energy_j_(config.charge * capacity_j_) {}

void Battery::drain(double dt, const MotorThrusts& thrusts) {
  const double power = config_.electronics_w + config_.watts_per_n15 * thrusts.pow(1.5).sum();
  energy_j_ = std::max(0.0, energy_j_ - dt * power);
}

}  // namespace saker::simulation
