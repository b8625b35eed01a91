#include "simulation/flight_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kGravity = 9.80665;
constexpr double kHover = 1.5;  ///< s of standing still at both ends
constexpr double kRamp = 2.5;   ///< s from standing still to cruise
constexpr double kDegree = std::numbers::pi / 180;

/// From 0 to 1 with two continuous derivatives.
double smooth_step(double x) {
  const double u = std::clamp(x, 0.0, 1.0);
  return u * u * u * (u * (6 * u - 15) + 10);
}

/// Its integral from 0.
double smooth_step_integral(double x) {
  const double u = std::clamp(x, 0.0, 1.0);
  return u * u * u * u * (u * u - 3 * u + 2.5) + std::max(0.0, x - 1);
}

}  // namespace

double FlightPath::Swing::at(double t) const {
  return amplitude * std::sin(2 * std::numbers::pi * t / period + phase);
}

FlightPath::FlightPath(const FlightConfig& config, const Terrain& terrain, core::Rng& rng)
    : config_(config), terrain_(&terrain) {
  const auto swing = [&](double amplitude, double shortest, double longest) {
    const double period = rng.uniform(shortest, longest);
    return Swing{amplitude, period, rng.uniform(0, 2 * std::numbers::pi)};
  };
  sway_ = swing(config.sway_m, 11, 17);
  rise_ = swing(config.height_swing_m, 12, 20);
  look_ = swing(config.look_around_deg * kDegree, 9, 15);
  roll_ = swing(config.vibration_deg * kDegree, 0.08, 0.12);
  pitch_ = swing(config.vibration_deg * kDegree, 0.08, 0.12);
  start_s_ = -travelled(config.duration_s) / 2;
  base_z_ = terrain.height(start_s_, 0) - terrain.shape().grade * start_s_;
}

double FlightPath::travelled(double t) const {
  const double ramp = std::min(kRamp, std::max(0.1, config_.duration_s / 2 - kHover));
  const double stop = std::max(config_.duration_s - kHover - ramp, kHover);
  return config_.speed_mps * ramp *
         (smooth_step_integral((t - kHover) / ramp) - smooth_step_integral((t - stop) / ramp));
}

double FlightPath::envelope(double t) const { return smooth_step((t - kHover) / 4); }

Eigen::Vector3d FlightPath::position(double t) const {
  const double s = start_s_ + travelled(t);
  Eigen::Vector3d p = terrain_->point(s, envelope(t) * sway_.at(t));
  p.z() = base_z_ + terrain_->shape().grade * s + config_.height_m + envelope(t) * rise_.at(t);
  return p;
}

double FlightPath::heading(double t) const {
  return terrain_->heading(start_s_ + travelled(t)) + envelope(t) * look_.at(t);
}

SE3 FlightPath::pose(double t) const {
  constexpr double kStep = 0.01;
  const Eigen::Vector3d p = position(t);
  const Eigen::Vector3d before = position(t - kStep);
  const Eigen::Vector3d after = position(t + kStep);
  const Eigen::Vector3d acceleration = (after - 2 * p + before) / (kStep * kStep);
  const Eigen::Vector3d drag = 0.15 * (after - before) / (2 * kStep);
  const Eigen::Vector3d thrust = acceleration + drag + kGravity * Eigen::Vector3d::UnitZ();
  const double turn = heading(t);
  const Eigen::Vector3d z = thrust.normalized();
  const Eigen::Vector3d y =
      z.cross(Eigen::Vector3d(std::cos(turn), std::sin(turn), 0)).normalized();
  SE3 T = SE3::Identity();
  T.linear() << y.cross(z), y, z;
  T.linear() = T.linear() * core::so3_exp({roll_.at(t), pitch_.at(t), 0});
  T.translation() = p;
  return T;
}

std::vector<lidar::ImuSample> simulate_imu(const FlightPath& path, const ImuConfig& config,
                                           const SE3& T_lidar_imu, double duration_s, Time start,
                                           core::Rng& rng) {
  constexpr double kStep = 1e-3;
  const auto noise = [&](double sd) {
    const double x = rng.normal(0, sd);
    const double y = rng.normal(0, sd);
    return Eigen::Vector3d(x, y, rng.normal(0, sd));
  };
  const Eigen::Vector3d acceleration_bias = noise(config.acceleration_bias);
  const Eigen::Vector3d rotation_bias = noise(config.rotation_bias);
  const int count = static_cast<int>(duration_s * config.rate_hz);
  std::vector<lidar::ImuSample> samples;
  for (int i = 0; i < count; ++i) {
    const double t = i / config.rate_hz;
    const SE3 before = path.pose(t - kStep) * T_lidar_imu;
    const SE3 now = path.pose(t) * T_lidar_imu;
    const SE3 after = path.pose(t + kStep) * T_lidar_imu;
    const Eigen::Vector3d acceleration =
        (after.translation() - 2 * now.translation() + before.translation()) / (kStep * kStep);
    lidar::ImuSample sample;
    sample.stamp = start + from_seconds(t);
    sample.acceleration =
        path.pose(t).linear().transpose() * (acceleration + kGravity * Eigen::Vector3d::UnitZ()) +
        acceleration_bias + noise(config.acceleration_noise);
    const Eigen::Matrix3d turn = T_lidar_imu.linear() * before.linear().transpose() *
                                 after.linear() * T_lidar_imu.linear().transpose();
    sample.angular_velocity =
        core::so3_log(turn) / (2 * kStep) + rotation_bias + noise(config.rotation_noise);
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace saker::simulation
