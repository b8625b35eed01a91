#include "saker/simulation/world/populate.h"

#include <cmath>

#include "saker/simulation/world/populate_fleet.h"

namespace saker::simulation {

Population random_population(core::Rng& rng) {
  Population p;
  p.parked = rng.chance(0.4) ? rng.uniform(0.05, 0.3) : rng.uniform(0.3, 0.95);
  p.traffic = rng.uniform(0, 0.25);
  p.lamp_spacing = rng.uniform(12, 35);
  p.tree_spacing = rng.uniform(5, 14);
  p.street_trees = rng.chance(0.4);
  p.greenery = rng.uniform(0.4, 1.8);
  p.clutter = rng.uniform(0.3, 2);
  p.heavy = rng.uniform(0, 0.1);
  return p;
}

bool Site::free(double s, double d, double radius) const {
  for (const Disc& disc : taken_) {
    const double reach = disc.radius + radius;
    const double ds = disc.s - s;
    const double dd = disc.d - d;
    if (ds * ds + dd * dd < reach * reach) return false;
  }
  return true;
}

bool Site::claim(double s, double d, double radius) {
  if (terrain.in_crossing(s, radius) || !free(s, d, radius)) return false;
  taken_.push_back({s, d, radius});
  return true;
}

bool Site::claim(double s, double d, double yaw, double half_length, double half_width) {
  const int discs = 1 + 2 * static_cast<int>(std::ceil((half_length - half_width) / half_width));
  const double step = discs > 1 ? 2 * (half_length - half_width) / (discs - 1) : 0;
  const auto centre = [&](int i) {
    const double along = -(half_length - half_width) + i * step;
    return Disc{s + along * std::cos(yaw), d + along * std::sin(yaw), half_width};
  };
  for (int i = 0; i < discs; ++i) {
    const Disc disc = centre(i);
    if (terrain.in_crossing(disc.s, disc.radius) || !free(disc.s, disc.d, disc.radius))
      return false;
  }
  for (int i = 0; i < discs; ++i) taken_.push_back(centre(i));
  return true;
}

VehicleKind Site::next_kind() {
  using enum VehicleKind;
  if (rng.chance(population.heavy))
    return rng.chance(0.5) ? truck : rng.chance(0.4) ? bus : trailer;
  if (deck_.empty()) {
    deck_ = population.every_kind
                ? std::vector{sedan, hatchback, suv, van, pickup}
                : std::vector{sedan,     sedan, sedan, hatchback, hatchback, hatchback,
                              hatchback, suv,   suv,   van,       van,       pickup};
    for (int i = static_cast<int>(deck_.size()) - 1; i > 0; --i)
      std::swap(deck_[i], deck_[rng.index(i + 1)]);
  }
  const VehicleKind kind = deck_.back();
  deck_.pop_back();
  return kind;
}

namespace {

void build(Site& site, const Lot& lot) {
  switch (lot.strip->use) {
    case Use::none:
      return;
    case Use::lane:
      return build_lane(site, lot);
    case Use::parallel_parking:
      return build_parallel_parking(site, lot);
    case Use::perpendicular_parking:
      return build_perpendicular_parking(site, lot);
    case Use::sidewalk:
      return build_sidewalk(site, lot);
    case Use::verge:
      return build_verge(site, lot);
    case Use::island:
      return build_island(site, lot);
    case Use::garden:
      return build_garden(site, lot);
    case Use::lawn:
      return build_lawn(site, lot);
    case Use::tree_row:
      return build_tree_row(site, lot);
    case Use::forest:
      return build_forest(site, lot);
    case Use::buildings:
      return build_buildings(site, lot);
    case Use::thicket:
      return build_thicket(site, lot);
    case Use::barrier:
      return build_barrier(site, lot);
    case Use::houses:
    case Use::industry:
    case Use::border:
    case Use::square:
      return;  // reserve_street() and furnish_street() build these
  }
}

void build_side(Site& site, const std::vector<Strip>& strips, double side) {
  double d = 0;
  const double reach = site.terrain.shape().half_length - 4;
  for (const Strip& strip : strips) {
    const Lot lot{&strip, d, side, -reach, reach};
    build(site, lot);
    if (site.population.fleet != FleetTheme::none) add_street_life(site, lot);
    d += strip.width;
  }
}

}  // namespace

void populate(Site& site) {
  build_side(site, site.terrain.section().left, 1);
  build_side(site, site.terrain.section().right, -1);
}

}  // namespace saker::simulation
