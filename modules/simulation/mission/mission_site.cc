#include "saker/simulation/mission/mission_site.h"

#include <algorithm>

#include "saker/core/error.h"

namespace saker::simulation {
namespace {

// A garage, m. Bays and aisles as German garages have them.
constexpr double kAisle = 6.2;
constexpr double kBay = 5.1;
constexpr double kBehindBay = 0.5;  ///< from a bay to the wall: vehicles stand over its end
constexpr double kSlab = 0.2;       ///< thickness of walls and ceiling
constexpr double kPillarEvery = 7.8;
constexpr double kPillarHalf = 0.2;
constexpr double kPillarInBay = 0.7;  ///< from the aisle to its middle
constexpr double kPillarRoom = 0.3;
constexpr double kFoundation = 0.2;

// A dirt road.
constexpr double kBushesPer100m2 = 1;
constexpr double kDitch = 1.3;       ///< m, from its edge to its middle
constexpr double kMeadow = 46;       ///< m to either side
constexpr double kBushesReach = 30;  ///< m of it: farther ones are seen from no target

/// A world with nothing but its ground, and the streams of random numbers of those who build on.
struct Plan {
  Plan(const MissionSiteConfig& config, std::uint64_t seed)
      : base(seed), shape_rng(base.fork(0)), site_rng(base.fork(2)) {
    core::Rng flora_rng = base.fork(1);
    palette = make_palette(world, shape_rng);
    palette.paint = config.style.paint;
    flora = grow_flora(world, palette, flora_rng);
    population.parked = config.parked_share;
    population.traffic = 0;
    population.heavy = 0;
    population.every_kind = true;
  }

  core::Rng base, shape_rng, site_rng;
  World world;
  Palette palette{};
  Flora flora;
  Population population;
};

FlightWorld finished(Plan plan, Terrain terrain) {
  return {{std::move(plan.world), std::move(terrain), WorldKind::street, {}},
          {},
          plan.palette,
          std::move(plan.flora)};
}

void refuse(const char* key, int value, const char* where) {
  if (value == 0) return;
  throw Error("mission.site." + std::string(key) + ": " + std::to_string(value) +
              ", expected 0: there are none " + where);
}

/// Middle of the car park's aisle: the second strip of the right side that nobody uses.
double car_park_aisle(const CrossSection& section) {
  double d = 0;
  int unused = 0;
  for (const Strip& strip : section.right) {
    if (strip.use == Use::none && ++unused == 2) return -(d + strip.width / 2);
    d += strip.width;
  }
  return 0;
}

MissionSite build_street(const MissionSiteConfig& config, std::uint64_t seed) {
  FlightConfig flight;
  flight.speed_mps = 1;
  flight.duration_s = config.street_m - 2 * kBeyondSite;
  flight.parked_share = config.parked_share;
  flight.moving_vehicles = config.moving_vehicles;
  MissionSite site{.flight = build_flight_world(flight, seed, config.style)};
  site.aisle_d = car_park_aisle(site.flight.built.terrain.section());
  return site;
}

/// The middle line is that of the first aisle; the second one is to its left, beyond two rows of
/// bays that stand back to back.
CrossSection garage_section(const Palette& p) {
  const Strip bays{kBay, p.parking, Use::perpendicular_parking, 0, 0};
  const Strip half_aisle{kAisle / 2, p.asphalt, Use::none, 0, 0};
  const Strip edge{kBehindBay, p.parking, Use::none, 0, 0};
  CrossSection section;
  section.left = {half_aisle, bays, bays, half_aisle, half_aisle, bays, edge};
  section.right = {half_aisle, bays, edge};
  return section;
}

double width_of(const std::vector<Strip>& strips) {
  double width = 0;
  for (const Strip& strip : strips) width += strip.width;
  return width;
}

/// Before anybody parks, who then leaves room for them. \return their places (s, d).
std::vector<Eigen::Vector2d> claim_pillars(Site& site) {
  constexpr double kFirst = kAisle / 2 + kPillarInBay;
  constexpr double kSecond = kAisle / 2 + 2 * kBay - kPillarInBay;
  constexpr double kThird = kAisle / 2 + 2 * kBay + kAisle + kPillarInBay;
  std::vector<Eigen::Vector2d> places;
  const double reach = site.terrain.shape().half_length - kPillarEvery / 2;
  for (double s = -reach; s <= reach; s += kPillarEvery) {
    for (const double d : {-kFirst, kFirst, kSecond, kThird}) {
      if (site.claim(s, d, kPillarRoom)) places.emplace_back(s, d);
    }
  }
  return places;
}

void draw_structure(World& world, const Palette& palette, const Terrain& terrain,
                    const std::vector<Eigen::Vector2d>& pillars, double ceiling_m) {
  const double left = width_of(terrain.section().left);
  const double right = -width_of(terrain.section().right);
  const double end = terrain.shape().half_length;
  Pen pen(world.mesh);
  pen.box({-end, right, ceiling_m}, {end, left, ceiling_m + kSlab}, palette.plaster);
  pen.box({-end, left, -kFoundation}, {end, left + kSlab, ceiling_m}, palette.plaster);
  pen.box({-end, right - kSlab, -kFoundation}, {end, right, ceiling_m}, palette.plaster);
  pen.box({end, right, -kFoundation}, {end + kSlab, left, ceiling_m}, palette.plaster);
  pen.box({-end - kSlab, right, -kFoundation}, {-end, left, ceiling_m}, palette.plaster);
  for (const Eigen::Vector2d& p : pillars) {
    pen.box({p.x() - kPillarHalf, p.y() - kPillarHalf, -kFoundation},
            {p.x() + kPillarHalf, p.y() + kPillarHalf, ceiling_m}, palette.concrete);
  }
}

MissionSite build_garage(const MissionSiteConfig& config, std::uint64_t seed) {
  refuse("obstacles", config.obstacles, "in a garage");
  refuse("moving_vehicles", config.moving_vehicles, "in a garage");
  Plan plan(config, seed);
  TerrainShape shape;
  shape.half_length = config.street_m / 2;
  shape.relief_m = 0;
  shape.roughness_m = 0.002;  // a screed
  Terrain terrain(shape, garage_section(plan.palette), plan.shape_rng);
  terrain.draw(plan.world);
  Site site({plan.world, plan.palette, plan.flora, terrain, plan.population, plan.site_rng});
  const std::vector<Eigen::Vector2d> pillars = claim_pillars(site);
  populate(site);
  draw_structure(plan.world, plan.palette, terrain, pillars, config.ceiling_m);
  return {finished(std::move(plan), std::move(terrain)), 0, config.ceiling_m};
}

CrossSection dirt_road_section(const Palette& p, core::Rng& rng) {
  const double half_road = rng.uniform(2.2, 2.8);
  const auto side = [&]() -> std::vector<Strip> {
    const double steep = rng.uniform(0.15, 0.4);
    return {{half_road, p.yard, Use::none, 0, -0.02},
            {rng.uniform(2.3, 2.8), p.grass, Use::parallel_parking, 0, -0.02},
            {kDitch, p.meadow, Use::none, 0, -steep},
            {kDitch, p.meadow, Use::none, 0, steep},
            {kMeadow, p.meadow, Use::none, 0, rng.normal(0, 0.02)}};
  };
  CrossSection section;
  section.left = side();
  section.right = side();
  return section;
}

void scatter_bushes(Site& site, double from_d) {
  core::Rng& rng = site.rng;
  const double reach = site.terrain.shape().half_length;
  const double area = 2 * reach * 2 * (kBushesReach - from_d);
  const int count = static_cast<int>(kBushesPer100m2 * area / 100);
  for (int i = 0; i < count; ++i) {
    const double s = rng.uniform(-reach, reach);
    const double d = (rng.chance(0.5) ? 1 : -1) * rng.uniform(from_d, kBushesReach);
    const double radius = rng.uniform(0.3, 1.2);
    if (!site.claim(s, d, radius)) continue;
    add_bush(site.world, site.flora, site.terrain.upright(s, d), radius,
             radius * rng.uniform(0.7, 1.5), rng);
  }
}

MissionSite build_dirt_road(const MissionSiteConfig& config, std::uint64_t seed) {
  refuse("moving_vehicles", config.moving_vehicles, "on a dirt road");
  Plan plan(config, seed);
  TerrainShape shape;
  shape.half_length = config.street_m / 2;
  shape.grade = std::clamp(plan.shape_rng.normal(0, 0.015), -0.03, 0.03);
  shape.relief_m = plan.shape_rng.uniform(0.15, 0.35);
  shape.roughness_m = plan.shape_rng.uniform(0.03, 0.05);
  Terrain terrain(shape, dirt_road_section(plan.palette, plan.shape_rng), plan.shape_rng);
  terrain.draw(plan.world);
  Site site({plan.world, plan.palette, plan.flora, terrain, plan.population, plan.site_rng});
  populate(site);
  const auto& strips = terrain.section().left;
  constexpr double kFree = 1;  // m beyond the ditch: bushes hide vehicles
  scatter_bushes(site, strips[0].width + strips[1].width + 2 * kDitch + kFree);
  return {finished(std::move(plan), std::move(terrain))};
}

}  // namespace

MissionSite build_mission_site(const MissionSiteConfig& config, std::uint64_t seed) {
  switch (config.kind) {
    case SiteKind::garage:
      return build_garage(config, seed);
    case SiteKind::dirt_road:
      return build_dirt_road(config, seed);
    case SiteKind::street:
      break;
  }
  return build_street(config, seed);
}

}  // namespace saker::simulation
