#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/facades.h"
#include "saker/simulation/world/fences.h"
#include "saker/simulation/world/furnish_street.h"
#include "saker/simulation/world/ground_details.h"
#include "saker/simulation/world/street_furniture.h"

namespace saker::simulation {
namespace {

bool in_crossing(const StreetSite& street, double from, double to) {
  const Terrain& t = street.site.terrain;
  return t.in_crossing(0.5 * (from + to), 1.5 + 0.5 * (to - from));
}

/// What stands in the gap between two houses.
void fill_gap(StreetSite& street, const Lot& lot, double from, double to) {
  core::Rng& rng = street.rng;
  if (to - from < 1.5 || rng.chance(0.3)) return;
  const double start = lot.side > 0 ? from : to;
  const SE3 T = facing_outwards(street, lot, start, rng.uniform(0.01, 0.2));
  World& world = street.site.world;
  const double draw = rng.uniform();
  if (draw < 0.35) {
    add_gate(world, street.palette, T, to - from - 0.3, rng);
  } else if (draw < 0.7) {
    add_boundary(world, street.palette, any_boundary(rng), T, to - from, rng.uniform(0.8, 2.4));
  } else {
    add_shed(world, street.palette, facing_outwards(street, lot, 0.5 * (from + to), 0.4), rng);
  }
}

/// The house at s, of any kind; ivy or a scaffold before some.
void build_house(StreetSite& street, const Lot& lot, double s, const BuildingShape& shape,
                 double setback, bool arcades) {
  core::Rng& rng = street.rng;
  World& world = street.site.world;
  const double corner = lot.side > 0 ? s : s + shape.width;
  const SE3 T = facing_outwards(street, lot, corner, setback / lot.strip->width);
  if (arcades && shape.storeys >= 2) {
    add_arcade(world, street.palette, shape, T, rng);
  } else {
    add_house(world, street.palette, shape, T, rng);
  }
  if (rng.chance(0.12 * street.theme.plants))
    add_ivy(street.nursery(), T, shape.width * rng.uniform(0.3, 1), rng.uniform(2, 6), rng);
  if (rng.chance(0.15 * street.theme.works + 0.01))
    add_scaffold(world, street.palette, T, shape.width, shape.storeys * shape.storey_height);
}

/// One fence or hedge of a kind along a stretch, with gates.
void build_stretch(StreetSite& street, const Lot& lot, double from, double to, double share,
                   Boundary kind, double height) {
  constexpr double kPiece = 2.5;
  core::Rng& rng = street.rng;
  const bool ivy = rng.chance(0.08);
  for (double s = from; s < to; s += kPiece) {
    if (in_crossing(street, s, s + kPiece)) continue;
    const double start = lot.side > 0 ? s : s + kPiece;
    SE3 T =
        street.site.terrain.on_ground(start, lot.at(share), lot.side > 0 ? 0 : std::numbers::pi);
    if (rng.chance(0.07)) {
      add_gate(street.site.world, street.palette, T, kPiece, rng);
      continue;
    }
    add_boundary(street.site.world, street.palette, kind, T, kPiece, height);
    if (ivy) add_ivy(street.nursery(), T, kPiece, height, rng);
  }
}

void grow_stretch(StreetSite& street, const Lot& lot, double from, double to, double share,
                  const HedgeSize& like) {
  const Nursery nursery = street.nursery();
  HedgeSize size = like;
  for (double s = from; s + size.length <= to; s += size.length) {
    if (in_crossing(street, s, s + size.length) || street.rng.chance(0.06)) continue;
    const double d = lot.at(share);
    if (!street.site.claim(s + size.length / 2, d, 0, size.length / 2, size.depth / 2)) continue;
    add_clipped_hedge(nursery, size, street.site.terrain.on_ground(s, d), street.rng);
  }
}

}  // namespace

void build_houses(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  const bool detached = rng.chance(0.45);
  const bool arcades = !detached && rng.chance(0.2);
  double s = lot.from;
  while (s < lot.to - 8) {
    const BuildingShape shape = random_building(rng, detached);
    const double setback = detached ? rng.uniform(0, 3) : rng.uniform(0, 0.6);
    const double end = s + shape.width;
    if (!in_crossing(street, s, end) && !rng.chance(0.06))
      build_house(street, lot, s, shape, setback, arcades);
    const double gap = detached ? rng.uniform(2, 9) : rng.chance(0.15) ? 4 : 0.02;
    if (!in_crossing(street, end, end + gap)) fill_gap(street, lot, end, end + gap);
    s = end + gap;
  }
}

void build_industry(StreetSite& street, const Lot& lot) {
  core::Rng& rng = street.rng;
  World& world = street.site.world;
  const double yard = rng.uniform(6, 12);
  for (double s = lot.from; s < lot.to - 20;) {
    const double width = rng.uniform(14, 40);
    const double corner = lot.side > 0 ? s : s + width;
    if (!in_crossing(street, s, s + width)) {
      const SE3 T = facing_outwards(street, lot, corner, yard / lot.strip->width);
      if (rng.chance(0.25)) {
        add_deck(world, street.palette, width, lot.strip->width - yard, T, rng);
      } else {
        add_hall(world, street.palette, width, lot.strip->width - yard, rng.uniform(4, 11), T, rng);
      }
    }
    s += width + rng.uniform(3, 12);
  }
  const int things = count_of(street, lot, 14, 0.3 + street.theme.furniture);
  for (int i = 0; i < things; ++i) {
    const Furnishing thing = rng.chance(0.6) ? any_car_sized_thing(rng) : any_middling_thing(rng);
    const double s = rng.uniform(lot.from, lot.to);
    const double share = rng.uniform(0.1, 0.85) * yard / lot.strip->width;
    const double yaw = rng.chance(0.7) ? 0 : rng.uniform(-1.6, 1.6);
    if (!street.site.claim(s, lot.at(share), yaw, std::max(thing.half_length, thing.half_width),
                           thing.half_width))
      continue;
    thing.add(world, street.palette, facing_outwards(street, lot, s, share) * placed(0, 0, 0, yaw),
              rng);
  }
}

void build_border(StreetSite& street, const Lot& lot, double share) {
  core::Rng& rng = street.rng;
  for (double s = lot.from; s < lot.to;) {
    const double end = std::min(lot.to, s + rng.uniform(8, 60));
    const double draw = rng.uniform();
    if (draw < 0.4) {
      HedgeSize size{rng.uniform(1, 5), rng.uniform(0.3, 2.0), rng.uniform(0.3, 3)};
      size.depth = std::min(size.depth, std::max(0.5, 2 * lot.strip->width));
      grow_stretch(street, lot, s, end, share, size);
    } else if (draw < 0.9) {
      build_stretch(street, lot, s, end, share, any_boundary(rng), rng.uniform(0.6, 2.4));
    }
    s = end;
  }
}

}  // namespace saker::simulation
