#include "made_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "saker/core/rng.h"

namespace saker::odometry::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegree = M_PI / 180;

double cast_box(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double near = 0, far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.low[axis] - origin[axis]) / direction[axis];
    const double b = (box.high[axis] - origin[axis]) / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far && near > 0 ? near : kInfinity;
}

/// Of unit sd.
double wave_height(const Eigen::Vector3d& p) {
  struct Wave {
    double along, across, phase;  // rad/m, rad/m, rad
  };
  static constexpr Wave kWaves[] = {{0.7, 0.4, 1.0},  {-0.9, 1.1, 2.5}, {1.7, 0.2, 0.3},
                                    {0.3, -1.5, 4.0}, {1.2, 1.2, 5.1},  {-0.4, 0.6, 3.3}};
  double sum = 0;
  for (const Wave& w : kWaves) sum += std::sin(w.along * p.x() + w.across * p.y() + w.phase);
  return sum * std::sqrt(2.0 / std::size(kWaves));
}

double cast_ground(double roughness_m, const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& direction) {
  if (direction.z() >= 0) return kInfinity;
  double range = -origin.z() / direction.z();
  if (roughness_m == 0) return range;
  constexpr double kStep = 0.2;  // m; then half of it again and again
  const auto above = [&](double r) {
    const Eigen::Vector3d p = origin + r * direction;
    return p.z() - roughness_m * wave_height(p);
  };
  const double highest = roughness_m * std::sqrt(2.0 * 6);  // all six waves at once
  double far = std::max(0.0, -(origin.z() - highest) / direction.z());
  while (above(far) > 0) far += kStep;
  double near = far - kStep;
  for (int i = 0; i < 12; ++i) (above((near + far) / 2) > 0 ? near : far) = (near + far) / 2;
  return far;
}

}  // namespace

double MadeWorld::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  double range = ground ? cast_ground(roughness_m, origin, direction) : kInfinity;
  for (const Box& box : boxes) range = std::min(range, cast_box(box, origin, direction));
  return range;
}

MadeWorld street() {
  MadeWorld world;
  for (int i = -4; i < 24; ++i) {
    const double x = 10.0 * i;
    const double left = 9 + 1.5 * (i & 1), right = -8 - 1.0 * (i % 3 == 0);
    world.boxes.push_back({{x, left, 0}, {x + 10, left + 5, 8}});
    world.boxes.push_back({{x, right - 5, 0}, {x + 10, right, 7}});
    world.boxes.push_back({{x + 2, 4, 0}, {x + 6.3, 5.8, 1.5}});
    world.boxes.push_back({{x + 5, -6.2, 0}, {x + 5.25, -5.95, 6}});
  }
  return world;
}

MadeWorld corridor() {
  return {{{{-1e4, 3, 0}, {1e4, 4, 5}}, {{-1e4, -4, 0}, {1e4, -3, 5}}}, true};
}

MadeWorld bare_ground() { return {{}, true, 0.04}; }

lidar::Scan scan(const MadeWorld& world, const MadeSensor& sensor, const Motion& motion,
                 Time stamp) {
  core::Rng rng(static_cast<std::uint64_t>(stamp));
  lidar::Scan scan;
  scan.stamp = stamp;
  scan.rows = sensor.rows;
  scan.columns = sensor.columns;
  const auto count = static_cast<std::size_t>(sensor.rows * sensor.columns);
  scan.points.assign(count, Eigen::Vector3f::Constant(NAN));
  scan.reflectivity.assign(count, 0.5f);
  scan.offset_ns.assign(count, 0);
  for (int c = 0; c < sensor.columns; ++c) {
    const Time offset = -(sensor.columns - 1 - c) * sensor.period / sensor.columns;
    const SE3 T = motion(stamp + offset);
    const double azimuth = -2 * M_PI * c / sensor.columns;
    for (int r = 0; r < sensor.rows; ++r) {
      const double elevation =
          kDegree * (sensor.up_deg + (sensor.down_deg - sensor.up_deg) * r / (sensor.rows - 1));
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double range = world.cast(T.translation(), T.linear() * ray);
      const auto i = static_cast<std::size_t>(r * sensor.columns + c);
      scan.offset_ns[i] = static_cast<std::int32_t>(offset);
      if (range < sensor.max_range_m)
        scan.points[i] = ((range + rng.normal(0, sensor.range_noise_m)) * ray).cast<float>();
    }
  }
  return scan;
}

std::vector<lidar::ImuSample> imu(const Motion& motion, Time begin, Time end,
                                  const Eigen::Vector3d& gyro_bias) {
  constexpr Time kPeriod = 10'000'000, kHalf = 1'000'000;
  constexpr double kHalfSeconds = 1e-3;
  std::vector<lidar::ImuSample> samples;
  for (Time t = (begin / kPeriod + 1) * kPeriod; t <= end; t += kPeriod) {
    const SE3 before = motion(t - kHalf), now = motion(t), after = motion(t + kHalf);
    const Eigen::Vector3d acceleration =
        (after.translation() - 2 * now.translation() + before.translation()) /
        (kHalfSeconds * kHalfSeconds);
    lidar::ImuSample sample;
    sample.stamp = t;
    sample.acceleration = now.linear().transpose() * (acceleration + Eigen::Vector3d(0, 0, 9.81));
    sample.angular_velocity =
        core::so3_log(before.linear().transpose() * after.linear()) / (2 * kHalfSeconds) +
        gyro_bias;
    samples.push_back(sample);
  }
  return samples;
}

SE3 weaving(Time time) {
  const double t = to_seconds(time);
  SE3 T = SE3::Identity();
  T.translation() << 4 * t, 1.2 * std::sin(0.8 * t), 2.5 + 0.3 * std::sin(0.5 * t);
  T.linear() = (Eigen::AngleAxisd(1.25 * std::sin(0.8 * t), Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(0.1 * std::sin(1.7 * t), Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(0.1 * std::sin(1.3 * t), Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

Motion straight(double speed_mps) {
  return [speed_mps](Time time) {
    SE3 T = SE3::Identity();
    T.translation() << speed_mps * to_seconds(time), 0, 1.8;
    return T;
  };
}

}  // namespace saker::odometry::testing
