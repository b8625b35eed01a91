#include "saker/simulation/world/layout_town.h"

#include <algorithm>
#include <numbers>

#include "saker/simulation/world/ground_details.h"

namespace saker::simulation {
namespace {

using Strips = std::vector<Strip>;

constexpr double kReach = 62;  ///< m from the middle line to the edge of the world

void fill_up(Strips& strips, MaterialId surface, Use use) {
  double width = 0;
  for (const Strip& strip : strips) width += strip.width;
  if (width + 3 < kReach) strips.push_back({kReach - width, surface, use, 0, 0});
}

double any_kerb(core::Rng& rng) { return rng.chance(0.2) ? 0 : rng.uniform(0.03, 0.18); }

/// European: five metres of road in all, a strip to walk on or none, fronts at once.
Strips narrow_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  strips.push_back({rng.uniform(1.6, 2.8), p.asphalt, Use::lane, 0, -0.02});
  if (rng.chance(0.35))
    strips.push_back({rng.uniform(1.9, 2.2), p.parking, Use::parallel_parking, any_kerb(rng), 0});
  if (rng.chance(0.85))
    strips.push_back({rng.uniform(0.6, 2), p.paving, Use::sidewalk, any_kerb(rng), 0.02});
  if (rng.chance(0.2)) strips.push_back({0.5, p.grass, Use::border, 0, 0});
  strips.push_back({14, p.yard, Use::houses, 0, 0});
  fill_up(strips, p.meadow, Use::forest);
  return strips;
}

/// American: two or three lanes of 3.5 m to a side, a median, lawns before houses far away.
Strips avenue_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  if (rng.chance(0.6)) {
    strips.push_back({rng.uniform(0.6, 3), rng.chance(0.5) ? p.grass : p.paving,
                      rng.chance(0.5) ? Use::island : Use::none, 0, 0});
    strips.push_back({0.15, p.marking, Use::none, -any_kerb(rng), 0});
  }
  const int lanes = 2 + rng.index(2);
  for (int i = 0; i < lanes; ++i) {
    strips.push_back({rng.uniform(3.3, 3.7), p.asphalt, Use::lane, 0, -0.015});
    if (i + 1 < lanes) strips.push_back({0.12, p.marking, Use::none, 0, 0});
  }
  if (rng.chance(0.6))
    strips.push_back({rng.uniform(2.2, 2.7), p.asphalt, Use::parallel_parking, 0, 0});
  if (rng.chance(0.5)) strips.push_back({rng.uniform(1, 3), p.grass, Use::verge, any_kerb(rng), 0});
  strips.push_back({rng.uniform(1.5, 4), p.paving, Use::sidewalk, any_kerb(rng), 0.02});
  if (rng.chance(0.6)) {
    const double slope = rng.chance(0.4) ? rng.uniform(0.05, 0.15) : rng.normal(0, 0.03);
    strips.push_back({rng.uniform(4, 12), p.grass, Use::garden, 0, slope});
  }
  strips.push_back({16, p.yard, Use::houses, 0, 0});
  fill_up(strips, p.meadow, Use::forest);
  return strips;
}

Strips industry_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  strips.push_back({rng.uniform(3, 4.5), p.asphalt, Use::lane, 0, -0.015});
  if (rng.chance(0.5)) strips.push_back({2.6, p.parking, Use::parallel_parking, 0, 0});
  if (rng.chance(0.6))
    strips.push_back({rng.uniform(1.5, 3), p.paving, Use::sidewalk, any_kerb(rng), 0});
  strips.push_back({0.8, p.grass, Use::border, 0, 0});
  if (rng.chance(0.5)) strips.push_back({5, p.parking, Use::perpendicular_parking, 0, 0});
  strips.push_back({rng.uniform(18, 34), p.yard, Use::industry, 0, rng.normal(0, 0.01)});
  fill_up(strips, p.meadow, rng.chance(0.5) ? Use::thicket : Use::forest);
  return strips;
}

Strips square_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  const bool traffic = rng.chance(0.5);
  strips.push_back({rng.uniform(2.2, 3.5), traffic ? p.asphalt : p.paving,
                    traffic ? Use::lane : Use::none, 0, 0});
  if (rng.chance(0.3)) strips.push_back({5, p.parking, Use::perpendicular_parking, 0, 0});
  strips.push_back({rng.uniform(6, 25), p.paving, Use::square, traffic ? any_kerb(rng) : 0,
                    rng.normal(0, 0.015)});
  if (rng.chance(0.4)) strips.push_back({rng.uniform(2, 5), p.grass, Use::tree_row, 0.05, 0});
  strips.push_back({14, p.yard, Use::houses, 0, 0});
  fill_up(strips, p.meadow, Use::forest);
  return strips;
}

bool soft(Use use) {
  return use == Use::verge || use == Use::garden || use == Use::lawn || use == Use::tree_row ||
         use == Use::forest || use == Use::thicket;
}

/// What a world's roads and walks are made of.
struct Surfaces {
  MaterialId asphalt, parking, paving;
};

void vary_side(std::vector<Strip>& strips, core::Rng& rng) {
  const double rough = rng.chance(0.5) ? rng.uniform(0.01, 0.1) : 0;
  const bool banks = rng.chance(0.3);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    Strip& strip = strips[i];
    if (strip.use == Use::buildings && rng.chance(0.85)) strip.use = Use::houses;
    if (strip.use == Use::barrier && rng.chance(0.7)) strip.use = Use::border;
    if (strip.kerb > 0.02) strip.kerb = rng.uniform(0.03, 0.18);
    if (i > 1 && soft(strip.use)) {
      strip.rough = rough * std::min(1.0, strip.width / 4);
      if (banks && strip.width < 12 && rng.chance(0.4)) strip.slope = rng.uniform(-0.45, 0.45);
    }
  }
}

}  // namespace

std::vector<Strip> town_side(WorldKind kind, const Palette& p, core::Rng& rng) {
  switch (kind) {
    case WorldKind::avenue:
      return avenue_side(p, rng);
    case WorldKind::industry:
      return industry_side(p, rng);
    case WorldKind::square:
      return square_side(p, rng);
    default:
      return narrow_side(p, rng);
  }
}

void vary_section(CrossSection& section, World& world, const StreetPalette& p, core::Rng& rng) {
  const Surfaces other{
      rng.chance(0.12) ? p.cobble : p.asphalt,
      rng.chance(0.15) ? labelled(world, p.gravel, kParking) : p.parking,
      rng.chance(0.15) ? labelled(world, p.cobble, kSidewalk) : p.paving,
  };
  for (std::vector<Strip>* side : {&section.left, &section.right}) {
    vary_side(*side, rng);
    for (Strip& strip : *side) {
      if (strip.surface == p.asphalt) strip.surface = other.asphalt;
      if (strip.surface == p.parking) strip.surface = other.parking;
      if (strip.surface == p.paving) strip.surface = other.paving;
      const bool green = strip.surface == p.grass || strip.surface == p.meadow;
      if (green && rng.chance(0.12)) strip.surface = rng.chance(0.6) ? p.soil : p.gravel;
    }
  }
}

void vary_ground(TerrainShape& t, WorldKind kind, core::Rng& rng) {
  t.step_m = 0.5;
  t.lump_phase = rng.uniform(0, 2 * std::numbers::pi);
  const bool flat = kind == WorldKind::car_park || kind == WorldKind::square;
  if (rng.chance(flat ? 0.1 : 0.4)) {  // up, and perhaps down again
    const double slope =
        (rng.chance(0.5) ? 1 : -1) * rng.uniform(0.03, rng.chance(0.25) ? 0.15 : 0.08);
    const double from = rng.uniform(-60, 30);
    const double length = rng.uniform(8, 35);
    t.ramps.push_back({from, from + length, slope});
    if (rng.chance(0.6)) {
      const double next = from + length + rng.uniform(0, 15);
      t.ramps.push_back({next, next + length, -slope});
    }
  }
  const int swells = rng.chance(0.5) ? 0 : 1 + rng.index(5);
  for (int i = 0; i < swells; ++i) {  // beside the road
    const double d = (rng.chance(0.5) ? 1 : -1) * rng.uniform(14, 40);
    t.swells.push_back({rng.uniform(-60, 60), d, rng.uniform(0.5, 8), rng.uniform(0.5, 4),
                        rng.uniform(1.5, 5), rng.normal(0, 0.7)});
  }
  for (int i = 0; i < 6; ++i) {  // potholes and sunken covers
    if (!rng.chance(0.4)) continue;
    t.swells.push_back({rng.uniform(-60, 60), rng.uniform(-5, 5), 0.2, 0.2, rng.uniform(0.3, 1),
                        -rng.uniform(0.02, 0.07)});
  }
  for (const double side : {-1.0, 1.0}) {
    for (double s = -85 + rng.uniform(0, 25); s < 85; s += rng.uniform(9, 40))
      t.dropped.push_back({side, s, s + rng.uniform(1.2, 5)});
  }
  if (t.crossing < 1e8) t.dropped.push_back({1, t.crossing - 9, t.crossing + 9});
}

}  // namespace saker::simulation
