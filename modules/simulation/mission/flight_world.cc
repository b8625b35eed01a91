#include <algorithm>

#include "saker/simulation/mission/flight.h"

namespace saker::simulation {
namespace {

// Nothing beyond the last tree row holds an object of the map: what is in the truth can be seen.

/// The street's side: parked along the kerb, lamps and trees on the sidewalk, houses behind
/// gardens.
std::vector<Strip> street(const Palette& p, core::Rng& rng) {
  return {{rng.uniform(3, 3.6), p.asphalt, Use::none, 0, -0.02},
          {rng.uniform(2.1, 2.4), p.parking, Use::parallel_parking, 0, 0.02},
          {rng.uniform(2, 3), p.paving, Use::sidewalk, 0.12, 0.02},
          {rng.uniform(3, 4.4), p.grass, Use::garden, 0, 0.02},
          {14, p.yard, Use::buildings, 0, 0},
          {12, p.meadow, Use::none, 0, 0}};
}

/// The car park's side: a verge with trees, a row of cars, its aisle, an edge of trees.
std::vector<Strip> car_park(const Palette& p, core::Rng& rng) {
  return {{rng.uniform(3, 3.6), p.asphalt, Use::none, 0, -0.02},
          {rng.uniform(1.8, 2.6), p.grass, Use::island, 0.1, 0.01},
          {5.2, p.parking, Use::perpendicular_parking, 0, 0},
          {rng.uniform(5.5, 6.5), p.asphalt, Use::none, 0, 0},
          {rng.uniform(2, 4), p.grass, Use::tree_row, 0.1, rng.normal(0, 0.05)},
          {0.6, p.grass, Use::barrier, 0, 0},
          {6, p.meadow, Use::none, 0, 0},
          {14, p.yard, Use::buildings, 0, 0}};
}

Population flight_population(const FlightConfig& config, const SiteStyle& style, core::Rng& rng) {
  Population p;
  p.parked = config.parked_share;
  p.traffic = 0;
  p.lamp_spacing = rng.uniform(13, 18) / style.lamps;
  p.tree_spacing = rng.uniform(8, 12) / style.trees;
  p.clutter = style.clutter;
  p.street_trees = true;
  p.heavy = 0;
  p.every_kind = true;
  return p;
}

/// A vehicle that meets the flight somewhere on its way, in the lane of its direction.
Driver add_driver(Site& site, int number, const FlightConfig& config, core::Rng& rng) {
  constexpr VehicleKind kKinds[] = {VehicleKind::van, VehicleKind::sedan, VehicleKind::suv};
  const double along = number % 2 == 0 ? -1 : 1;
  const double speed = rng.uniform(3, 8);
  const double meeting = rng.uniform(0.2, 0.8) * config.duration_s;
  const double meeting_s = config.speed_mps * (meeting - config.duration_s / 2);
  Driver driver;
  driver.speed_mps = along * speed;
  driver.d = -along * 1.6;
  driver.start_s = meeting_s - driver.speed_mps * meeting;
  driver.index =
      add_mover(site.world, site.palette, random_shape(kKinds[number % 3], rng),
                site.terrain.on_ground(driver.start_s, driver.d, along > 0 ? 0 : M_PI), rng);
  return driver;
}

}  // namespace

FlightWorld build_flight_world(const FlightConfig& config, std::uint64_t seed,
                               const SiteStyle& style) {
  const core::Rng base(seed);
  core::Rng shape_rng = base.fork(0);
  core::Rng flora_rng = base.fork(1);
  core::Rng site_rng = base.fork(2);
  World world;
  Palette palette = make_palette(world, shape_rng);
  palette.paint = style.paint;
  const Flora flora = grow_flora(world, palette, flora_rng);
  CrossSection section;
  section.left = street(palette, shape_rng);
  section.right = car_park(palette, shape_rng);
  TerrainShape shape = random_terrain(WorldKind::car_park, palette, shape_rng);
  shape.grade = std::clamp(shape.grade, -0.03, 0.03);
  shape.half_length = std::max(40.0, 0.5 * config.speed_mps * config.duration_s + 12);
  Terrain terrain(shape, std::move(section), shape_rng);
  terrain.draw(world);
  Site site({world, palette, flora, terrain, flight_population(config, style, site_rng), site_rng});
  populate(site);
  core::Rng traffic_rng = base.fork(3);
  std::vector<Driver> drivers;
  for (int i = 0; i < config.moving_vehicles; ++i) {
    drivers.push_back(add_driver(site, i, config, traffic_rng));
  }
  return {{std::move(world), std::move(terrain), WorldKind::street, {}},
          std::move(drivers),
          palette,
          flora};
}

}  // namespace saker::simulation
