#include "saker/simulation/mission/mission_world.h"

#include <algorithm>
#include <numbers>

#include "saker/core/error.h"
#include "saker/simulation/mission/mission_obstacles.h"
#include "saker/simulation/mission/mission_site.h"
#include "saker/simulation/mission/prior_errors.h"
#include "saker/simulation/mission/takeoff.h"
#include "saker/simulation/mission/truth.h"

namespace saker::simulation {
namespace {

constexpr double kUnderCeiling = 1.0;  ///< m: the vehicle, and what it keeps from things
constexpr int kWorldTries = 20;
constexpr double kLowestFence = 0.5;              ///< m over the take-off
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

/// Indices of the targets in the world's truth, those nearest to the base.
std::vector<std::size_t> choose_targets(const World& world, const SE3& T_sim_base, int count) {
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t i = 0; i < world.objects.size(); ++i) {
    const TrueObject& object = world.objects[i];
    if (object.class_name != "vehicle" || object.moving) continue;
    by_distance.emplace_back((objects::place(object.model) - T_sim_base.translation()).norm(), i);
  }
  std::sort(by_distance.begin(), by_distance.end());
  std::vector<std::size_t> chosen;
  for (int i = 0; i < count; ++i) chosen.push_back(by_distance[static_cast<std::size_t>(i)].second);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Somewhere near its true place, of any size, turned anyhow.
objects::MapObject rough(const TrueObject& object, int id, const SE3& T_base_sim, double sd,
                         core::Rng& rng) {
  const objects::ClassTable table;
  objects::MapObject entry;
  entry.id = id;
  entry.class_id = table.find(object.class_name);
  entry.class_probability.assign(static_cast<std::size_t>(table.size()), 0);
  entry.class_probability[entry.class_id] = 1;
  objects::Cuboid cuboid;
  cuboid.pose.translation() = T_base_sim * objects::place(object.model);
  cuboid.pose.translation().x() += rng.normal(0, sd);
  cuboid.pose.translation().y() += rng.normal(0, sd);
  cuboid.size = kRoughSize;
  entry.model = cuboid;
  return entry;
}

objects::ObjectMap rough_map(const World& world, const std::vector<std::size_t>& targets,
                             const SE3& T_base_sim, double sd, core::Rng& rng) {
  objects::ObjectMap map;
  for (const std::size_t i : targets) {
    map.objects.push_back(rough(world.objects[i], static_cast<int>(i + 1), T_base_sim, sd, rng));
  }
  return map;
}

std::vector<int> ids_of(const objects::ObjectMap& map) {
  std::vector<int> ids;
  for (const objects::MapObject& object : map.objects) ids.push_back(object.id);
  return ids;
}

/// A wall, person or vehicle for each event that brings one in, waiting under the ground.
std::vector<std::size_t> add_inserted(World& world, const std::vector<ScenarioEvent>& events) {
  std::vector<std::size_t> movers;
  const MaterialId material = world.add({kOtherStructure, 0.4F, 0.05F, 0, 0, 0});
  for (const ScenarioEvent& event : events) {
    const bool moves = event.kind == ScenarioEventKind::mover;
    if (event.kind != ScenarioEventKind::obstacle && !moves) continue;
    constexpr double kWallHalfDepth = 0.15;
    constexpr double kFoundation = -3;
    const double half_depth = moves ? event.width_m / 2 : kWallHalfDepth;
    Mesh mesh;
    Pen(mesh).box({-half_depth, -event.width_m / 2, kFoundation},
                  {half_depth, event.width_m / 2, event.height_m}, material);
    world.prototypes.push_back(std::move(mesh));
    Eigen::Affine3f T = Eigen::Affine3f::Identity();
    T.translation().z() = kUnderground;
    movers.push_back(world.movers.size());
    world.movers.push_back({world.prototypes.size() - 1, T, 0});
  }
  return movers;
}

/// A vehicle alone is a team whose base is where it takes off.
SE3 find_base(const MissionSite& site, bool team, const AirframeConfig& airframe,
              const core::Rng& rng) {
  if (team) return team_base(site);
  core::Rng takeoff_rng = rng;
  return find_takeoff(site, airframe, takeoff_rng);
}

}  // namespace

std::vector<double> fence_polygon(const objects::ObjectMap& prior, const MissionSiteConfig& site) {
  constexpr double kAround = 8;  // m: viewpoints lie about the targets
  Eigen::AlignedBox2d box(Eigen::Vector2d::Zero());
  for (const objects::MapObject& target : prior.objects)
    box.extend(Eigen::Vector2d(objects::place(target.model).head<2>()));
  const Eigen::Vector2d low = box.min().array() - kAround - site.fence_margin_m;
  const Eigen::Vector2d high = box.max().array() + kAround + site.fence_margin_m;
  return {low.x(), low.y(), high.x(), low.y(), high.x(), high.y(), low.x(), high.y()};
}

MissionWorld build_mission_world(const MissionConfig& config, std::uint64_t seed,
                                 const std::optional<TakeoffPlace>& place) {
  const MissionConfig c = core::checked(config, "mission");
  const core::Rng base(seed);
  core::Rng obstacle_rng = base.fork(22);
  core::Rng prior_rng = base.fork(23);
  core::Rng error_rng = base.fork(24);
  MissionSite site = built(c.site, base.fork(20));
  FlightWorld& flight = site.flight;
  World& world = flight.built.world;
  const SE3 T_sim_base = find_base(site, place.has_value(), c.airframe, base.fork(21));
  const std::vector<std::size_t> targets = choose_targets(world, T_sim_base, c.site.targets);
  const objects::ObjectMap rough =
      rough_map(world, targets, T_sim_base.inverse(), c.site.prior_sd_m, prior_rng);
  add_obstacles(flight, targets, T_sim_base.translation(), c.site.obstacles, obstacle_rng);
  const SE3 T_sim_world = place ? takeoff_near(site, T_sim_base, *place, c.airframe) : T_sim_base;
  std::vector<std::size_t> inserted = add_inserted(world, c.events);
  const MissionFence fence{fence_polygon(rough, c.site), kLowestFence,
                           std::min(c.site.fence_height_m, site.ceiling_m - kUnderCeiling)};
  objects::ObjectMap prior;
  if (!c.site.no_prior) {
    prior = with_errors(rough, world, T_sim_base.inverse(), fence, c.site, error_rng);
  }
  return {std::move(flight), T_sim_base,          T_sim_world, ids_of(rough),
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
