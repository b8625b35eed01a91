#include "saker/simulation/mission/spiral_world.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "saker/core/error.h"
#include "saker/simulation/sensor/ray_caster.h"
#include "saker/simulation/vehicle/collision.h"
#include "saker/simulation/world/furniture.h"
#include "saker/simulation/world/populate.h"

namespace saker::simulation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHalfLength = 45;    ///< m of ground to both sides along the street
constexpr int kTries = 400;           ///< of paths, and of subjects
constexpr double kWidening = 1.005;   ///< of the nearest gap's spread, from try to try
constexpr double kPathStep = 0.2;     ///< s between the places of the path that are checked
constexpr double kLeastStem = 1.9;    ///< m of a subject's trunk that stand free
constexpr double kWidestCrown = 3;    ///< m, radius of a subject's crown: one flies around it
constexpr double kFarthestItem = 19;  ///< m from the subject: the houses stand beyond

/// Open ground, a kerb across it, then what stands around a car park or along a street.
std::vector<Strip> side_of(const Palette& p, core::Rng& rng) {
  const MaterialId grounds[] = {p.asphalt, p.parking, p.paving, p.grass, p.meadow};
  const double kerb_d = rng.uniform(6, 12);
  std::vector<Strip> strips = {
      {kerb_d, grounds[rng.index(5)], Use::none, 0, rng.normal(0, 0.01)},
      {25 - kerb_d, grounds[rng.index(5)], Use::none, rng.chance(0.5) ? 0.1 : 0, 0.01}};
  if (rng.chance(0.5)) {
    strips.push_back({3, p.grass, Use::tree_row, 0, 0});
    strips.push_back({0.6, p.grass, Use::barrier, 0, 0});
  } else {
    strips.push_back({2.5, p.paving, Use::sidewalk, 0.12, 0.02});
    strips.push_back({4, p.grass, Use::garden, 0, 0.02});
  }
  strips.push_back({14, p.yard, Use::buildings, 0, 0});
  return strips;
}

Terrain ground_of(const Palette& palette, core::Rng& rng) {
  TerrainShape shape = random_terrain(WorldKind::car_park, palette, rng);  // its street is straight
  shape.half_length = kHalfLength;
  shape.relief_m = rng.uniform(0.01, 0.15);
  CrossSection section{side_of(palette, rng), side_of(palette, rng)};
  return {shape, std::move(section), rng};
}

Population surroundings(core::Rng& rng) {
  Population p;
  p.traffic = 0;
  p.heavy = 0;
  p.lamp_spacing = rng.uniform(13, 30);
  p.tree_spacing = rng.uniform(6, 12);
  p.street_trees = true;
  return p;
}

/// A thing to put about: how much room it takes.
struct Item {
  double radius;      ///< m, on the ground
  double wide, high;  ///< m, of all of it: what a path keeps away from
  std::function<void(Site&, const SE3&)> add;
};

Item low(double radius, double high, void (*add)(World&, const Palette&, const SE3&, core::Rng&)) {
  return {radius, radius, high,
          [add](Site& site, const SE3& T) { add(site.world, site.palette, T, site.rng); }};
}

Item any_bush(core::Rng& rng) {
  const double radius = rng.uniform(0.4, 1.0), high = rng.uniform(0.5, 1.4);
  return {radius, radius, high, [=](Site& site, const SE3& T) {
            add_bush(site.world, site.flora, T, radius, high, site.rng);
          }};
}

Item any_tree(core::Rng& rng) {
  const TreeShape shape = random_tree(rng);
  return {0.6, shape.crown_radius + 0.5, 20, [shape](Site& site, const SE3& T) {
            add_tree(site.world, site.palette, site.flora, shape, T, site.rng);
          }};
}

Item any_car(Site& site) {
  const VehicleShape shape = random_shape(site.next_kind(), site.rng);
  return {2.8, 2.8, shape.height, [shape](Site& s, const SE3& T) {
            add_vehicle(s.world, s.palette, shape, T, false, s.rng);
          }};
}

Item any_item(Site& site) {
  switch (site.rng.index(12)) {
    case 0:
      return low(0.4, 1.3, add_bin);
    case 1:
      return low(0.4, 2.0, add_person);
    case 2:
      return low(1.0, 1.3, add_bicycle);
    case 3:
      return low(1.0, 1.0, add_bench);
    case 4:
      return low(0.15, 1.1, add_bollard);
    case 5:
      return low(0.5, 3.3, add_sign);
    case 6:
      return low(2.3, 10.5, add_lamp);
    case 7:
    case 8:
      return any_car(site);
    case 9:
      return any_bush(site.rng);
    default:
      return any_tree(site.rng);
  }
}

/// The world while it is made.
class Builder {
 public:
  Builder(const SpiralConfig& config, std::uint64_t seed)
      : config_(config),
        rng_(seed),
        palette_(make_palette(world_, rng_)),
        flora_(grow_flora(world_, palette_, rng_)),
        terrain_(ground_of(palette_, rng_)),
        site_({world_, palette_, flora_, terrain_, surroundings(rng_), rng_}) {
    terrain_.draw(world_);
  }

  SpiralWorld build(const SpiralSubject& subject) {
    s_ = rng_.uniform(-3, 3);
    d_ = rng_.uniform(-2, 2);
    yaw_ = rng_.uniform(-kPi, kPi);
    add_subject(subject);
    const ObjectId id = static_cast<ObjectId>(world_.objects.size());
    if (rng_.chance(config_.neighbour_share)) add_neighbours();
    populate(site_);
    const SpiralPath path = free_path();
    for (int i = 0; i < config_.clutter; ++i) add_clutter(path);
    return {std::move(world_), id, path};
  }

 private:
  void add_subject(const SpiralSubject& subject) {
    if (subject.class_name == "vehicle") return add_vehicle_subject(subject.number);
    site_.claim(s_, d_, 1.0);
    if (subject.class_name == "trunk") return add_trunk_subject();
    if (subject.class_name == "pole") return add_pole_subject(subject.number);
    throw Error("class " + subject.class_name +
                ": no object of it can be made, expected vehicle, trunk or pole");
  }

  void add_vehicle_subject(int number) {
    const VehicleShape shape = random_shape(static_cast<VehicleKind>(number % 5), rng_);
    half_size_ = {shape.length / 2, shape.width / 2};
    park(s_, d_, yaw_, shape);
  }

  /// One whose trunk stands free: in the truth.
  void add_trunk_subject() {
    TreeShape shape = random_tree(rng_);
    while (shape.conifer || shape.crown_start < kLeastStem || shape.crown_radius > kWidestCrown)
      shape = random_tree(rng_);
    half_size_.setConstant(shape.trunk_radius);
    add_tree(world_, palette_, flora_, shape, terrain_.upright(s_, d_, yaw_), rng_);
  }

  void add_pole_subject(int number) {
    constexpr void (*kAdders[])(World&, const Palette&, const SE3&, core::Rng&) = {
        add_lamp, add_power_pole, add_traffic_light, add_sign};
    kAdders[number % 4](world_, palette_, terrain_.upright(s_, d_, yaw_), rng_);
    half_size_.setConstant(std::get<objects::Cylinder>(world_.objects.back().model).radius);
  }

  bool park(double s, double d, double yaw, const VehicleShape& shape) {
    if (!site_.claim(s, d, yaw, shape.length / 2 + 0.1, shape.width / 2 + 0.1)) return false;
    add_vehicle(world_, palette_, shape, terrain_.on_ground(s, d, yaw), false, rng_);
    return true;
  }

  /// To both sides as in a car park, or before and behind as along a kerb.
  void add_neighbours() {
    const bool abreast = rng_.chance(0.65);
    for (const double side : {-1.0, 1.0}) {
      if (rng_.chance(0.25)) continue;
      const VehicleShape shape = random_shape(site_.next_kind(), rng_);
      const double across = abreast ? side * rng_.uniform(2.5, 3.0) : rng_.normal(0, 0.1);
      const double along =
          abreast ? rng_.normal(0, 0.2)
                  : side * (half_size_.x() + shape.length / 2 + rng_.uniform(0.6, 1.6));
      const double s = s_ + along * std::cos(yaw_) - across * std::sin(yaw_);
      const double d = d_ + along * std::sin(yaw_) + across * std::cos(yaw_);
      park(s, d, yaw_ + (rng_.chance(0.3) ? kPi : 0) + rng_.normal(0, 0.03), shape);
    }
  }

  /// The first path of the seed that touches nothing; where there is little room, the later ones
  /// come less near.
  SpiralPath free_path() {
    const RayCaster caster(world_);
    const std::vector<bool> ground = ground_materials(world_);
    const SE3 T_sim_subject = terrain_.upright(s_, d_, yaw_);
    SpiralConfig config = config_;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const SpiralPath path(config, T_sim_subject, half_size_, rng_);
      if (is_free(path, caster, ground)) return path;
      config.start_spread_m *= kWidening;
    }
    throw Error("spiral: no free path about the object, expected one: raise start_spread_m");
  }

  [[nodiscard]] bool is_free(const SpiralPath& path, const RayCaster& caster,
                             const std::vector<bool>& ground) const {
    const auto reach = static_cast<float>(config_.clearance_m);
    for (double t = 0; t <= config_.duration_s; t += kPathStep) {
      const Eigen::Vector3f p = path.pose(t).translation().cast<float>();
      if (caster.nearest(p, reach, ground)) return false;
    }
    return true;
  }

  /// One thing somewhere, if there is room for it beside the others and the path.
  void add_clutter(const SpiralPath& path) {
    const Item item = any_item(site_);
    const double angle = rng_.uniform(-kPi, kPi);
    const double range = kFarthestItem * std::sqrt(rng_.uniform());
    const double s = s_ + range * std::cos(angle);
    const double d = d_ + range * std::sin(angle);
    const double yaw = rng_.uniform(-kPi, kPi);
    if (!beside(path, item, terrain_.point(s, d)) || !site_.claim(s, d, item.radius)) return;
    item.add(site_, terrain_.on_ground(s, d, yaw));
  }

  [[nodiscard]] bool beside(const SpiralPath& path, const Item& item,
                            const Eigen::Vector3d& foot) const {
    for (double t = 0; t <= config_.duration_s; t += kPathStep) {
      const Eigen::Vector3d p = path.pose(t).translation() - foot;
      const bool over = p.z() > item.high + config_.clearance_m;
      if (!over && p.head<2>().norm() < item.wide + config_.clearance_m) return false;
    }
    return true;
  }

  SpiralConfig config_;
  core::Rng rng_;
  World world_;
  Palette palette_;
  Flora flora_;
  Terrain terrain_;
  Site site_;
  double s_ = 0, d_ = 0, yaw_ = 0;
  Eigen::Vector2d half_size_ = Eigen::Vector2d::Zero();
};

}  // namespace

SpiralWorld build_spiral_world(const SpiralConfig& config, const SpiralSubject& subject,
                               std::uint64_t seed) {
  return Builder(core::checked(config, "spiral"), seed).build(subject);
}

}  // namespace saker::simulation
