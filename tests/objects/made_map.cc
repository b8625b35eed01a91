#include "made_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/furniture.h"
#include "saker/simulation/world/plants.h"
#include "saker/simulation/world/vehicle.h"

namespace saker::objects::made {
namespace {

constexpr double kDistance_m = 5;
constexpr double kRoom_m2 = 41;  // a place, of a Poisson disk at 5 m
constexpr int kTries = 30;       // of Bridson's

/// Cells of a size that holds one place at most.
class Grid {
 public:
  Grid(double edge, double distance)
      : distance_(distance),
        cell_(distance / std::numbers::sqrt2),
        cells_(static_cast<int>(std::ceil(edge / cell_)) + 1),
        places_(static_cast<std::size_t>(cells_) * cells_, Eigen::Vector2d::Constant(NAN)) {}

  [[nodiscard]] bool free(const Eigen::Vector2d& p) const {
    const int x = static_cast<int>(p.x() / cell_), y = static_cast<int>(p.y() / cell_);
    for (int i = std::max(0, x - 2); i <= std::min(cells_ - 1, x + 2); ++i) {
      for (int j = std::max(0, y - 2); j <= std::min(cells_ - 1, y + 2); ++j) {
        if ((places_[index(i, j)] - p).squaredNorm() < distance_ * distance_) return false;
      }
    }
    return true;
  }
  void add(const Eigen::Vector2d& p) {
    places_[index(static_cast<int>(p.x() / cell_), static_cast<int>(p.y() / cell_))] = p;
  }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(x) * cells_ + y;
  }

  double distance_, cell_;
  int cells_;
  std::vector<Eigen::Vector2d> places_;
};

/// Draws what the simulator puts up, and keeps its truth alone.
class Models {
 public:
  Models(const simulation::Terrain& ground, core::Rng& rng)
      : ground_(ground), rng_(rng), palette_(simulation::make_palette(world_, rng)) {}

  Model vehicle(const Eigen::Vector2d& at) {
    using enum simulation::VehicleKind;
    constexpr simulation::VehicleKind kCars[] = {sedan,     sedan,     sedan,     hatchback,
                                                 hatchback, hatchback, hatchback, suv,
                                                 suv,       van,       van,       pickup};
    constexpr simulation::VehicleKind kHeavy[] = {truck, bus, trailer};
    const auto kind = rng_.chance(0.05) ? kHeavy[rng_.index(3)] : kCars[rng_.index(12)];
    const simulation::VehicleShape shape = simulation::random_shape(kind, rng_);
    Cuboid cuboid;
    cuboid.pose = ground_.on_ground(at.x(), at.y(), rng_.uniform(0, 2 * std::numbers::pi)) *
                  Eigen::Translation3d(0, 0, shape.height / 2);
    cuboid.size = {shape.length, shape.width, shape.height};
    return cuboid;
  }

  Model trunk(const Eigen::Vector2d& at) {
    const simulation::TreeShape shape = simulation::random_tree(rng_);
    const Eigen::Vector3d axis(shape.lean_x, shape.lean_y, 1);
    return Cylinder{ground_.point(at.x(), at.y()), axis.normalized(), shape.trunk_radius,
                    shape.crown_start};
  }

  Model pole(const Eigen::Vector2d& at) {
    using simulation::World;
    constexpr void (*kKinds[])(World&, const simulation::Palette&, const SE3&, core::Rng&) = {
        simulation::add_lamp, simulation::add_sign, simulation::add_power_pole,
        simulation::add_traffic_light};
    World world;
    world.materials = world_.materials;
    kKinds[rng_.index(4)](world, palette_, ground_.upright(at.x(), at.y()), rng_);
    return world.objects.back().model;
  }

 private:
  const simulation::Terrain& ground_;
  core::Rng& rng_;
  simulation::World world_;
  simulation::Palette palette_;
};

}  // namespace

simulation::Terrain rough_ground(core::Rng& rng) {
  simulation::TerrainShape shape;
  shape.relief_m = 1.5;
  shape.roughness_m = 0.05;
  const std::vector<simulation::Strip> flat = {{.width = 1e6, .surface = 0}};
  return {shape, {flat, flat}, rng};
}

std::vector<Eigen::Vector2d> poisson_disk(double edge, double distance, core::Rng& rng) {
  Grid grid(edge, distance);
  std::vector<Eigen::Vector2d> places = {Eigen::Vector2d::Constant(edge / 2)};
  grid.add(places.front());
  std::vector<std::size_t> active = {0};
  const auto inside = [&](const Eigen::Vector2d& p) {
    return p.minCoeff() >= 0 && p.maxCoeff() < edge;
  };
  while (!active.empty()) {
    const auto pick = static_cast<std::size_t>(rng.index(static_cast<int>(active.size())));
    const Eigen::Vector2d from = places[active[pick]];
    bool found = false;
    for (int i = 0; i < kTries && !found; ++i) {
      const double angle = rng.uniform(0, 2 * std::numbers::pi);
      const double range = distance * std::sqrt(rng.uniform(1, 4));
      const Eigen::Vector2d p = from + range * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      if (!inside(p) || !grid.free(p)) continue;
      found = true;
      grid.add(p);
      active.push_back(places.size());
      places.push_back(p);
    }
    if (found) continue;
    active[pick] = active.back();
    active.pop_back();
  }
  return places;
}

ObjectMap large_map(int count, std::uint64_t seed) {
  core::Rng rng(seed);
  const simulation::Terrain ground = rough_ground(rng);
  std::vector<Eigen::Vector2d> places = poisson_disk(std::sqrt(kRoom_m2 * count), kDistance_m, rng);
  for (std::size_t i = places.size() - 1; i > 0; --i) {
    std::swap(places[i], places[static_cast<std::size_t>(rng.index(static_cast<int>(i) + 1))]);
  }
  Models models(ground, rng);
  ObjectMap map;
  map.objects.resize(std::min(places.size(), static_cast<std::size_t>(count)));
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    MapObject& object = map.objects[i];
    object.id = static_cast<int>(i);
    object.class_id = static_cast<ClassId>(i % 2 == 0 ? 1 : 2 + i / 2 % 2);
    object.class_probability.assign(static_cast<std::size_t>(ClassTable().size()), 0);
    object.class_probability[object.class_id] = rng.uniform(0.5, 1);
    object.model = object.class_id == 1   ? models.vehicle(places[i])
                   : object.class_id == 2 ? models.trunk(places[i])
                                          : models.pole(places[i]);
  }
  return map;
}

}  // namespace saker::objects::made
