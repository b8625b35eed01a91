#include "saker/simulation/world/layout.h"

#include <numbers>

#include "saker/simulation/world/layout_town.h"

namespace saker::simulation {
namespace {

using Strips = std::vector<Strip>;

/// Fills the ground up to the edge of the world.
void add_background(Strips& strips, const Palette& p, core::Rng& rng) {
  constexpr double kReach = 62;
  double width = 0;
  for (const Strip& strip : strips) width += strip.width;
  if (width + 4 >= kReach) return;
  const double draw = rng.uniform();
  const MaterialId surface = rng.chance(0.75) ? p.meadow : p.yard;
  const Use near = draw < 0.4 ? Use::lawn : draw < 0.75 ? Use::forest : Use::none;
  const double open = std::min(0.7 * (kReach - width), rng.uniform(3, 40));
  strips.push_back({open, surface, near, 0, rng.normal(0, 0.03)});
  width += open;
  const double end = rng.uniform();
  const Use far = end < 0.3 ? Use::buildings : end < 0.6 ? Use::thicket : Use::forest;
  strips.push_back({kReach - width, surface, far, 0, rng.normal(0, 0.05)});
}

void add_parking(Strips& strips, const Palette& p, core::Rng& rng) {
  const double draw = rng.uniform();
  const double kerb = rng.chance(0.2) ? 0.03 : 0;
  if (draw < 0.55) {
    strips.push_back({rng.uniform(2.0, 2.5), p.parking, Use::parallel_parking, kerb, 0.02});
  } else if (draw < 0.66) {
    strips.push_back({rng.uniform(4.8, 5.6), p.parking, Use::perpendicular_parking, kerb, 0.01});
  }
}

/// One side of a street: lane, parking, sidewalk, garden, houses.
Strips street_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  const double lane = rng.uniform(2.3, 3.4);
  strips.push_back({0.08, p.marking, Use::none, 0, 0});
  strips.push_back({lane, p.asphalt, Use::lane, 0, -0.02});
  add_parking(strips, p, rng);
  if (rng.chance(0.35)) {
    strips.push_back({rng.uniform(0.8, 3), p.grass, Use::verge, 0.1, 0.02});
    strips.push_back({rng.uniform(1.4, 2.8), p.paving, Use::sidewalk, 0, 0.02});
  } else {
    strips.push_back(
        {rng.uniform(1.4, 3.6), p.paving, Use::sidewalk, rng.uniform(0.05, 0.16), 0.02});
  }
  if (rng.chance(0.7)) {
    strips.push_back({rng.uniform(2, 8), p.grass, Use::garden, 0, rng.normal(0, 0.06)});
  }
  if (rng.chance(0.25)) strips.push_back({rng.uniform(1, 6), p.meadow, Use::thicket, 0, 0});
  if (rng.chance(0.75)) strips.push_back({14, p.yard, Use::buildings, 0, 0});
  add_background(strips, p, rng);
  return strips;
}

Strips car_park_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  const double aisle = rng.uniform(5, 7);
  strips.push_back({aisle / 2, rng.chance(0.5) ? p.parking : p.asphalt, Use::none, 0, -0.01});
  const int rows = 1 + rng.index(3);
  for (int i = 0; i < rows; ++i) {
    strips.push_back({5, p.parking, Use::perpendicular_parking, 0, 0.0});
    if (rng.chance(0.6)) {
      strips.push_back({rng.uniform(1.2, 3), p.grass, Use::island, 0.1, 0});
    } else if (rng.chance(0.4)) {
      strips.push_back({rng.uniform(1.5, 2.5), p.paving, Use::sidewalk, 0.1, 0});
    }
    if (i + 1 == rows) break;
    strips.push_back({5, p.parking, Use::perpendicular_parking, 0, 0});
    strips.push_back({aisle, p.asphalt, Use::none, 0, 0});
  }
  strips.push_back({rng.uniform(2, 6), p.grass,
                    rng.chance(0.4)   ? Use::verge
                    : rng.chance(0.5) ? Use::thicket
                                      : Use::tree_row,
                    0.08, rng.normal(0, 0.08)});
  if (rng.chance(0.5)) strips.push_back({0.6, p.yard, Use::barrier, 0, 0});
  if (rng.chance(0.5)) strips.push_back({14, p.yard, Use::buildings, 0, 0});
  add_background(strips, p, rng);
  return strips;
}

Strips country_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  strips.push_back({rng.uniform(2.4, 3.6), p.asphalt, Use::lane, 0, -0.02});
  if (rng.chance(0.3)) add_parking(strips, p, rng);
  if (rng.chance(0.25)) strips.push_back({rng.uniform(1.4, 2.5), p.paving, Use::sidewalk, 0.08, 0});
  strips.push_back({rng.uniform(1, 4), p.grass, Use::verge, -0.02, -0.04});
  if (rng.chance(0.45)) {
    const double depth = rng.uniform(0.15, 0.45);
    strips.push_back({1, p.meadow, Use::none, 0, -depth});
    strips.push_back({1, p.meadow, Use::none, 0, depth});
  }
  const double slope = rng.normal(0, 0.14);
  const double draw = rng.uniform();
  if (draw < 0.45) {
    strips.push_back({rng.uniform(3, 9), p.meadow, Use::tree_row, 0, slope});
  } else if (draw < 0.75) {
    strips.push_back({rng.uniform(2, 7), p.meadow, Use::verge, 0, slope});
  }
  if (rng.chance(0.25)) strips.push_back({0.6, p.grass, Use::barrier, 0, 0});
  if (rng.chance(0.45)) strips.push_back({rng.uniform(2, 9), p.meadow, Use::thicket, 0, slope});
  if (rng.chance(0.4)) strips.push_back({rng.uniform(15, 30), p.meadow, Use::forest, 0, slope / 2});
  if (rng.chance(0.2)) strips.push_back({16, p.grass, Use::buildings, 0, 0});
  add_background(strips, p, rng);
  return strips;
}

Strips highway_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  strips.push_back({rng.uniform(0.8, 3), p.grass, Use::barrier, 0, 0});
  const int lanes = 2 + rng.index(2);
  for (int i = 0; i < lanes; ++i) {
    strips.push_back({0.14, p.marking, Use::none, 0, 0});
    strips.push_back({3.6, p.asphalt, Use::lane, 0, -0.02});
  }
  strips.push_back({rng.uniform(0.8, 2.8), p.asphalt, Use::none, 0, -0.02});
  if (rng.chance(0.7)) strips.push_back({0.6, p.grass, Use::barrier, 0, 0});
  strips.push_back({rng.uniform(3, 9), p.meadow, Use::verge, 0, rng.normal(0, 0.2)});
  if (rng.chance(0.5)) strips.push_back({rng.uniform(2, 9), p.meadow, Use::thicket, 0, 0.1});
  if (rng.chance(0.6)) strips.push_back({rng.uniform(4, 20), p.meadow, Use::forest, 0, 0.05});
  add_background(strips, p, rng);
  return strips;
}

Strips campus_side(const Palette& p, core::Rng& rng) {
  Strips strips;
  strips.push_back(
      {rng.uniform(1.5, 3), rng.chance(0.6) ? p.paving : p.yard, Use::sidewalk, 0, -0.01});
  strips.push_back({rng.uniform(8, 28), p.grass, Use::lawn, 0.02, rng.normal(0, 0.05)});
  if (rng.chance(0.5)) {
    strips.push_back({rng.uniform(2, 4), p.paving, Use::sidewalk, 0, 0});
    add_parking(strips, p, rng);
    strips.push_back({5, p.asphalt, Use::lane, 0, 0});
  }
  if (rng.chance(0.6)) strips.push_back({14, p.yard, Use::buildings, 0, 0});
  strips.push_back({rng.uniform(5, 15), p.grass, Use::lawn, 0, rng.normal(0, 0.05)});
  add_background(strips, p, rng);
  return strips;
}

Strips random_side(WorldKind kind, const Palette& p, core::Rng& rng) {
  switch (kind) {
    case WorldKind::car_park:
      return car_park_side(p, rng);
    case WorldKind::country:
      return country_side(p, rng);
    case WorldKind::highway:
      return highway_side(p, rng);
    case WorldKind::campus:
      return campus_side(p, rng);
    case WorldKind::narrow:
    case WorldKind::avenue:
    case WorldKind::industry:
    case WorldKind::square:
      return town_side(kind, p, rng);
    default:
      return street_side(p, rng);
  }
}

}  // namespace

WorldKind any_world(core::Rng& rng) {
  const double draw = rng.uniform();
  if (draw < 0.28) return WorldKind::street;
  if (draw < 0.37) return WorldKind::car_park;
  if (draw < 0.5) return WorldKind::country;
  if (draw < 0.55) return WorldKind::highway;
  if (draw < 0.64) return WorldKind::campus;
  if (draw < 0.76) return WorldKind::narrow;
  if (draw < 0.88) return WorldKind::avenue;
  return draw < 0.94 ? WorldKind::industry : WorldKind::square;
}

CrossSection random_section(WorldKind kind, const Palette& palette, core::Rng& rng) {
  CrossSection section;
  section.left = random_side(kind, palette, rng);
  section.right = random_side(kind, palette, rng);
  return section;
}

TerrainShape random_terrain(WorldKind kind, const Palette& palette, core::Rng& rng) {
  TerrainShape t;
  const bool steep = kind == WorldKind::country || rng.chance(0.25);
  t.bend_m = kind == WorldKind::car_park ? 0 : std::abs(rng.normal(0, 3));
  t.bend_period_m = rng.uniform(180, 320);
  t.bend_phase = rng.uniform(0, 2 * std::numbers::pi);
  t.grade = rng.normal(0, steep ? 0.045 : 0.012);
  t.side_slope = rng.normal(0, steep ? 0.03 : 0.008);
  t.relief_m = kind == WorldKind::car_park ? rng.uniform(0.01, 0.06) : rng.uniform(0.03, 0.25);
  t.roughness_m = rng.uniform(0.004, 0.015);
  t.crossing_surface = palette.asphalt;
  const bool town = kind == WorldKind::street || kind == WorldKind::narrow ||
                    kind == WorldKind::avenue || kind == WorldKind::industry;
  if (town && rng.chance(0.5)) {
    t.crossing = rng.uniform(-40, 40);
    t.crossing_half_width = rng.uniform(3, 6);
  }
  return t;
}

}  // namespace saker::simulation
