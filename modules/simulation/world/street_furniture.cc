#include "saker/simulation/world/street_furniture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

MaterialId any_plastic(World& world, const StreetPalette& p, core::Rng& rng) {
  return any_tint(world, p.plastic, 0.05, 0.7, rng);
}

/// One upright bin on two wheels, its lid higher at the back.
void draw_wheelie(Pen& pen, double half, double height, MaterialId m) {
  const double foot = 0.8 * half;
  pen.box({-foot, -foot, 0.05}, {foot, foot, 0.5 * height}, m);
  pen.box({-half, -half, 0.5 * height}, {half, half, height - 0.06}, m);
  pen.quad({-half, -half - 0.03, height - 0.04}, {half, -half - 0.03, height - 0.04},
           {half, half + 0.06, height + 0.05}, {-half, half + 0.06, height + 0.05}, m);
  pen.tube({{-half, half + 0.06, height - 0.06}, {half, half + 0.06, height - 0.06}}, {0.02, 0.02},
           5, m);
}

void add_hydrant(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const MaterialId m = any_plastic(world, p, rng);
  const double h = rng.uniform(0.6, 0.95);
  pen.post(0.1, h, m, 10);
  pen.ellipsoid({0, 0, h}, {0.13, 0.13, 0.12}, m);
  pen.tube({{-0.2, 0, 0.7 * h}, {0.2, 0, 0.7 * h}}, {0.06, 0.06}, 8, m);
}

void add_cone(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double h = rng.uniform(0.45, 1.0);
  const MaterialId m = any_plastic(world, p, rng);
  pen.box({-0.18, -0.18, 0}, {0.18, 0.18, 0.04}, m);
  pen.tube({{0, 0, 0.04}, {0, 0, h}}, {0.14, 0.03}, 10, m);
}

void add_meter(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double h = rng.uniform(0.9, 1.3);
  const MaterialId m = any_plastic(world, p, rng);
  pen.post(rng.uniform(0.03, 0.05), h, m, 8);
  pen.ellipsoid({0, 0, h + 0.15}, {0.09, 0.12, 0.2}, m);
}

void add_mailbox(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const MaterialId m = any_plastic(world, p, rng);
  if (rng.chance(0.5)) {  // on a post before a drive
    pen.post(0.05, 1.0, p.timber, 7);
    pen.box({-0.12, -0.28, 1.0}, {0.12, 0.28, 1.25}, m);
    return;
  }
  pen.box({-0.3, -0.3, 0.1}, {0.3, 0.3, 1.1}, m);
  pen.tube({{-0.3, 0, 1.1}, {0.3, 0, 1.1}}, {0.3, 0.3}, 12, m);
}

void add_thick_bollard(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double r = rng.uniform(0.05, 0.2);
  pen.tube({{0, 0, -0.1}, {0, 0, rng.uniform(0.4, 1.1)}}, {r, rng.uniform(0.7, 1) * r}, 12,
           any_plastic(world, p, rng));
}

void add_litter_bin(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const MaterialId m = any_plastic(world, p, rng);
  if (rng.chance(0.4)) {  // hung on a post
    pen.post(0.04, 1.2, m, 8);
    pen.box({0.04, -0.2, 0.5}, {0.4, 0.2, 1.1}, m);
    return;
  }
  pen.post(rng.uniform(0.2, 0.35), rng.uniform(0.7, 1.2), m, 14);
}

void add_rock(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  const double r = rng.uniform(0.25, 0.7);
  Pen(world.mesh, T).ellipsoid({0, 0, 0.2 * r}, {r, r * rng.uniform(0.6, 1), 0.8 * r}, p.timber);
}

void add_cabinet(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double w = rng.uniform(0.3, 1.2);
  const double d = rng.uniform(0.15, 0.45);
  const double h = rng.uniform(0.8, 2.2);
  const MaterialId m = any_plastic(world, p, rng);
  pen.box({-w, -d, 0}, {w, d, 0.12}, p.timber);
  pen.box({-w, -d, 0.12}, {w, d, h}, m);
  pen.box({-w - 0.04, -d - 0.06, h}, {w + 0.04, d + 0.04, h + 0.05}, m);
}

void add_open_bench(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double w = rng.uniform(0.6, 1.5);
  pen.box({-w, -0.22, 0.4}, {w, 0.22, 0.47}, p.timber);
  for (const double x : {-0.8 * w, 0.8 * w})
    pen.box({x - 0.06, -0.2, 0}, {x + 0.06, 0.2, 0.4}, p.timber);
  if (rng.chance(0.6)) pen.box({-w, 0.2, 0.6}, {w, 0.25, 0.9}, p.timber);
}

/// A round table, chairs, sometimes a parasol.
void add_cafe_table(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const MaterialId m = any_plastic(world, p, rng);
  pen.post(0.03, 0.72, m, 7);
  pen.at(0, 0, 0.7).post(rng.uniform(0.3, 0.5), 0.03, m, 14);
  const int chairs = 2 + rng.index(3);
  for (int i = 0; i < chairs; ++i) {
    Pen chair = pen.at(0, 0, 0, 2 * std::numbers::pi * i / chairs + rng.normal(0, 0.2));
    chair.box({0.6, -0.2, 0.42}, {1.0, 0.2, 0.46}, m);
    chair.box({0.97, -0.2, 0.46}, {1.0, 0.2, 0.9}, m);
    for (const double x : {0.62, 0.98})
      for (const double y : {-0.19, 0.19})
        chair.box({x - 0.01, y - 0.01, 0}, {x + 0.01, y + 0.01, 0.42}, m);
  }
  if (!rng.chance(0.5)) return;
  const double reach = rng.uniform(1.0, 1.9);
  pen.post(0.025, 2.6, m, 7);
  pen.tube({{0, 0, 2.2}, {0, 0, 2.7}}, {reach, 0.05}, 8, p.canvas, false);
}

void add_kiosk(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double w = rng.uniform(0.5, 1.4);
  const double d = rng.uniform(0.5, 1.1);
  const double h = rng.uniform(2.1, 2.8);
  const MaterialId m = any_plastic(world, p, rng);
  pen.box({-w, -d, 0}, {w, d, h}, m);
  pen.box({-w - 0.3, -d - 0.4, h}, {w + 0.3, d + 0.2, h + 0.15}, m);
  pen.box({-0.8 * w, -d - 0.3, 1.0}, {0.8 * w, -d, 1.05}, m);
}

void add_advertising_column(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen(world.mesh, T).post(rng.uniform(0.4, 0.75), rng.uniform(2.2, 3.6), p.canvas, 16);
}

void add_pallets(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen = Pen(world.mesh, T).at(0, 0, 0, rng.normal(0, 0.2));
  const int pallets = 1 + rng.index(10);
  for (int i = 0; i < pallets; ++i) {
    const double z = 0.144 * i;
    const double shift = rng.normal(0, 0.02);
    pen.box({-0.6 + shift, -0.4, z + 0.1}, {0.6 + shift, 0.4, z + 0.144}, p.timber);
    for (const double y : {-0.38, 0.0, 0.38})
      pen.box({-0.6 + shift, y - 0.05, z}, {0.6 + shift, y + 0.05, z + 0.1}, p.timber);
  }
  if (rng.chance(0.5)) {
    const double z = 0.144 * pallets;
    pen.box({-0.55, -0.38, z}, {0.55, 0.38, z + rng.uniform(0.3, 1)}, any_plastic(world, p, rng));
  }
}

void add_pile(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double r = rng.uniform(0.8, 2);
  const MaterialId m = rng.chance(0.5) ? p.soil : rng.chance(0.5) ? p.gravel : p.snow;
  const double turn = rng.uniform(0, 3);
  for (int i = 0; i < 3; ++i) {
    const double out = 0.4 * r * i;
    pen.ellipsoid({out * std::cos(turn), 0.3 * out * std::sin(turn), 0},
                  {r, r * rng.uniform(0.6, 1), r * rng.uniform(0.4, 0.9)}, m);
  }
}

/// A 10-, 20-foot container with ribs in its walls.
void add_sea_container(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double half = rng.chance(0.3) ? 1.5 : 3.03;
  const MaterialId m = any_plastic(world, p, rng);
  const double h = rng.chance(0.8) ? 2.59 : 2.9;
  pen.box({-half, -1.18, 0.1}, {half, 1.18, h}, m);
  for (double x = -half; x < half; x += 0.28) {
    for (const double y : {-1.22, 1.18}) pen.box({x, y, 0.15}, {x + 0.14, y + 0.04, h - 0.1}, m);
  }
}

/// An open skip with sloping ends.
void add_skip(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double half = rng.uniform(1.3, 2.6);
  const double w = rng.uniform(0.8, 1.15);
  const double h = rng.uniform(0.9, 1.6);
  const double foot = 0.72 * half;
  const MaterialId m = any_plastic(world, p, rng);
  for (const double y : {-w, w}) {
    pen.quad({-foot, y, 0.08}, {foot, y, 0.08}, {half, y, h}, {-half, y, h}, m);
    for (double x = -foot; x < foot; x += 0.7)
      pen.box({x, y - 0.05, 0.1}, {x + 0.1, y + 0.05, h}, m);
  }
  for (const double x : {-1.0, 1.0})
    pen.quad({x * foot, -w, 0.08}, {x * foot, w, 0.08}, {x * half, w, h}, {x * half, -w, h}, m);
  const double filled = rng.uniform(0.2, 0.9) * h;
  pen.quad({-foot, -w, filled}, {foot, -w, filled}, {foot, w, filled}, {-foot, w, filled},
           p.timber);
  if (rng.chance(0.5)) pen.ellipsoid({0, 0, h - 0.2}, {0.6 * half, 0.8 * w, 0.5}, p.timber);
}

void add_igloos(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const int count = 2 + rng.index(3);
  for (int i = 0; i < count; ++i) {
    const double x = 1.6 * (i - 0.5 * (count - 1));
    const MaterialId m = any_plastic(world, p, rng);
    if (rng.chance(0.6)) {
      pen.at(x, 0, 0).post(0.65, 0.8, m, 14);
      pen.ellipsoid({x, 0, 0.8}, {0.66, 0.66, 0.8}, m);
    } else {
      pen.box({x - 0.65, -0.6, 0.05}, {x + 0.65, 0.6, rng.uniform(1.3, 1.8)}, m);
    }
  }
}

/// A large refuse container on wheels: slanted front, lids.
void add_dumpster(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const int count = 1 + rng.index(3);
  const double half = count == 1 ? rng.uniform(0.6, 1) : 0.68;
  const MaterialId m = any_plastic(world, p, rng);
  for (int i = 0; i < count; ++i) {
    Pen one = pen.at(1.5 * (i - 0.5 * (count - 1)), rng.normal(0, 0.05), 0, rng.normal(0, 0.06));
    one.box({-0.9 * half, -0.4, 0.18}, {0.9 * half, 0.4, 0.6}, m);
    one.box({-half, -0.5, 0.6}, {half, 0.5, 1.1}, m);
    one.tube({{-half, 0, 1.1}, {half, 0, 1.1}}, {0.5, 0.5}, 12, m);
    for (const double x : {-0.7 * half, 0.7 * half})
      one.tube({{x, -0.3, 0.09}, {x + 0.05, -0.3, 0.09}}, {0.09, 0.09}, 8, m);
  }
}

void add_tent(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double half = rng.uniform(1.2, 2.5);
  const double w = rng.uniform(1.2, 1.6);
  const double eave = rng.uniform(1.8, 2.3);
  const double top = eave + rng.uniform(0.4, 1);
  for (const double x : {-half, half})
    for (const double y : {-w, w}) pen.at(x, y, 0).post(0.03, eave, p.plastic, 6);
  for (const double side : {-1.0, 1.0})
    pen.quad({-half, side * w, eave}, {half, side * w, eave}, {half, 0, top}, {-half, 0, top},
             p.canvas);
  if (rng.chance(0.6)) pen.box({-half, w - 0.02, 0.1}, {half, w, eave}, p.canvas);
  if (rng.chance(0.8))
    pen.box({-0.9 * half, -0.9 * w, 0.7}, {0.9 * half, -0.3 * w, 0.95}, p.timber);
}

/// Boards, pipes and bricks of a building site.
void add_material(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const int layers = 1 + rng.index(4);
  const double half = rng.uniform(1, 2.2);
  for (int i = 0; i < layers; ++i) {
    const double r = rng.uniform(0.08, 0.25);
    for (double y = -0.8 + r; y < 0.8; y += 2.05 * r)
      pen.tube({{-half, y, r + 0.45 * i}, {half, y, r + 0.45 * i}}, {r, r}, 8, p.timber);
  }
  if (rng.chance(0.5))
    pen.box({half + 0.2, -0.5, 0}, {half + 1.2, 0.5, rng.uniform(0.4, 1.2)}, p.timber);
}

void add_bus_shelter(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double half = rng.uniform(1.3, 2.6);
  const double d = rng.uniform(0.55, 0.9);
  const MaterialId glass = world.add({kOtherStructure, 0.06F, 0.04F, 0.99F, 0.5F, 0});
  pen.box({-half - 0.1, -d - 0.3, 2.35}, {half + 0.1, d, 2.47}, p.structure);
  for (const double x : {-half, 0.0, half})
    pen.box({x - 0.04, d - 0.08, 0}, {x + 0.04, d, 2.35}, p.structure);
  pen.quad({-half, d - 0.04, 0.15}, {half, d - 0.04, 0.15}, {half, d - 0.04, 2.2},
           {-half, d - 0.04, 2.2}, glass);
  pen.box({-0.8 * half, d - 0.5, 0.42}, {0.3 * half, d - 0.1, 0.48}, p.structure);
  if (rng.chance(0.6)) pen.box({half - 0.06, -d, 0.2}, {half + 0.06, d, 2.1}, p.structure);
}

}  // namespace

Furnishing any_small_thing(core::Rng& rng) {
  const Furnishing things[] = {{add_hydrant, 0.25, 0.25},     {add_cone, 0.2, 0.2},
                               {add_meter, 0.15, 0.15},       {add_mailbox, 0.35, 0.35},
                               {add_thick_bollard, 0.2, 0.2}, {add_litter_bin, 0.4, 0.4},
                               {add_rock, 0.7, 0.7},          {add_wheelie_bins, 0.9, 0.4}};
  return things[rng.index(8)];
}

Furnishing any_middling_thing(core::Rng& rng) {
  const Furnishing things[] = {
      {add_cabinet, 1.2, 0.5},  {add_open_bench, 1.5, 0.4},         {add_cafe_table, 1.1, 1.1},
      {add_kiosk, 1.6, 1.3},    {add_advertising_column, 0.8, 0.8}, {add_pallets, 0.8, 0.6},
      {add_dumpster, 1.4, 0.6}, {add_wheelie_bins, 1.5, 0.4}};
  return things[rng.index(8)];
}

Furnishing any_car_sized_thing(core::Rng& rng) {
  const Furnishing things[] = {
      {add_sea_container, 3.1, 1.3}, {add_skip, 2.6, 1.2},        {add_igloos, 3, 0.8},
      {add_dumpster, 2.4, 0.7},      {add_tent, 2.6, 1.7},        {add_material, 3, 1},
      {add_pile, 2.5, 1.8},          {add_bus_shelter, 2.8, 1.2}, {add_skip, 2.6, 1.2}};
  return things[rng.index(9)];
}

void add_bollard_row(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  const int count = 3 + rng.index(8);
  const double spacing = rng.uniform(0.9, 2);
  const bool cones = rng.chance(0.2);
  const bool posts = !cones && rng.chance(0.7);  // poles, however low: their shape is one
  const double r = posts ? rng.uniform(0.03, 0.08) : rng.uniform(0.1, 0.2);
  const double h = rng.uniform(0.5, 1.1);
  const bool chained = !cones && rng.chance(0.25);
  const MaterialId m =
      posts ? any_tint(world, p.metal, 0.06, 0.6, rng) : any_plastic(world, p, rng);
  for (int i = 0; i < count; ++i) {
    Pen pen = Pen(world.mesh, T).at(i * spacing, 0, 0);
    cones ? pen.tube({{0, 0, 0}, {0, 0, h}}, {0.16, 0.03}, 10, m) : pen.post(r, h, m, 10);
    if (chained && i > 0)
      pen.tube({{-spacing, 0, 0.9 * h}, {-0.5 * spacing, 0, 0.75 * h}, {0, 0, 0.9 * h}},
               {0.015, 0.015, 0.015}, 4, m, false);
  }
}

void add_wheelie_bins(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  const int count = 1 + rng.index(4);
  for (int i = 0; i < count; ++i) {
    Pen pen = Pen(world.mesh, T)
                  .at(0.65 * (i - 0.5 * (count - 1)), rng.normal(0, 0.04), 0, rng.normal(0, 0.15));
    draw_wheelie(pen, rng.uniform(0.22, 0.3), rng.uniform(0.9, 1.1), any_plastic(world, p, rng));
  }
}

void add_scaffold(World& world, const StreetPalette& p, const SE3& T, double length,
                  double height) {
  Pen pen(world.mesh, T);
  for (double x = 0; x <= length; x += 2.5) {
    for (const double y : {-0.35, -1.1}) pen.at(x, y, -0.1).post(0.025, height + 1, p.structure, 6);
  }
  for (double z = 2; z <= height; z += 2) {
    pen.box({0, -1.05, z - 0.05}, {length, -0.4, z}, p.structure);
    for (const double up : {0.5, 1.0})
      pen.tube({{0, -1.1, z + up}, {length, -1.1, z + up}}, {0.02, 0.02}, 4, p.structure, false);
  }
  for (double x = 0; x + 2.5 <= length; x += 5)
    pen.tube({{x, -1.12, 0}, {x + 2.5, -1.12, height}}, {0.02, 0.02}, 4, p.structure, false);
}

}  // namespace saker::simulation
