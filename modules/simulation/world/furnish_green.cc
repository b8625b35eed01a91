#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/facades.h"
#include "saker/simulation/world/fences.h"
#include "saker/simulation/world/furnish_street.h"
#include "saker/simulation/world/street_furniture.h"

namespace saker::simulation {
namespace {

/// A place on the lot at random, at most 30 m deep.
struct Spot {
  double s, share;
};

Spot any_spot(StreetSite& street, const Lot& lot) {
  const double depth = std::min(1.0, 30 / lot.strip->width);
  return {street.rng.uniform(lot.from, lot.to), street.rng.uniform(0.05, 0.95) * depth};
}

void plant_trees(StreetSite& street, const Lot& lot, double per_100_m) {
  core::Rng& rng = street.rng;
  const int count = count_of(street, lot, per_100_m, street.theme.plants);
  const TreeHabit alike = any_habit(rng);
  const bool mixed = rng.chance(0.6);
  for (int i = 0; i < count; ++i) {
    const TreeHabit habit = rng.chance(0.05) ? TreeHabit::fallen : mixed ? any_habit(rng) : alike;
    const Spot at = any_spot(street, lot);
    if (!street.site.claim(at.s, lot.at(at.share), room_of(habit))) continue;
    add_street_tree(street.nursery(), habit, rng.uniform(0.7, 1.5),
                    facing_outwards(street, lot, at.s, at.share), rng);
  }
}

void plant_bushes(StreetSite& street, const Lot& lot, double per_100_m) {
  core::Rng& rng = street.rng;
  const int count = count_of(street, lot, per_100_m, street.theme.plants);
  for (int i = 0; i < count; ++i) {
    const double radius = rng.uniform(0.3, rng.chance(0.3) ? 2.2 : 1);
    const Spot at = any_spot(street, lot);
    if (!street.site.claim(at.s, lot.at(at.share), 0.7 * radius)) continue;
    add_any_bush(street.nursery(), facing_outwards(street, lot, at.s, at.share), radius,
                 radius * rng.uniform(0.7, 1.8), rng);
  }
}

void plant_ground(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  const int tufts =
      std::min(400, count_of(street, lot, rng.chance(0.4) ? 60 : 5, street.theme.plants));
  for (int i = 0; i < tufts; ++i) {
    const Spot at = any_spot(street, lot);
    add_tuft(street.nursery(), facing_outwards(street, lot, at.s, at.share), rng);
  }
  const int beds = count_of(street, lot, 2, street.theme.plants);
  for (int i = 0; i < beds; ++i) {
    const Spot at = any_spot(street, lot);
    const double length = rng.uniform(1, 8);
    const double depth = std::min(rng.uniform(0.5, 2.5), lot.strip->width);
    if (!street.site.claim(at.s, lot.at(at.share), 0, length / 2, depth / 2)) continue;
    add_bed(street.nursery(), facing_outwards(street, lot, at.s, at.share), length, depth, rng);
  }
}

/// Small and middling things; `share_from` to `share_to` of the lot's width.
void strew(StreetSite& street, const Lot& lot, double per_100_m, double from, double to) {
  core::Rng& rng = street.rng;
  const int count = count_of(street, lot, per_100_m, street.theme.furniture);
  for (int i = 0; i < count; ++i) {
    const Furnishing thing = rng.chance(0.6) ? any_small_thing(rng) : any_middling_thing(rng);
    const double s = rng.uniform(lot.from, lot.to);
    const double share = rng.uniform(from, to);
    if (2 * thing.half_width > lot.strip->width) continue;
    const double length = std::max(thing.half_length, thing.half_width);
    if (!street.site.claim(s, lot.at(share), 0, length, thing.half_width)) continue;
    const double turn = rng.chance(0.7) ? 0 : rng.normal(0, 0.4);
    thing.add(street.site.world, street.palette,
              facing_outwards(street, lot, s, share) * placed(0, 0, 0, turn), rng);
  }
}

void raise_poles(StreetSite& street, const Lot& lot, double per_100_m, double share) {
  core::Rng& rng = street.rng;
  const int count = count_of(street, lot, per_100_m, street.theme.poles);
  if (count == 0) return;
  const StreetAdder alike = any_pole(rng);
  const bool in_row = rng.chance(0.5);
  const double spacing = (lot.to - lot.from) / count;
  for (int i = 0; i < count; ++i) {
    const double s = in_row ? lot.from + (i + 0.5) * spacing : rng.uniform(lot.from, lot.to);
    if (!street.site.claim(s, lot.at(share), 0.35)) continue;
    (in_row ? alike : any_pole(rng))(street.site.world, street.palette,
                                     facing_outwards(street, lot, s, share), rng);
  }
}

/// Bollards in rows along the kerb.
void row_up(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  const int rows = count_of(street, lot, 1.5, street.theme.furniture);
  for (int i = 0; i < rows; ++i) {
    const double s = rng.uniform(lot.from + 10, lot.to - 20);
    if (street.site.terrain.in_crossing(s, 20)) continue;
    const double start = lot.side > 0 ? s : s + 10;
    if (!street.site.claim(s + 5, lot.at(0.12), 0, 5, 0.25)) continue;
    add_bollard_row(street.site.world, street.palette, facing_outwards(street, lot, start, 0.12),
                    rng);
  }
}

/// Trees in squares of earth or grates, in a row.
void plant_avenue(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  if (!rng.chance(0.35 * street.theme.plants)) return;
  const TreeHabit habit = any_habit(rng);
  if (room_of(habit) > lot.strip->width / 2) return;
  const double spacing = rng.uniform(5, 15);
  const double size = rng.uniform(0.7, 1.4);
  for (double s = lot.from + rng.uniform(0, spacing); s < lot.to; s += spacing) {
    if (!street.site.claim(s, lot.at(0.25), room_of(habit))) continue;
    const SE3 T = facing_outwards(street, lot, s, 0.25);
    add_street_tree(street.nursery(), habit, size * rng.uniform(0.85, 1.15), T, rng);
    Pen(street.site.world.mesh, T).box({-0.5, -0.5, -0.3}, {0.5, 0.5, 0.02}, street.palette.soil);
  }
}

void put_planters(StreetSite& street, const Lot& lot, double per_100_m) {
  core::Rng& rng = street.rng;
  const int count = count_of(street, lot, per_100_m, street.theme.plants);
  for (int i = 0; i < count; ++i) {
    const Spot at = any_spot(street, lot);
    if (!street.site.claim(at.s, lot.at(at.share), 0.9)) continue;
    add_planter(street.nursery(), facing_outwards(street, lot, at.s, at.share), rng);
  }
}

}  // namespace

void furnish_walk(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  plant_avenue(street, lot);
  raise_poles(street, lot, 5, rng.chance(0.7) ? 0.12 : 0.9);
  row_up(street, lot);
  if (lot.strip->width > 1.3) {
    strew(street, lot, 6, 0.1, 0.3);
    strew(street, lot, 8, 0.75, 0.97);
  }
  if (lot.strip->width > 2.2) put_planters(street, lot, 2);
  const Terrain& terrain = street.site.terrain;
  if (terrain.shape().crossing > 1e8 || !rng.chance(0.5)) return;
  for (const double end : {-1.0, 1.0}) {
    const double s = terrain.shape().crossing + end * (terrain.shape().crossing_half_width + 1);
    add_mast_light(street.site.world, street.palette, facing_outwards(street, lot, s, 0.15), rng);
  }
}

void furnish_square(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  const int large = count_of(street, lot, 9, street.theme.furniture);
  for (int i = 0; i < large; ++i) {
    const Furnishing thing = any_car_sized_thing(rng);
    const double s = rng.uniform(lot.from, lot.to);
    const double share = rng.uniform(0.1, 0.9);
    if (!street.site.claim(s, lot.at(share), 0, std::max(thing.half_length, thing.half_width),
                           thing.half_width))
      continue;
    thing.add(street.site.world, street.palette, facing_outwards(street, lot, s, share), rng);
  }
  strew(street, lot, 25, 0.05, 0.95);
  put_planters(street, lot, 6);
  raise_poles(street, lot, 6, rng.uniform(0.1, 0.9));
  plant_trees(street, lot, 6);
  row_up(street, lot);
}

void furnish_green(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  const double depth = std::min(lot.strip->width, 30.0);
  const bool wild = lot.strip->use == Use::forest || lot.strip->use == Use::thicket;
  plant_trees(street, lot, depth * (wild ? 0.8 : 0.3));
  plant_bushes(street, lot, depth * rng.uniform(0.3, wild ? 2 : 1.2));
  plant_ground(street, lot);
  if (wild) return;
  strew(street, lot, 1.5, 0.1, 0.9);
  raise_poles(street, lot, 2, rng.uniform(0.1, 0.6));
  if (lot.strip->use == Use::garden && lot.strip->width > 4) {
    const int sheds = count_of(street, lot, 1, 1);
    for (int i = 0; i < sheds; ++i) {
      const double s = rng.uniform(lot.from, lot.to);
      if (street.site.claim(s, lot.at(0.7), 0, 3.2, 1.7))
        add_shed(street.site.world, street.palette, facing_outwards(street, lot, s, 0.7), rng);
    }
  }
}

}  // namespace saker::simulation
