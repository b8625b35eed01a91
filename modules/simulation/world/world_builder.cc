#include "saker/simulation/world/world_builder.h"

#include <cmath>

#include "saker/simulation/world/furnish_street.h"
#include "saker/simulation/world/layout_town.h"
#include "saker/simulation/world/populate_fleet.h"

namespace saker::simulation {
namespace {

bool is_open(Use use) {
  return use == Use::none || use == Use::lane || use == Use::sidewalk || use == Use::square ||
         use == Use::parallel_parking || use == Use::perpendicular_parking;
}

/// Whether one can drive or walk at d, a metre to both sides of it too.
bool passable(const CrossSection& section, double d) {
  constexpr double kRoom = 1;
  double begin = 0;
  for (const Strip& strip : d >= 0 ? section.left : section.right) {
    const double end = begin + strip.width;
    const bool near = begin < std::abs(d) + kRoom && end > std::abs(d) - kRoom;
    if (near && !is_open(strip.use)) return false;
    begin = end;
  }
  return true;
}

/// Places about the middle of the world that nothing stands on.
std::vector<Eigen::Vector2d> find_free_places(Site& site, core::Rng& rng) {
  constexpr double kFarthest = 12;
  std::vector<Eigen::Vector2d> places;
  for (int attempt = 0; attempt < 400 && places.size() < 60; ++attempt) {
    const double s = rng.uniform(-45, 45);
    const double d = rng.uniform(-kFarthest, kFarthest);
    if (passable(site.terrain.section(), d) && site.claim(s, d, 1.3)) places.emplace_back(s, d);
  }
  return places;
}

}  // namespace

BuiltWorld build_world(WorldKind kind, std::uint64_t seed) {
  const core::Rng base(seed);
  core::Rng shape_rng = base.fork(0);
  core::Rng flora_rng = base.fork(1);
  core::Rng site_rng = base.fork(2);
  core::Rng place_rng = base.fork(3);
  core::Rng street_rng = base.fork(4);
  if (kind == WorldKind::mixed) kind = any_world(shape_rng);
  World world;
  const Palette palette = make_palette(world, shape_rng);
  Flora flora = grow_flora(world, palette, flora_rng);
  const StreetPalette street_palette = make_street_palette(world, palette, street_rng);
  const StreetFlora street_flora = grow_street_flora(world, street_palette, flora_rng);
  widen_flora(world, street_palette, flora, flora_rng);
  CrossSection section = random_section(kind, palette, shape_rng);
  vary_section(section, world, street_palette, shape_rng);
  TerrainShape shape = random_terrain(kind, palette, shape_rng);
  vary_ground(shape, kind, shape_rng);
  Terrain terrain(shape, section, shape_rng);
  terrain.draw(world);
  Population population = random_population(site_rng);
  population.fleet = any_theme(kind, site_rng);
  Site site({world, palette, flora, terrain, population, site_rng});
  StreetSite street{site, street_palette, street_flora, random_theme(street_rng), street_rng};
  paint_street(street);
  reserve_street(street);
  populate(site);
  furnish_street(street);
  std::vector<Eigen::Vector2d> places = find_free_places(site, place_rng);
  return {std::move(world), std::move(terrain), kind, std::move(places)};
}

}  // namespace saker::simulation
