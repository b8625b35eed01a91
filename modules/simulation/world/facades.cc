#include "saker/simulation/world/facades.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/fences.h"

namespace saker::simulation {
namespace {

constexpr double kFoundation = 4;  ///< m into the ground: streets that climb show some of it

MaterialId any_wall(World& world, const StreetPalette& p, core::Rng& rng) {
  return any_tint(world, rng.chance(0.5) ? p.brick : p.plaster, 0.15, 0.7, rng);
}

/// Flat or round columns up the front, all of them or at the corners only.
void draw_pilasters(Pen& pen, const BuildingShape& s, MaterialId m, core::Rng& rng) {
  const double out = rng.uniform(0.05, 0.4);
  const double half = rng.uniform(0.08, 0.35);
  const double top = rng.chance(0.5) ? s.storeys * s.storey_height : s.storey_height;
  const double spacing = rng.chance(0.4) ? s.width : rng.uniform(2.5, 6);
  for (double x = half; x <= s.width; x += spacing) {
    if (rng.chance(0.3)) {
      pen.at(x, -out, -0.5).post(half, top + 0.5, m, 10);
    } else {
      pen.box({x - half, -out, -0.5}, {x + half, 0, top}, m);
    }
  }
}

/// A landing with steps, posts and a roof before the door.
void draw_porch(Pen& pen, const BuildingShape& s, MaterialId m, core::Rng& rng) {
  const double half = rng.uniform(0.7, 1.8);
  const double x = rng.uniform(half, s.width - half);
  const double out = rng.uniform(0.8, 2);
  const double high = rng.uniform(0.15, 0.9);
  pen.box({x - half, -out, -1}, {x + half, 0, high}, m);
  const int steps = static_cast<int>(high / 0.17);
  for (int i = 0; i < steps; ++i) {
    pen.box({x - 0.7 * half, -out - 0.28 * (i + 1), -1},
            {x + 0.7 * half, -out - 0.28 * i, high - 0.17 * (i + 1)}, m);
  }
  if (rng.chance(0.4)) return;
  const double post = rng.uniform(0.04, 0.18);
  for (const double side : {-1.0, 1.0})
    pen.at(x + side * (half - post), -out + post, 0).post(post, 2.5 + high, m, 10);
  pen.box({x - half - 0.2, -out - 0.2, 2.5 + high}, {x + half + 0.2, 0, 2.7 + high}, m);
}

/// A roller door with ribs, let in by its frame.
void draw_garage_door(Pen& pen, const BuildingShape& s, const StreetPalette& p, core::Rng& rng) {
  const double half = rng.uniform(1.15, 2.6);
  if (s.width < 2 * half + 1) return;
  const double x = rng.uniform(half + 0.3, s.width - half - 0.3);
  const double high = rng.uniform(2, 2.9);
  for (const double side : {-1.0, 1.0}) {
    const double at = x + side * (half + 0.12);
    pen.box({at - 0.12, -0.25, -0.3}, {at + 0.12, 0, high + 0.2}, p.frame);
  }
  pen.box({x - half, -0.25, high}, {x + half, 0, high + 0.25}, p.frame);
  for (double z = 0; z < high; z += 0.45)
    pen.box({x - half, -0.06, z}, {x + half, -0.02, std::min(high, z + 0.43)}, p.cladding);
}

void draw_awnings(Pen& pen, const BuildingShape& s, const StreetPalette& p, core::Rng& rng) {
  const double out = rng.uniform(0.7, 1.8);
  const double z = rng.uniform(2.3, 3);
  for (double x = 0.3; x + 3 < s.width; x += rng.uniform(3.2, 5)) {
    pen.quad({x, 0, z + 0.4}, {x + 2.8, 0, z + 0.4}, {x + 2.8, -out, z}, {x, -out, z}, p.frame);
    if (rng.chance(0.4)) pen.box({x, -0.9, 2.4}, {x + 0.08, -0.1, 3.2}, p.sign);
  }
}

void draw_bay_windows(Pen& pen, const BuildingShape& s, MaterialId wall, const StreetPalette& p,
                      core::Rng& rng) {
  const double half = rng.uniform(0.7, 1.5);
  if (s.width < 2 * half + 1) return;
  const double x = rng.uniform(half, s.width - half);
  const double out = rng.uniform(0.4, 1.1);
  const double low = rng.chance(0.5) ? 0 : s.storey_height;
  const double top = std::max(low + 2.6, s.storeys * s.storey_height * rng.uniform(0.5, 1));
  const auto side = [&](double x0, double y0, double x1, double y1) {
    for (double z = low; z + 2.5 <= top + 0.1; z += s.storey_height) {
      const auto band = [&](double a, double b, MaterialId m) {
        pen.quad({x0, y0, z + a}, {x1, y1, z + a}, {x1, y1, z + b}, {x0, y0, z + b}, m);
      };
      band(0, 0.8, wall);
      band(0.8, 2.2, p.pane);
      band(2.2, s.storey_height, wall);
    }
  };
  side(x - half, 0, x - 0.6 * half, -out);
  side(x - 0.6 * half, -out, x + 0.6 * half, -out);
  side(x + 0.6 * half, -out, x + half, 0);
}

void draw_roof_details(Pen& pen, const BuildingShape& s, MaterialId m, core::Rng& rng) {
  const double top = s.storeys * s.storey_height;
  if (rng.chance(0.6)) {
    const double x = rng.uniform(1, s.width - 1);
    pen.box({x, 0.4 * s.depth, top}, {x + 0.6, 0.4 * s.depth + 0.6, top + 0.45 * s.depth}, m);
  }
  if (rng.chance(0.5)) pen.box({-0.05, -0.3, top - 0.3}, {s.width + 0.05, 0, top}, m);  // cornice
}

void draw_foundation(Pen& pen, double width, double depth, MaterialId m) {
  pen.box({0, 0.02, -kFoundation}, {width, depth, 0.02}, m);
}

/// A small flight of steps beside rails up to a door, as town houses have them.
void draw_stoop(Pen& pen, const BuildingShape& s, MaterialId m, const StreetPalette& p,
                core::Rng& rng) {
  const double x = rng.uniform(0.3, std::max(0.4, s.width - 2));
  const int steps = 3 + rng.index(6);
  for (int i = 0; i < steps; ++i)
    pen.box({x, -0.28 * (i + 1), -0.5}, {x + 1.3, -0.28 * i, 0.17 * (steps - i)}, m);
  const double run = 0.28 * steps;
  for (const double side : {x, x + 1.3}) {
    pen.tube({{side, 0, 0.17 * steps + 0.9}, {side, -run, 0.95}}, {0.02, 0.02}, 5, p.frame, false);
    pen.at(side, -run, 0).post(0.02, 0.95, p.frame, 5);
  }
}

}  // namespace

void add_house(World& world, const StreetPalette& p, const BuildingShape& shape,
               const SE3& T_world_corner, core::Rng& rng) {
  add_building(world, p, shape, T_world_corner, rng);
  Pen pen(world.mesh, T_world_corner);
  const MaterialId trim = any_wall(world, p, rng);
  draw_foundation(pen, shape.width, shape.depth, trim);
  if (rng.chance(0.45)) draw_pilasters(pen, shape, trim, rng);
  if (rng.chance(0.35)) draw_porch(pen, shape, trim, rng);
  if (rng.chance(0.25)) draw_stoop(pen, shape, trim, p, rng);
  if (rng.chance(0.35)) draw_garage_door(pen, shape, p, rng);
  if (rng.chance(0.25)) draw_awnings(pen, shape, p, rng);
  if (rng.chance(0.35)) draw_bay_windows(pen, shape, trim, p, rng);
  draw_roof_details(pen, shape, trim, rng);
}

void add_arcade(World& world, const StreetPalette& p, const BuildingShape& shape,
                const SE3& T_world_corner, core::Rng& rng) {
  const double back = std::min(rng.uniform(1.8, 3.5), 0.4 * shape.depth);
  Pen pen(world.mesh, T_world_corner);
  const MaterialId wall = any_wall(world, p, rng);
  const double z = rng.uniform(2.8, 4.2);
  const double spacing = rng.uniform(2.2, 5);
  const double half = rng.uniform(0.15, 0.45);
  const bool round = rng.chance(0.5);
  for (double x = half; x <= shape.width - half + 1e-3; x += spacing) {
    if (round) {
      pen.at(x, half, -1).post(half, z + 1, wall, 12);
    } else {
      pen.box({x - half, 0, -1}, {x + half, 2 * half, z}, wall);
    }
  }
  pen.box({0, 0, z}, {shape.width, shape.depth, z + 0.3}, wall);
  BuildingShape lower = shape;
  lower.storeys = 1;
  lower.storey_height = z;
  lower.shop = true;
  lower.gable = false;
  lower.depth = shape.depth - back;
  add_building(world, p, lower, T_world_corner * placed(0, back, 0), rng);
  add_building(world, p, shape, T_world_corner * placed(0, 0, z + 1.05), rng);
  draw_foundation(pen, shape.width, shape.depth, wall);
}

void add_hall(World& world, const StreetPalette& p, double width, double depth, double height,
              const SE3& T_world_corner, core::Rng& rng) {
  Pen pen(world.mesh, T_world_corner);
  const MaterialId wall = any_tint(world, p.cladding, 0.15, 0.7, rng);
  pen.box({0, 0, -kFoundation}, {width, depth, height}, wall);
  const double rib = rng.uniform(0.3, 1.2);
  if (rng.chance(0.6)) {
    for (double x = 0; x < width; x += rib) pen.box({x, -0.05, 0}, {x + 0.12, 0, height}, wall);
  }
  for (double x = 2; x + 4.5 < width; x += rng.uniform(6, 14)) {
    const double high = std::min(height - 0.5, rng.uniform(2.5, 4.5));
    pen.box({x - 0.2, -0.3, 0}, {x, 0, high + 0.2}, p.frame);
    pen.box({x + 4, -0.3, 0}, {x + 4.2, 0, high + 0.2}, p.frame);
    pen.box({x, -0.04, 0}, {x + 4, -0.01, high}, p.frame);
    if (rng.chance(0.4)) pen.box({x - 0.2, -1.4, -0.5}, {x + 4.2, 0, 1.1}, p.brick);  // a dock
    if (rng.chance(0.4)) pen.box({x - 0.5, -1.6, high + 0.3}, {x + 4.5, 0, high + 0.5}, p.frame);
  }
}

void add_shed(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double half = rng.uniform(1, 3);
  const double w = rng.uniform(0.9, 1.6);
  const double h = rng.uniform(1.9, 2.5);
  const MaterialId m = any_tint(world, p.cladding, 0.2, 0.6, rng);
  if (rng.chance(0.5)) {
    pen.box({-half, -w, -0.3}, {half, w, h}, m);
  } else {  // a carport
    for (const double x : {-half, half})
      for (const double y : {-w, w})
        pen.box({x - 0.06, y - 0.06, -0.3}, {x + 0.06, y + 0.06, h}, m);
  }
  pen.quad({-half - 0.2, -w - 0.2, h}, {half + 0.2, -w - 0.2, h}, {half + 0.2, w + 0.2, h + 0.5},
           {-half - 0.2, w + 0.2, h + 0.5}, m);
}

void add_deck(World& world, const StreetPalette& p, double length, double depth,
              const SE3& T_world_corner, core::Rng& rng) {
  Pen pen(world.mesh, T_world_corner);
  const double z = rng.uniform(2.3, 3.2);
  const double half = rng.uniform(0.15, 0.35);
  const double spacing = rng.uniform(5, 8);
  pen.box({0, 0, z}, {length, depth, z + 0.35}, p.brick);
  pen.box({0, -0.1, z + 0.35}, {length, 0.1, z + 1.4}, p.brick);
  for (double x = half; x < length; x += spacing) {
    for (const double y : {half, depth - half})
      pen.box({x - half, y - half, -1}, {x + half, y + half, z}, p.brick);
  }
  if (rng.chance(0.5)) pen.box({0, depth - 0.2, -1}, {length, depth, z}, p.brick);
}

void add_bridge(World& world, const StreetPalette& p, double span, const SE3& T_world_middle,
                core::Rng& rng) {
  Pen pen(world.mesh, T_world_middle);
  const double half = rng.uniform(1.5, 7);
  const double z = rng.uniform(4.6, 6.5);
  const double thick = rng.uniform(0.4, 1.3);
  const double end = span / 2;
  pen.box({-half, -end - 40, z}, {half, end + 40, z + thick}, p.block);
  for (const double side : {-1.0, 1.0}) {
    pen.box({-half, std::min(side * end, side * (end + 1)), -3},
            {half, std::max(side * end, side * (end + 1)), z}, p.block);
    if (rng.chance(0.6))
      add_boundary(world, p, Boundary::iron_railing,
                   T_world_middle * placed(side * half, -end, z + thick, std::numbers::pi / 2),
                   span, 1.1);
  }
}

}  // namespace saker::simulation
