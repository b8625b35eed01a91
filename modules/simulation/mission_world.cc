#include "simulation/mission_world.h"

#include <algorithm>
#include <numbers>

#include "core/error.h"
#include "simulation/collision.h"
#include "simulation/mission_obstacles.h"
#include "simulation/mission_site.h"
#include "simulation/prior_errors.h"
#include "simulation/truth.h"

namespace saker::simulation {
namespace {

constexpr double kTakeoffRoom = 2.0;    ///< m around the take-off column to anything
constexpr double kTakeoffHeight = 8.0;  ///< m of it
constexpr double kUnderCeiling = 1.0;   ///< m: the vehicle, and what it keeps from things
constexpr int kTakeoffTries = 200;
constexpr int kWorldTries = 20;
constexpr double kUnderground = -1000;            ///< m, where inserted obstacles wait
const Eigen::Vector3d kRoughSize(4.5, 1.8, 1.5);  ///< m, of any car

int parked_vehicles(const World& world) {
  return static_cast<int>(
      std::count_if(world.objects.begin(), world.objects.end(),
                    [](const TrueObject& o) { return o.class_name == "vehicle" && !o.moving; }));
}

/// The first of the seed's worlds that has room and vehicles enough.
MissionSite built(const MissionSiteConfig& site, const core::Rng& rng) {
  int most = 0;
  for (int attempt = 0; attempt < kWorldTries; ++attempt) {
    core::Rng draw = rng.fork(static_cast<std::uint64_t>(attempt));
    MissionSite candidate =
        build_mission_site(site, static_cast<std::uint64_t>(draw.index(1 << 30)));
    const int vehicles = parked_vehicles(candidate.flight.built.world);
    if (vehicles >= site.targets) return candidate;
    most = std::max(most, vehicles);
  }
  throw Error("mission.site.targets: " + std::to_string(site.targets) + ", but only " +
              std::to_string(most) + " vehicles are parked: raise parked_share or street_m");
}

bool is_free_column(const RayCaster& caster, const Eigen::Vector3d& foot, double height,
                    const std::vector<bool>& ground) {
  for (double z = 0; z <= height; z += kTakeoffRoom / 2) {
    const Eigen::Vector3f p = (foot + Eigen::Vector3d(0, 0, z)).cast<float>();
    if (caster.nearest(p, static_cast<float>(kTakeoffRoom), ground)) return false;
  }
  return true;
}

SE3 find_takeoff(const MissionSite& site, const AirframeConfig& airframe, core::Rng& rng) {
  const World& world = site.flight.built.world;
  const Terrain& terrain = site.flight.built.terrain;
  const RayCaster caster(world);
  const std::vector<bool> ground = ground_materials(world);
  const double reach = 0.5 * (terrain.shape().half_length - kBeyondSite);
  // What stands under a ceiling stands on the floor: the ceiling itself is nearer than that.
  const double height = std::min(kTakeoffHeight, site.ceiling_m - kTakeoffRoom);
  for (int attempt = 0; attempt < kTakeoffTries; ++attempt) {
    const double s = rng.uniform(-reach, reach);
    const double d = site.aisle_d + rng.uniform(-1, 1);
    SE3 T = terrain.upright(s, d, rng.uniform(-std::numbers::pi, std::numbers::pi));
    if (!is_free_column(caster, T.translation(), height, ground)) continue;
    T.translation().z() += airframe.leg_m;
    return T;
  }
  throw Error("mission.site: no free place to take off");
}

/// Indices of the targets in the world's truth, those nearest to take-off.
std::vector<std::size_t> choose_targets(const World& world, const SE3& T_sim_world, int count) {
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const TrueObject& object = world.objects[i];
    if (object.class_name != "vehicle" || object.moving) continue;
    by_distance.emplace_back((objects::place(object.model) - T_sim_world.translation()).norm(), i);
  }
  std::sort(by_distance.begin(), by_distance.end());
  std::vector<std::size_t> chosen;
  for (int i = 0; i < count; ++i) chosen.push_back(by_distance[static_cast<std::size_t>(i)].second);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Somewhere near its true place, of any size, turned anyhow.
objects::MapObject rough(const TrueObject& object, int id, const SE3& T_world_sim, double sd,
                         core::Rng& rng) {
  const objects::ClassTable table;
  objects::MapObject entry;
  entry.id = id;
  entry.class_id = table.find(object.class_name);
  entry.class_probability.assign(static_cast<std::size_t>(table.size()), 0);
  entry.class_probability[entry.class_id] = 1;
  objects::Cuboid cuboid;
  cuboid.pose.translation() = T_world_sim * objects::place(object.model);
  cuboid.pose.translation().x() += rng.normal(0, sd);
  cuboid.pose.translation().y() += rng.normal(0, sd);
  cuboid.size = kRoughSize;
  entry.model = cuboid;
  return entry;
}

objects::ObjectMap rough_map(const World& world, const std::vector<std::size_t>& targets,
                             const SE3& T_world_sim, double sd, core::Rng& rng) {
  objects::ObjectMap map;
  for (const std::size_t i : targets) {
    map.objects.push_back(rough(world.objects[i], static_cast<int>(i + 1), T_world_sim, sd, rng));
  }
  return map;
}

std::vector<int> ids_of(const objects::ObjectMap& map) {
  std::vector<int> ids;
  for (const objects::MapObject& object : map.objects) ids.push_back(object.id);
  return ids;
}

/// A box about the targets and the take-off, wide enough to fly around the outer ones.
MissionFence fence_about(const objects::ObjectMap& prior, const MissionSiteConfig& site,
                         double ceiling_m) {
  constexpr double kAround = 8;  // m: viewpoints lie about the targets
  Eigen::AlignedBox2d box(Eigen::Vector2d::Zero());
  for (const objects::MapObject& target : prior.objects)
    box.extend(Eigen::Vector2d(objects::place(target.model).head<2>()));
  const Eigen::Vector2d low = box.min().array() - kAround - site.fence_margin_m;
  const Eigen::Vector2d high = box.max().array() + kAround + site.fence_margin_m;
  return {{low.x(), low.y(), high.x(), low.y(), high.x(), high.y(), low.x(), high.y()},
          0.5,
          std::min(site.fence_height_m, ceiling_m - kUnderCeiling)};
}

/// A wall for each event that brings one in, waiting under the ground.
std::vector<std::size_t> add_inserted(World& world, const std::vector<ScenarioEvent>& events) {
  std::vector<std::size_t> movers;
  const MaterialId material = world.add({kOtherStructure, 0.4F, 0.05F, 0, 0, 0});
  for (const ScenarioEvent& event : events) {
    if (event.kind != ScenarioEventKind::obstacle) continue;
    constexpr double kHalfDepth = 0.15;
    constexpr double kFoundation = -3;
    Mesh mesh;
    Pen(mesh).box({-kHalfDepth, -event.width_m / 2, kFoundation},
                  {kHalfDepth, event.width_m / 2, event.height_m}, material);
    world.prototypes.push_back(std::move(mesh));
    Eigen::Affine3f T = Eigen::Affine3f::Identity();
    T.translation().z() = kUnderground;
    movers.push_back(world.movers.size());
    world.movers.push_back({world.prototypes.size() - 1, T, 0});
  }
  return movers;
}

}  // namespace

MissionWorld build_mission_world(const MissionConfig& config, std::uint64_t seed) {
  const MissionConfig c = core::checked(config, "mission");
  const core::Rng base(seed);
  core::Rng takeoff_rng = base.fork(21);
  core::Rng obstacle_rng = base.fork(22);
  core::Rng prior_rng = base.fork(23);
  core::Rng error_rng = base.fork(24);
  MissionSite site = built(c.site, base.fork(20));
  FlightWorld& flight = site.flight;
  World& world = flight.built.world;
  const SE3 T_sim_world = levelled(find_takeoff(site, c.airframe, takeoff_rng));
  const std::vector<std::size_t> targets = choose_targets(world, T_sim_world, c.site.targets);
  const objects::ObjectMap rough =
      rough_map(world, targets, T_sim_world.inverse(), c.site.prior_sd_m, prior_rng);
  add_obstacles(flight, targets, T_sim_world.translation(), c.site.obstacles, obstacle_rng);
  std::vector<std::size_t> inserted = add_inserted(world, c.events);
  const MissionFence fence = fence_about(rough, c.site, site.ceiling_m);
  objects::ObjectMap prior;
  if (!c.site.no_prior) {
    prior = with_errors(rough, world, T_sim_world.inverse(), fence, c.site, error_rng);
  }
  return {std::move(flight), T_sim_world,         ids_of(rough),
          std::move(prior),  std::move(inserted), fence};
}

void drive(const FlightWorld& flight, double t, RayCaster& caster) {
  const Terrain& terrain = flight.built.terrain;
  const double length = 2 * (terrain.shape().half_length - kBeyondSite);
  for (const Driver& driver : flight.drivers) {
    const double run = driver.start_s + driver.speed_mps * t + length / 2;
    const double s = run - length * std::floor(run / length) - length / 2;
    const SE3 T = terrain.on_ground(s, driver.d, driver.speed_mps > 0 ? 0 : std::numbers::pi);
    caster.move(driver.index, Eigen::Affine3d(T.matrix()).cast<float>());
  }
}

}  // namespace saker::simulation
