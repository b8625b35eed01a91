#include "simulation/world_builder.h"

namespace saker::simulation {
namespace {

/// Places about the middle of the world that nothing stands on.
std::vector<Eigen::Vector2d> find_free_places(Site& site, core::Rng& rng) {
  std::vector<Eigen::Vector2d> places;
  for (int attempt = 0; attempt < 400 && places.size() < 60; ++attempt) {
    const double s = rng.uniform(-45, 45);
    const double d = rng.normal(0, 3);
    if (site.claim(s, d, 1.3)) places.emplace_back(s, d);
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
  if (kind == WorldKind::mixed) kind = any_world(shape_rng);
  World world;
  const Palette palette = make_palette(world, shape_rng);
  const Flora flora = grow_flora(world, palette, flora_rng);
  const CrossSection section = random_section(kind, palette, shape_rng);
  Terrain terrain(random_terrain(kind, palette, shape_rng), section, shape_rng);
  terrain.draw(world);
  Site site({world, palette, flora, terrain, random_population(site_rng), site_rng});
  populate(site);
  std::vector<Eigen::Vector2d> places = find_free_places(site, place_rng);
  return {std::move(world), std::move(terrain), kind, std::move(places)};
}

}  // namespace saker::simulation
