#include "saker/simulation/mission/given_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kGravity = 9.80665;

}  // namespace

double smooth_step(double x) {
  const double u = std::clamp(x, 0.0, 1.0);
  return u * u * u * (u * (6 * u - 15) + 10);
}

double smooth_step_integral(double x) {
  const double u = std::clamp(x, 0.0, 1.0);
  return u * u * u * u * (u * u - 3 * u + 2.5) + std::max(0.0, x - 1);
}

double cruised_s(double t, double duration_s) {
  const double ramp = std::min(kRamp, std::max(0.1, duration_s / 2 - kHover));
  const double stop = std::max(duration_s - kHover - ramp, kHover);
  return ramp *
         (smooth_step_integral((t - kHover) / ramp) - smooth_step_integral((t - stop) / ramp));
}

double Swing::at(double t) const {
  return amplitude * std::sin(2 * std::numbers::pi * t / period + phase);
}

Swing random_swing(double amplitude, double shortest, double longest, core::Rng& rng) {
  const double period = rng.uniform(shortest, longest);
  return {amplitude, period, rng.uniform(0, 2 * std::numbers::pi)};
}

SE3 leaning_pose(const std::function<Eigen::Vector3d(double t)>& position, double heading,
                 double t) {
  constexpr double kStep = 0.01;
  const Eigen::Vector3d p = position(t);
  const Eigen::Vector3d before = position(t - kStep);
  const Eigen::Vector3d after = position(t + kStep);
  const Eigen::Vector3d acceleration = (after - 2 * p + before) / (kStep * kStep);
  const Eigen::Vector3d drag = 0.15 * (after - before) / (2 * kStep);
  const Eigen::Vector3d thrust = acceleration + drag + kGravity * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d z = thrust.normalized();
  const Eigen::Vector3d y =
      z.cross(Eigen::Vector3d(std::cos(heading), std::sin(heading), 0)).normalized();
  SE3 T = SE3::Identity();
  T.linear() << y.cross(z), y, z;
  T.translation() = p;
  return T;
}

std::vector<lidar::ImuSample> simulate_imu(const PathPose& path, const ImuConfig& config,
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
    const SE3 before = path(t - kStep) * T_lidar_imu;
    const SE3 now = path(t) * T_lidar_imu;
    const SE3 after = path(t + kStep) * T_lidar_imu;
    const Eigen::Vector3d acceleration =
        (after.translation() - 2 * now.translation() + before.translation()) / (kStep * kStep);
    lidar::ImuSample sample;
    sample.stamp = start + from_seconds(t);
    sample.acceleration =
        path(t).linear().transpose() * (acceleration + kGravity * Eigen::Vector3d::UnitZ()) +
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
