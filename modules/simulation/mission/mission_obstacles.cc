#include "saker/simulation/mission/mission_obstacles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/core/error.h"

namespace saker::simulation {
namespace {

constexpr int kTries = 4000;
constexpr double kAside = 1;     ///< m, sd of their distance from the straight way
constexpr double kFarAside = 4;  ///< m, where there is no room on it: in the second half of tries
constexpr double kHalfWidth = 1.5;    ///< m, of a wall and a hedge
constexpr double kFromVehicle = 1.0;  ///< m from its footprint to the obstacle's end
constexpr double kFromTrunk = 2.0;    ///< m
constexpr double kFromTakeoff = 5.0;  ///< m
constexpr double kFromOther = 6.5;    ///< m between obstacles: a gap of 3.5 m at least
constexpr double kLowest = 4.5;       ///< m, of an obstacle's height
constexpr double kHighest = 6.5;

/// Metres from a point to the footprint of a cuboid, or to a trunk's axis.
double distance_to(const TrueObject& object, const Eigen::Vector3d& p) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&object.model)) {
    const Eigen::Vector3d in = cuboid->pose.inverse() * p;
    const Eigen::Vector2d outside =
        (in.head<2>().cwiseAbs() - cuboid->size.head<2>() / 2).cwiseMax(0.0);
    return outside.norm();
  }
  return (objects::place(object.model) - p).head<2>().norm();
}

bool has_room(const World& world, const Eigen::Vector3d& p) {
  return std::all_of(world.objects.begin(), world.objects.end(), [&](const TrueObject& object) {
    if (object.moving) return true;
    const bool vehicle = object.class_name == "vehicle";
    return distance_to(object, p) > (vehicle ? kHalfWidth + kFromVehicle : kFromTrunk);
  });
}

void add_post(FlightWorld& flight, const SE3& T, double height, core::Rng& rng) {
  World& world = flight.built.world;
  objects::Cylinder cylinder;
  cylinder.root = T.translation();
  cylinder.radius = rng.uniform(0.08, 0.16);
  cylinder.height = height;
  const ObjectId id = world.add({"pole", "post", cylinder});
  Pen pen(world.mesh, T, id);
  pen.tube({{0, 0, -0.3}, {0, 0, height}}, {cylinder.radius, cylinder.radius}, 14,
           flight.palette.metal);
}

void add_wall(FlightWorld& flight, const SE3& T, double height) {
  Pen pen(flight.built.world.mesh, T);
  pen.box({-kHalfWidth, -0.15, -0.5}, {kHalfWidth, 0.15, height}, flight.palette.concrete);
}

void add_hedge(FlightWorld& flight, const SE3& T, double height, core::Rng& rng) {
  for (const double x : {-kHalfWidth, -kHalfWidth / 3, kHalfWidth / 3}) {
    add_hedge_block(flight.built.world, flight.flora, T * placed(x, 0, 0), 2 * kHalfWidth / 3, 0.9,
                    height, rng);
  }
}

}  // namespace

void add_obstacles(FlightWorld& flight, const std::vector<std::size_t>& targets,
                   const Eigen::Vector3d& takeoff_sim, int count, core::Rng& rng) {
  World& world = flight.built.world;
  std::vector<Eigen::Vector3d> placed_at;
  const auto far_enough = [&](const Eigen::Vector3d& p) {
    const auto from = [&](const Eigen::Vector3d& q) { return (p - q).head<2>().norm(); };
    return from(takeoff_sim) > kFromTakeoff && has_room(world, p) &&
           std::all_of(placed_at.begin(), placed_at.end(),
                       [&](const Eigen::Vector3d& q) { return from(q) > kFromOther; });
  };
  const auto any_target = [&] {
    const std::size_t i = targets[rng.index(static_cast<int>(targets.size()))];
    return objects::place(world.objects[i].model);
  };
  for (int tries = 0; static_cast<int>(placed_at.size()) < count; ++tries) {
    if (tries == kTries) {
      throw Error("mission.site.obstacles: " + std::to_string(count) + ", but there is room for " +
                  std::to_string(placed_at.size()) + " only");
    }
    const Eigen::Vector3d a = any_target(), b = any_target();
    Eigen::Vector3d p = a + rng.uniform(0.25, 0.75) * (b - a);
    const double aside = tries < kTries / 2 ? kAside : kFarAside;
    p.head<2>() += Eigen::Vector2d(rng.normal(0, aside), rng.normal(0, aside));
    if (!far_enough(p)) continue;
    // The middle line of this street is straight: street coordinates are x and y.
    const SE3 T = flight.built.terrain.upright(p.x(), p.y(), rng.uniform(0, std::numbers::pi));
    const double height = rng.uniform(kLowest, kHighest);
    if (placed_at.size() % 3 == 0) add_post(flight, T, height, rng);
    if (placed_at.size() % 3 == 1) add_wall(flight, T, height);
    if (placed_at.size() % 3 == 2) add_hedge(flight, T, height, rng);
    placed_at.push_back(p);
  }
}

}  // namespace saker::simulation
