#include "saker/simulation/sensor/mount.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kPi = std::numbers::pi;

SE3 turned(double roll, double pitch, double yaw) {
  SE3 T = SE3::Identity();
  T.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

Eigen::Vector2d any_place(const BuiltWorld& built, core::Rng& rng) {
  if (built.free_places.empty()) return Eigen::Vector2d::Zero();
  return built
      .free_places[static_cast<std::size_t>(rng.index(static_cast<int>(built.free_places.size())))];
}

double log_uniform(double low, double high, core::Rng& rng) {
  return low * std::exp(rng.uniform() * std::log(high / low));
}

/// Ranges of what a kind of carrier does.
struct Habit {
  double low_m, high_m;   ///< height of the sensor
  double tilt_rad;        ///< sd of roll and pitch
  double most_mps;        ///< speed
  double standing_share;  ///< of the scans
  double turn_rad_s;      ///< sd of the turning rate about z
  double sway_rad_s;      ///< sd of that about x and y
};

constexpr std::array<Habit, 5> kHabits = {{
    {1.4, 2.5, 0.015, 15, 0.4, 0.1, 0.01},
    {2.5, 3.5, 0.02, 14, 0.4, 0.06, 0.01},
    {0.5, 1.0, 0.03, 2, 0.4, 0.3, 0.05},
    {1.0, 1.9, 0.1, 1.6, 0.3, 0.4, 0.2},
    {1.0, 30, 0.09, 10, 0.3, 0.3, 0.15},
}};

MountKind any_kind(core::Rng& rng) {
  const double u = rng.uniform();
  if (u < 0.5) return MountKind::car;
  if (u < 0.58) return MountKind::truck;
  if (u < 0.68) return MountKind::robot;
  if (u < 0.78) return MountKind::hand;
  return MountKind::air;
}

double any_height(MountKind kind, const Habit& habit, core::Rng& rng) {
  if (kind == MountKind::air) return log_uniform(habit.low_m, habit.high_m, rng);
  if (kind == MountKind::car && rng.chance(0.25)) return rng.normal(1.76, 0.06);
  return rng.uniform(habit.low_m, habit.high_m);
}

Vector6d any_twist(MountKind kind, const Habit& habit, core::Rng& rng) {
  Vector6d twist = Vector6d::Zero();
  const double speed = rng.uniform(0, habit.most_mps);
  const double direction = rng.uniform(-kPi, kPi);
  const bool standing = rng.chance(habit.standing_share);
  const Eigen::Vector3d turning(rng.normal(0, habit.sway_rad_s), rng.normal(0, habit.sway_rad_s),
                                rng.normal(0, habit.turn_rad_s));
  if (standing) return twist;
  twist.head<3>() = turning;
  twist[3] = speed;
  if (kind != MountKind::air) return twist;
  twist[3] = speed * std::cos(direction);
  twist[4] = speed * std::sin(direction);
  twist[5] = 0.2 * speed * std::sin(3 * direction);
  return twist;
}

/// How far below the sensor an edge `away` lies, so that it hides what is steeper than 14° to 37°:
/// sensors are mounted to see over their carrier.
double clear_drop(double away, core::Rng& rng) { return away * rng.uniform(0.25, 0.75); }

/// Roof, bonnet and sides of a car whose roof is below the sensor.
std::vector<BodyBox> car_body(double height, core::Rng& rng) {
  const double ahead = rng.uniform(0.4, 1.1);
  const double behind = rng.uniform(0.5, 1.6);
  const double roof = height - clear_drop(std::max(ahead, behind), rng);
  const double waist = rng.uniform(0.75, 1.0);
  const double half_width = rng.uniform(0.82, 0.98);
  return {{{-behind, -0.72 * half_width, waist}, {ahead, 0.72 * half_width, roof}},
          {{-behind - rng.uniform(0.3, 1.2), -half_width, 0.3},
           {ahead + rng.uniform(0.9, 1.5), half_width, waist}}};
}

/// The box is long behind: it hides what is low there.
std::vector<BodyBox> truck_body(double height, core::Rng& rng) {
  const double ahead = rng.uniform(0.2, 0.9);
  const double drop = clear_drop(ahead, rng);
  return {{{ahead - rng.uniform(5, 11), -1.25, 0.5}, {ahead, 1.25, height - drop}}};
}

std::vector<BodyBox> robot_body(double height, core::Rng& rng) {
  std::vector<BodyBox> body = {{{-0.4, -0.3, 0.1}, {0.4, 0.3, height - rng.uniform(0.15, 0.4)}}};
  if (rng.chance(0.4)) body.push_back({{-0.35, -0.08, 0.2}, {-0.25, 0.08, height + 0.3}});
  return body;
}

/// Who carries it stands behind it.
std::vector<BodyBox> person_body(core::Rng& rng) {
  const double behind = rng.uniform(0.3, 0.6);
  return {{{-behind - 0.3, -0.25, 0}, {-behind, 0.25, rng.uniform(1.55, 1.9)}}};
}

/// Legs at four corners below it.
std::vector<BodyBox> aircraft_body(double height, core::Rng& rng) {
  std::vector<BodyBox> body;
  if (rng.chance(0.4)) return body;
  const double arm = rng.uniform(0.2, 0.4);
  for (const double x : {-arm, arm}) {
    for (const double y : {-arm, arm})
      body.push_back(
          {{x - 0.012, y - 0.012, height - 0.35}, {x + 0.012, y + 0.012, height + 0.08}});
  }
  return body;
}

std::vector<BodyBox> any_body(MountKind kind, double height, core::Rng& rng) {
  switch (kind) {
    case MountKind::car:
      return car_body(height, rng);
    case MountKind::truck:
      return truck_body(height, rng);
    case MountKind::robot:
      return robot_body(height, rng);
    case MountKind::hand:
      return person_body(rng);
    case MountKind::air:
      break;
  }
  return aircraft_body(height, rng);
}

double distance_to_box(const BodyBox& box, const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction) {
  const Eigen::Array3d a = (box.low - origin).array() / direction.array();
  const Eigen::Array3d b = (box.high - origin).array() / direction.array();
  const double enter = a.min(b).maxCoeff();
  const double leave = a.max(b).minCoeff();
  return enter > 0 && enter < leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace

const char* name_of(MountKind kind) {
  constexpr std::array<const char*, 5> kNames = {"car", "truck", "robot", "hand", "air"};
  return kNames[static_cast<std::size_t>(kind)];
}

SE3 Mount::pose(double t) const {
  return T_world_vehicle * core::se3_exp(t * twist) * T_vehicle_lidar;
}

Mount any_mount(const BuiltWorld& built, core::Rng& rng) {
  Mount mount;
  mount.kind = any_kind(rng);
  const Habit& habit = kHabits[static_cast<std::size_t>(mount.kind)];
  const Eigen::Vector2d place = any_place(built, rng);
  const bool on_road = mount.kind == MountKind::car || mount.kind == MountKind::truck;
  const double along = (rng.chance(0.5) ? 0 : kPi) + rng.normal(0, 0.15);
  const double anyhow = rng.uniform(-kPi, kPi);
  mount.T_world_vehicle = on_road ? built.terrain.on_ground(place.x(), place.y(), along)
                                  : built.terrain.upright(place.x(), place.y(), anyhow);
  mount.height_m = any_height(mount.kind, habit, rng);
  double tilt = habit.tilt_rad;
  if (mount.kind == MountKind::air && rng.chance(0.25)) tilt = 0.2;
  const auto lean = [&] { return std::clamp(rng.normal(0, tilt), -0.35, 0.35); };
  const double roll = lean();
  const double pitch = lean();
  const double yaw = rng.chance(0.4) ? rng.normal(0, 0.02) : rng.uniform(-kPi, kPi);
  mount.T_vehicle_lidar = placed(0, 0, mount.height_m) * turned(roll, pitch, yaw);
  mount.twist = any_twist(mount.kind, habit, rng);
  mount.body = any_body(mount.kind, mount.height_m, rng);
  return mount;
}

double distance_to_body(const std::vector<BodyBox>& body, const Eigen::Vector3d& origin,
                        const Eigen::Vector3d& direction) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const BodyBox& box : body)
    nearest = std::min(nearest, distance_to_box(box, origin, direction));
  return nearest;
}

}  // namespace saker::simulation
