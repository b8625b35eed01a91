#include <numbers>

#include "saker/simulation/world/buildings.h"
#include "saker/simulation/world/furniture.h"
#include "saker/simulation/world/populate.h"

namespace saker::simulation {
namespace {

/// Upright at (s, d), x along the street, y away from it.
SE3 facing_out(const Site& site, const Lot& lot, double s, double d) {
  return site.terrain.upright(s, d, lot.side > 0 ? 0 : std::numbers::pi);
}

using Adder = void (*)(World&, const Palette&, const SE3&, core::Rng&);

void put(Site& site, const Lot& lot, Adder add, double s, double share, double radius) {
  const double d = lot.at(share);
  if (site.claim(s, d, radius))
    add(site.world, site.palette, facing_out(site, lot, s, d), site.rng);
}

/// About `per_100_m` along the lot, between two shares of its width.
void spread(Site& site, const Lot& lot, Adder add, double per_100_m, double from, double to,
            double radius) {
  const double mean = per_100_m * site.population.clutter * (lot.to - lot.from) / 100;
  const double drawn = mean * site.rng.uniform(0.5, 1.5);
  const int count = static_cast<int>(drawn + site.rng.uniform());
  for (int i = 0; i < count; ++i) {
    const double s = site.rng.uniform(lot.from, lot.to);
    put(site, lot, add, s, site.rng.uniform(from, to), radius);
  }
}

void add_lamps(Site& site, const Lot& lot) {
  const double spacing = site.population.lamp_spacing;
  const double share = site.rng.chance(0.7) ? 0.18 : 0.9;
  const bool lights = site.rng.chance(0.2);
  for (double s = lot.from + site.rng.uniform(0, spacing); s < lot.to; s += spacing) {
    put(site, lot, lights && site.rng.chance(0.3) ? add_traffic_light : add_lamp, s, share, 0.3);
  }
}

void add_street_trees(Site& site, const Lot& lot) {
  const double spacing = site.population.tree_spacing;
  const TreeShape alike = random_tree(site.rng);
  for (double s = lot.from + site.rng.uniform(0, spacing); s < lot.to; s += spacing) {
    TreeShape shape = alike;
    shape.crown_start = std::max(2.0, shape.crown_start * site.rng.uniform(0.85, 1.2));
    shape.trunk_radius *= site.rng.uniform(0.8, 1.2);
    const double d = lot.at(0.25);
    if (!site.claim(s, d, shape.trunk_radius + 0.3)) continue;
    add_tree(site.world, site.palette, site.flora, shape, site.terrain.upright(s, d), site.rng);
  }
}

}  // namespace

void build_sidewalk(Site& site, const Lot& lot) {
  if (site.rng.chance(0.8)) add_lamps(site, lot);
  if (site.population.street_trees) add_street_trees(site, lot);
  spread(site, lot, add_sign, 3, 0.1, 0.3, 0.3);
  spread(site, lot, add_bollard, 3, 0.08, 0.2, 0.2);
  spread(site, lot, add_bin, 3, 0.5, 0.95, 0.4);
  spread(site, lot, add_box, 1.2, 0.8, 0.95, 0.7);
  spread(site, lot, add_person, 1.5, 0.2, 0.9, 0.4);
  spread(site, lot, add_bicycle, 2, 0.1, 0.95, 0.7);
  spread(site, lot, add_bench, 0.7, 0.7, 0.9, 0.9);
  spread(site, lot, add_shelter, 0.3, 0.6, 0.8, 2.2);
  spread(site, lot, add_container, 0.15, 0.5, 0.6, 2.5);
}

void build_buildings(Site& site, const Lot& lot) {
  core::Rng& rng = site.rng;
  const bool detached = rng.chance(0.55);
  double s = lot.from;
  while (s < lot.to - 8) {
    const BuildingShape shape = random_building(rng, detached);
    const double setback = detached ? rng.uniform(0, 3) : rng.uniform(0, 0.4);
    const double end = s + shape.width;
    const bool blocked = site.terrain.in_crossing(s, 2) || site.terrain.in_crossing(end, 2) ||
                         site.terrain.in_crossing(0.5 * (s + end), 2 + shape.width / 2);
    if (!blocked && !rng.chance(0.06)) {
      const double d = lot.side * (lot.d + setback);
      const double corner = lot.side > 0 ? s : end;
      add_building(site.world, site.palette, shape, facing_out(site, lot, corner, d), rng);
    }
    s = end + (detached ? rng.uniform(2, 9) : rng.chance(0.15) ? 4 : 0.02);
  }
  spread(site, lot, add_bin, 2, -0.1, -0.03, 0.4);
}

}  // namespace saker::simulation
