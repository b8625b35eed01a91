#include "saker/simulation/world/buildings.h"

#include <algorithm>
#include <cmath>

namespace saker::simulation {
namespace {

struct Facade {
  BuildingShape shape;
  MaterialId wall;
  MaterialId trim;
  MaterialId glass;
};

/// A rectangle of wall at depth y (x along, z up).
void wall_piece(Pen& pen, double x0, double x1, double z0, double z1, double y, MaterialId m) {
  if (x1 - x0 < 1e-3 || z1 - z0 < 1e-3) return;
  pen.quad({x0, y, z0}, {x1, y, z0}, {x1, y, z1}, {x0, y, z1}, m);
}

/// A bay of one storey with an opening let into it: reveals, a pane, and the room's back wall
/// behind it.
void draw_bay(Pen& pen, const Facade& f, double x0, double x1, double z0, double z1,
              const Eigen::AlignedBox2d& opening, double recess, bool pane) {
  const double a = opening.min().x();
  const double b = opening.max().x();
  const double low = opening.min().y();
  const double high = opening.max().y();
  wall_piece(pen, x0, a, z0, z1, 0, f.wall);
  wall_piece(pen, b, x1, z0, z1, 0, f.wall);
  wall_piece(pen, a, b, z0, low, 0, f.wall);
  wall_piece(pen, a, b, high, z1, 0, f.wall);
  for (const double x : {a, b}) {
    pen.quad({x, 0, low}, {x, recess, low}, {x, recess, high}, {x, 0, high}, f.wall);
  }
  for (const double z : {low, high}) {
    pen.quad({a, 0, z}, {b, 0, z}, {b, recess, z}, {a, recess, z}, f.wall);
  }
  if (!pane) {
    wall_piece(pen, a, b, low, high, recess, f.trim);
    return;
  }
  wall_piece(pen, a, b, low, high, recess, f.glass);
  wall_piece(pen, 0.5 * (a + b) - 0.03, 0.5 * (a + b) + 0.03, low, high, recess - 0.01, f.trim);
  wall_piece(pen, a - 0.5, b + 0.5, low - 0.5, high + 0.5, recess + 2.2, f.trim);
}

void draw_balcony(Pen& pen, const Facade& f, double x0, double x1, double z) {
  constexpr double kOut = 1.3;
  pen.box({x0, -kOut, z - 0.18}, {x1, 0, z}, f.trim);
  for (double x = x0; x < x1; x += 0.14)
    pen.box({x, -kOut, z}, {x + 0.03, -kOut + 0.03, z + 0.95}, f.trim);
  pen.box({x0, -kOut, z + 0.95}, {x1, -kOut + 0.05, z + 1.02}, f.trim);
}

void draw_storey(Pen& pen, const Facade& f, int storey, int bays, core::Rng& rng) {
  const double h = f.shape.storey_height;
  const double z0 = storey * h;
  const double bay = f.shape.width / bays;
  const int door = storey == 0 ? rng.index(bays) : -1;
  const double recess = rng.uniform(0.06, 0.28);
  for (int i = 0; i < bays; ++i) {
    const double x0 = i * bay;
    const bool is_door = i == door;
    const bool shop = f.shape.shop && storey == 0;
    const double half =
        shop ? 0.42 * bay : std::min(0.38 * bay, is_door ? 0.55 : rng.uniform(0.4, 0.8));
    const double low = is_door ? 0.1 : shop ? 0.4 : 0.9;
    const double high = is_door ? 2.2 : std::min(h - 0.3, shop ? 2.6 : 2.3);
    const Eigen::AlignedBox2d opening(Eigen::Vector2d(x0 + bay / 2 - half, z0 + low),
                                      Eigen::Vector2d(x0 + bay / 2 + half, z0 + high));
    draw_bay(pen, f, x0, x0 + bay, z0, z0 + h, opening, recess, !is_door && !rng.chance(0.15));
    if (storey > 0 && rng.chance(f.shape.balcony_share)) {
      draw_balcony(pen, f, x0 + 0.2, x0 + bay - 0.2, z0 + 0.05);
    }
  }
}

void draw_roof(Pen& pen, const Facade& f, double top) {
  const double w = f.shape.width;
  const double d = f.shape.depth;
  if (!f.shape.gable) {
    pen.box({-0.3, -0.35, top}, {w + 0.3, d + 0.3, top + 0.25}, f.trim);
    return;
  }
  const double ridge = top + 0.38 * d;
  pen.quad({-0.4, -0.5, top - 0.1}, {w + 0.4, -0.5, top - 0.1}, {w + 0.4, d / 2, ridge},
           {-0.4, d / 2, ridge}, f.trim);
  pen.quad({-0.4, d + 0.5, top - 0.1}, {w + 0.4, d + 0.5, top - 0.1}, {w + 0.4, d / 2, ridge},
           {-0.4, d / 2, ridge}, f.trim);
  for (const double x : {0.0, w}) pen.triangle({x, 0, top}, {x, d, top}, {x, d / 2, ridge}, f.wall);
}

/// What stands before a front: steps, an awning, a pipe, a plinth.
void draw_front_details(Pen& pen, const Facade& f, core::Rng& rng) {
  const double w = f.shape.width;
  pen.box({0, -0.06, -0.6}, {w, 0, rng.uniform(0.2, 0.8)}, f.trim);
  if (rng.chance(0.6))
    pen.at(0.15, -0.08, 0).post(0.05, f.shape.storeys * f.shape.storey_height, f.trim, 8);
  if (f.shape.shop && rng.chance(0.6)) {
    pen.quad({0.3, 0, 2.9}, {w - 0.3, 0, 2.9}, {w - 0.3, -1.4, 2.4}, {0.3, -1.4, 2.4}, f.trim);
  }
  if (rng.chance(0.5)) {
    const double x = rng.uniform(0.1, 0.8) * w;
    for (int i = 0; i < 3; ++i) {
      pen.box({x, -0.3 * (i + 1), 0}, {x + 1.4, -0.3 * i, 0.48 - 0.16 * i}, f.trim);
    }
  }
  if (rng.chance(0.25)) {  // a bay window
    const double x = rng.uniform(0.1, 0.6) * w;
    pen.box({x, -0.8, 0}, {x + 2.4, 0, rng.uniform(2.4, 5.5)}, f.wall);
  }
}

}  // namespace

BuildingShape random_building(core::Rng& rng, bool detached) {
  BuildingShape s;
  s.width = detached ? rng.uniform(8, 16) : rng.uniform(9, 24);
  s.depth = rng.uniform(8, 13);
  s.storeys = detached ? 1 + rng.index(3) : 2 + rng.index(4);
  s.storey_height = rng.uniform(2.7, 3.4);
  s.gable = rng.chance(detached ? 0.8 : 0.4);
  s.shop = !detached && rng.chance(0.25);
  s.balcony_share = rng.chance(0.3) ? rng.uniform(0.2, 0.8) : 0;
  return s;
}

void add_building(World& world, const Palette& palette, const BuildingShape& shape,
                  const SE3& T_world_corner, core::Rng& rng) {
  const double tone = rng.uniform(0.2, 0.6);
  const Facade f{shape, tinted(world, palette.plaster, tone),
                 tinted(world, palette.plaster, rng.uniform(0.15, 0.5)), palette.glass};
  Pen pen(world.mesh, T_world_corner);
  const int bays = std::max(2, static_cast<int>(shape.width / rng.uniform(2.6, 4.0)));
  const int storeys = static_cast<int>(shape.storeys);
  for (int i = 0; i < storeys; ++i) draw_storey(pen, f, i, bays, rng);
  const double top = storeys * shape.storey_height;
  const double d = shape.depth;
  const double w = shape.width;
  pen.quad({0, 0, -1}, {0, d, -1}, {0, d, top}, {0, 0, top}, f.wall);
  pen.quad({w, 0, -1}, {w, d, -1}, {w, d, top}, {w, 0, top}, f.wall);
  pen.quad({0, d, -1}, {w, d, -1}, {w, d, top}, {0, d, top}, f.wall);
  draw_roof(pen, f, top);
  draw_front_details(pen, f, rng);
}

namespace {

void draw_pickets(Pen& pen, double length, double height, MaterialId m) {
  for (double x = 0; x < length; x += 0.16) {
    pen.quad({x, 0, 0.05}, {x + 0.09, 0, 0.05}, {x + 0.09, 0, height}, {x, 0, height}, m);
  }
  for (const double z : {0.3, 0.8 * height})
    pen.box({0, 0.01, z - 0.04}, {length, 0.05, z + 0.04}, m);
}

void draw_wire(Pen& pen, const Palette& palette, double length, double height) {
  pen.quad({0, 0, 0.02}, {length, 0, 0.02}, {length, 0, height}, {0, 0, height}, palette.wire);
  for (double x = 0; x < length; x += 2.5)
    pen.at(x, 0.03, -0.1).post(0.03, height + 0.15, palette.rail, 6);
}

void draw_rail(Pen& pen, const Palette& palette, double length) {
  pen.box({0, -0.04, 0.45}, {length, 0.04, 0.76}, palette.rail);
  for (double x = 0; x < length; x += 2) {
    pen.box({x, 0.04, -0.1}, {x + 0.1, 0.16, 0.72}, palette.rail);
  }
}

}  // namespace

void add_fence(World& world, const Palette& palette, Fence kind, const SE3& T_world_start,
               double length, double height) {
  Pen pen(world.mesh, T_world_start);
  switch (kind) {
    case Fence::wire:
      draw_wire(pen, palette, length, height);
      break;
    case Fence::picket:
      draw_pickets(pen, length, height, palette.wood);
      break;
    case Fence::wall:
      pen.box({0, -0.12, -0.3}, {length, 0.12, height}, palette.concrete);
      break;
    case Fence::rail:
      draw_rail(pen, palette, length);
      break;
    case Fence::panels:
      pen.box({0, -0.03, 0}, {length, 0.03, height}, palette.wood);
      break;
  }
}

}  // namespace saker::simulation
