#include "simulation/flight_path.h"

#include <algorithm>
#include <numbers>

#include "core/error.h"

namespace saker::simulation {
namespace {

constexpr double kGravity = 9.81;
constexpr double kStep =
    1e-3;  // s, of the differences: far below the spline's knots, far above rounding
constexpr std::array<double, 3> kSwayHz = {0.23, 0.31, 0.17};
constexpr std::array<double, 3> kVibrationHz = {7.3, 11.1, 12.7};

/// Way flown after t of a ramp up to `speed`, cruise and ramp down over `length`; and how long it
/// all takes.
struct SpeedProfile {
  double speed, ramp, length;

  SpeedProfile(double cruise, double ramp_s, double way)
      : speed(cruise), ramp(ramp_s), length(way) {
    speed = std::min(speed, length / ramp);  // too short to reach the cruise speed
  }
  [[nodiscard]] double duration() const { return length / speed + ramp; }
  [[nodiscard]] double way(double t) const {
    if (t < ramp) return 0.5 * speed * t * t / ramp;
    if (t < duration() - ramp) return speed * (t - 0.5 * ramp);
    const double left = std::max(duration() - t, 0.0);
    return length - 0.5 * speed * left * left / ramp;
  }
};

std::vector<Eigen::Vector4d> unwrapped(const std::vector<Waypoint>& waypoints) {
  std::vector<Eigen::Vector4d> rows;
  double yaw = waypoints.front().yaw;
  for (const Waypoint& w : waypoints) {
    yaw += std::remainder(w.yaw - yaw, 2 * std::numbers::pi);
    rows.emplace_back(w.position.x(), w.position.y(), w.position.z(), yaw);
  }
  return rows;
}

/// The polyline's point after `way` metres.
Eigen::Vector4d along(const std::vector<Eigen::Vector4d>& rows, double way) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double leg = (rows[i] - rows[i - 1]).head<3>().norm();
    if (way <= leg) return rows[i - 1] + (rows[i] - rows[i - 1]) * (leg > 0 ? way / leg : 0);
    way -= leg;
  }
  return rows.back();
}

double length_of(const std::vector<Eigen::Vector4d>& rows) {
  double length = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) length += (rows[i] - rows[i - 1]).head<3>().norm();
  return length;
}

}  // namespace

FlightPath::FlightPath(const FlightPathConfig& config, const std::vector<Waypoint>& waypoints,
                       core::Rng rng)
    : config_(core::checked(config, "flight_path")) {
  if (waypoints.size() < 2) throw Error("flight path: one waypoint, expected at least two");
  const auto rows = unwrapped(waypoints);
  const double length = length_of(rows);
  if (length <= 0) throw Error("flight path: all waypoints are one point, expected a way to fly");
  const SpeedProfile profile(config_.speed_m_s, config_.ramp_s, length);
  const int count = static_cast<int>(std::ceil(profile.duration() / config_.knot_s)) + 1;
  knots_.assign(2, rows.front());  // doubled ends: the spline starts and ends at rest
  for (int i = 0; i < count; ++i) knots_.push_back(along(rows, profile.way(i * config_.knot_s)));
  knots_.insert(knots_.end(), 2, rows.back());
  for (double& phase : phases_) phase = rng.uniform(0, 2 * std::numbers::pi);
}

double FlightPath::duration() const {
  return static_cast<double>(knots_.size() - 3) * config_.knot_s;
}

Eigen::Vector4d FlightPath::spline(double t) const {
  const double u = std::clamp(t / config_.knot_s, 0.0, static_cast<double>(knots_.size() - 3));
  const auto i = std::min(static_cast<std::size_t>(u), knots_.size() - 4);
  const double s = u - static_cast<double>(i), s2 = s * s, s3 = s2 * s;
  return (knots_[i] * (1 - 3 * s + 3 * s2 - s3) + knots_[i + 1] * (4 - 6 * s2 + 3 * s3) +
          knots_[i + 2] * (1 + 3 * s + 3 * s2 - 3 * s3) + knots_[i + 3] * s3) /
         6;
}

Eigen::Vector3d FlightPath::position(double t) const {
  Eigen::Vector3d p = spline(t).head<3>();
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] += config_.sway_m * std::sin(2 * std::numbers::pi * kSwayHz[axis] * t + phases_[axis]);
  }
  return p;
}

Eigen::Vector3d FlightPath::acceleration(double t) const {
  constexpr double kWide = 0.02;  // s: a second difference needs a longer step
  return (position(t + kWide) - 2 * position(t) + position(t - kWide)) / (kWide * kWide);
}

SE3 FlightPath::T_world_body(double t) const {
  const Eigen::Vector3d thrust = acceleration(t) + kGravity * Eigen::Vector3d::UnitZ();
  const double yaw = spline(t)[3];
  const Eigen::Vector3d z = thrust.normalized();
  const Eigen::Vector3d y = z.cross(Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0)).normalized();
  Eigen::Vector3d wobble;
  for (int axis = 0; axis < 3; ++axis) {
    wobble[axis] = config_.vibration_deg * std::numbers::pi / 180 *
                   std::sin(2 * std::numbers::pi * kVibrationHz[axis] * t + phases_[3 + axis]);
  }
  SE3 T = SE3::Identity();
  T.linear() << y.cross(z), y, z;
  T.linear() *= core::so3_exp(wobble);
  T.translation() = position(t);
  return T;
}

Eigen::Vector3d FlightPath::angular_velocity(double t) const {
  const Eigen::Matrix3d before = T_world_body(t - kStep).linear();
  const Eigen::Matrix3d after = T_world_body(t + kStep).linear();
  return core::so3_log(before.transpose() * after) / (2 * kStep);
}

namespace {

Eigen::Vector3d normal3(core::Rng& rng, double sd) {
  return {rng.normal(0, sd), rng.normal(0, sd), rng.normal(0, sd)};
}

/// What the unit feels: the second derivative of the body's whole motion.
Eigen::Vector3d specific_force(const FlightPath& path, double t) {
  const Eigen::Vector3d in_world = path.acceleration(t) + kGravity * Eigen::Vector3d::UnitZ();
  return path.T_world_body(t).linear().transpose() * in_world;
}

}  // namespace

std::vector<ImuReading> read_imu(const ImuConfig& config, const FlightPath& path, core::Rng rng) {
  const ImuConfig c = core::checked(config, "imu");
  const double period = 1 / c.rate_hz, root_rate = std::sqrt(c.rate_hz);
  const Eigen::Vector3d accelerometer_bias = normal3(rng, c.accelerometer_bias);
  Eigen::Vector3d gyro_bias = normal3(rng, c.gyro_bias);
  std::vector<ImuReading> readings;
  for (double t = 0; t <= path.duration(); t += period) {
    gyro_bias += normal3(rng, c.gyro_bias_walk * std::sqrt(period));
    readings.push_back(
        {t,
         specific_force(path, t) + accelerometer_bias +
             normal3(rng, c.accelerometer_noise * root_rate),
         path.angular_velocity(t) + gyro_bias + normal3(rng, c.gyro_noise * root_rate)});
  }
  return readings;
}

}  // namespace saker::simulation
