#include "saker/simulation/world/furnish_street.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/facades.h"
#include "saker/simulation/world/fences.h"
#include "saker/simulation/world/ground_details.h"
#include "saker/simulation/world/street_furniture.h"

namespace saker::simulation {
namespace {

using Builder = void (*)(StreetSite&, const Lot&);

void each_lot(StreetSite& street, Builder build) {
  const CrossSection& section = street.site.terrain.section();
  const double reach = street.site.terrain.shape().half_length - 4;
  for (const double side : {1.0, -1.0}) {
    double d = 0;
    for (const Strip& strip : side > 0 ? section.left : section.right) {
      build(street, {&strip, d, side, -reach, reach});
      d += strip.width;
    }
  }
}

/// A hedge, container or stall where a vehicle could stand.
void stand_in(StreetSite& street, const Lot& lot, double s, double share, double yaw) {
  core::Rng& rng = street.rng;
  const bool plant = rng.chance(0.5);
  const Furnishing thing = any_car_sized_thing(rng);
  const double length = plant ? 3.1 : thing.half_length;
  const double width = plant ? 1.2 : thing.half_width;
  if (!street.site.claim(s, lot.at(share), yaw, std::max(length, width), width)) return;
  const SE3 T = facing_outwards(street, lot, s, share) * placed(0, 0, 0, yaw);
  if (plant) return add_car_sized_bush(street.nursery(), T, rng);
  thing.add(street.site.world, street.palette, T, rng);
}

/// Where they stand on the strip, or nowhere.
void reserve_lot(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  const Use use = lot.strip->use;
  const bool parallel = use == Use::parallel_parking;
  const bool across = use == Use::perpendicular_parking;
  if (parallel || across) {
    const int count = count_of(street, lot, 40 * street.theme.stand_ins, 1);
    for (int i = 0; i < count; ++i)
      stand_in(street, lot, rng.uniform(lot.from, lot.to), 0.5,
               (across ? std::numbers::pi / 2 : 0) + rng.normal(0, 0.03));
  }
  const bool green = use == Use::verge || use == Use::garden || use == Use::lawn ||
                     use == Use::tree_row || use == Use::island;
  const bool wide_walk = use == Use::sidewalk && lot.strip->width > 2.6;
  if (green || wide_walk) {
    const int count = count_of(street, lot, green ? 3 : 1, street.theme.plants);
    for (int i = 0; i < count; ++i)
      stand_in(street, lot, rng.uniform(lot.from, lot.to), rng.uniform(0.3, 0.7),
               rng.chance(0.6) ? 0 : rng.uniform(-1.5, 1.5));
  }
  if (use == Use::houses) build_houses(street, lot);
  if (use == Use::industry) build_industry(street, lot);
  if (use == Use::border) build_border(street, lot, 0.5);
  if (use == Use::garden && rng.chance(0.5 * street.theme.fences)) build_border(street, lot, 0.06);
}

void furnish_lot(StreetSite& street, const Lot& lot) {
  switch (lot.strip->use) {
    case Use::sidewalk:
      return furnish_walk(street, lot);
    case Use::square:
      return furnish_square(street, lot);
    case Use::verge:
    case Use::island:
    case Use::garden:
    case Use::lawn:
    case Use::tree_row:
    case Use::forest:
    case Use::thicket:
      return furnish_green(street, lot);
    default:
      return;
  }
}

/// A factor of which a fifth is zero and the rest spreads over a decade.
double any_factor(core::Rng& rng) {
  return rng.chance(0.15) ? 0 : std::pow(10.0, rng.uniform(-0.6, 0.4));
}

}  // namespace

StreetTheme random_theme(core::Rng& rng) {
  StreetTheme t;
  t.stand_ins = rng.chance(0.25) ? 0 : rng.uniform(0.02, 0.25);
  t.plants = any_factor(rng);
  t.furniture = any_factor(rng);
  t.poles = any_factor(rng);
  t.fences = any_factor(rng);
  t.works = rng.chance(0.25) ? rng.uniform(0.3, 1) : 0;
  t.wet = rng.chance(0.3) ? rng.uniform(0.2, 1.5) : 0;
  t.tram = rng.chance(0.08);
  t.winter = rng.chance(0.08);
  t.marked = rng.chance(0.6);
  return t;
}

SE3 facing_outwards(const StreetSite& street, const Lot& lot, double s, double share) {
  return street.site.terrain.upright(s, lot.at(share), lot.side > 0 ? 0 : std::numbers::pi);
}

int count_of(StreetSite& street, const Lot& lot, double per_100_m, double factor) {
  const double mean = per_100_m * factor * (lot.to - lot.from) / 100;
  return static_cast<int>(mean * street.rng.uniform(0.5, 1.5) + street.rng.uniform());
}

void reserve_street(StreetSite& street) { each_lot(street, reserve_lot); }

void furnish_street(StreetSite& street) { each_lot(street, furnish_lot); }

}  // namespace saker::simulation
