#include "saker/simulation/world/fences.h"

#include <algorithm>

namespace saker::simulation {
namespace {

/// Upright bars at a spacing between two rails.
void draw_bars(Pen& pen, double length, double low, double high, double spacing, double thick,
               MaterialId m) {
  for (double x = spacing / 2; x < length; x += spacing) {
    pen.quad({x - thick, 0, low}, {x + thick, 0, low}, {x + thick, 0, high}, {x - thick, 0, high},
             m);
    pen.quad({x, -thick, low}, {x, thick, low}, {x, thick, high}, {x, -thick, high}, m);
  }
  for (const double z : {low + 0.06, high - 0.06})
    pen.box({0, -0.02, z - 0.02}, {length, 0.02, z + 0.02}, m);
}

void draw_posts(Pen& pen, double length, double height, double spacing, double radius,
                MaterialId m) {
  for (double x = 0; x < length; x += spacing) pen.at(x, 0, -0.2).post(radius, height + 0.2, m, 7);
}

void draw_chain_link(Pen& pen, const StreetPalette& p, double length, double height) {
  pen.quad({0, 0, 0.03}, {length, 0, 0.03}, {length, 0, height}, {0, 0, height}, p.mesh);
  draw_posts(pen, length, height + 0.05, 2.5, 0.03, p.iron);
  pen.tube({{0, 0, height}, {length, 0, height}}, {0.02, 0.02}, 5, p.iron, false);
}

void draw_slats(Pen& pen, double length, double height, MaterialId m) {
  for (double z = 0.1; z < height; z += 0.16) pen.box({0, -0.012, z}, {length, 0.012, z + 0.11}, m);
  draw_posts(pen, length, height, 1.8, 0.05, m);
}

void draw_balustrade(Pen& pen, double length, double height, MaterialId m) {
  pen.box({0, -0.12, -0.2}, {length, 0.12, 0.15}, m);
  pen.box({0, -0.1, height - 0.1}, {length, 0.1, height}, m);
  for (double x = 0.15; x < length; x += 0.3) {
    pen.tube({{x, 0, 0.15}, {x, 0, 0.4}, {x, 0, height - 0.1}}, {0.05, 0.08, 0.04}, 6, m, false);
  }
}

void draw_guard_rail(Pen& pen, const StreetPalette& p, double length, double height) {
  const double middle = std::clamp(height, 0.6, 0.85) - 0.16;
  for (const double z : {middle - 0.08, middle + 0.08}) {
    pen.tube({{0, -0.03, z}, {length, -0.03, z}}, {0.08, 0.08}, 6, p.rail, false);
  }
  for (double x = 0; x < length; x += 2)
    pen.box({x, 0.03, -0.2}, {x + 0.1, 0.15, middle + 0.12}, p.rail);
}

/// Movable mesh panels on feet of concrete.
void draw_site_fence(Pen& pen, const StreetPalette& p, double length, double height) {
  pen.quad({0, 0, 0.12}, {length, 0, 0.12}, {length, 0, height}, {0, 0, height}, p.mesh);
  for (const double x : {0.02, length - 0.05}) {
    pen.at(x, 0, 0.1).post(0.021, height, p.iron, 6);
    pen.box({x - 0.1, -0.35, 0}, {x + 0.1, 0.35, 0.14}, p.board);
  }
  for (const double z : {0.12, height})
    pen.tube({{0, 0, z}, {length, 0, z}}, {0.02, 0.02}, 5, p.iron, false);
}

void draw_jersey(Pen& pen, double length, double height, MaterialId m) {
  const double h = std::clamp(height, 0.7, 1.1);
  const double ys[] = {0.3, 0.28, 0.13, 0.08};
  const double zs[] = {0, 0.08, 0.35, h};
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 3; ++i) {
      pen.quad({0, side * ys[i], zs[i]}, {length, side * ys[i], zs[i]},
               {length, side * ys[i + 1], zs[i + 1]}, {0, side * ys[i + 1], zs[i + 1]}, m);
    }
  }
  pen.quad({0, -0.08, h}, {length, -0.08, h}, {length, 0.08, h}, {0, 0.08, h}, m);
  for (const double x : {0.0, length})
    pen.quad({x, -0.3, 0}, {x, 0.3, 0}, {x, 0.08, h}, {x, -0.08, h}, m);
}

void draw_post_and_rail(Pen& pen, double length, double height, MaterialId m) {
  draw_posts(pen, length, height, 1.8, 0.055, m);
  for (const double share : {0.35, 0.65, 0.93}) {
    const double z = share * height;
    pen.box({0, -0.03, z - 0.06}, {length, 0.03, z + 0.06}, m);
  }
}

}  // namespace

Boundary any_boundary(core::Rng& rng) { return static_cast<Boundary>(rng.index(kBoundaries)); }

void add_boundary(World& world, const StreetPalette& p, Boundary kind, const SE3& T, double length,
                  double height) {
  Pen pen(world.mesh, T);
  switch (kind) {
    case Boundary::chain_link:
      return draw_chain_link(pen, p, length, height);
    case Boundary::picket:
      return draw_bars(pen, length, 0.05, std::min(height, 1.3), 0.15, 0.04, p.wood);
    case Boundary::iron_railing:
      draw_posts(pen, length, height, 2.5, 0.035, p.iron);
      return draw_bars(pen, length, 0.1, height, 0.13, 0.01, p.iron);
    case Boundary::panels:
      draw_posts(pen, length, height, 1.8, 0.05, p.board);
      return pen.box({0, -0.02, 0.03}, {length, 0.02, height}, p.wood);
    case Boundary::slats:
      return draw_slats(pen, length, height, p.board);
    case Boundary::stone_wall:
      return pen.box({0, -0.16, -0.5}, {length, 0.16, height}, p.board);
    case Boundary::wall_with_railing:
      pen.box({0, -0.13, -0.5}, {length, 0.13, 0.35 * height}, p.board);
      return draw_bars(pen, length, 0.35 * height, height, 0.14, 0.012, p.iron);
    case Boundary::balustrade:
      return draw_balustrade(pen, length, std::clamp(height, 0.8, 1.2), p.board);
    case Boundary::guard_rail:
      return draw_guard_rail(pen, p, length, height);
    case Boundary::site_fence:
      return draw_site_fence(pen, p, length, std::max(height, 1.9));
    case Boundary::hoarding:
      return pen.box({0, -0.02, 0}, {length, 0.02, std::max(height, 2.0)}, p.board);
    case Boundary::jersey:
      return draw_jersey(pen, length - 0.05, height, p.block);
    case Boundary::post_and_rail:
      return draw_post_and_rail(pen, length, height, p.wood);
    case Boundary::bars:
      draw_posts(pen, length, 1.0, 2.0, 0.03, p.iron);
      for (const double z : {0.5, 0.95})
        pen.tube({{0, 0, z}, {length, 0, z}}, {0.025, 0.025}, 6, p.iron, false);
      return;
  }
}

void add_gate(World& world, const StreetPalette& p, const SE3& T, double width, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double height = rng.uniform(0.9, 2);
  const double half = rng.uniform(0.12, 0.3);
  for (const double x : {0.0, width})
    pen.box({x - half, -half, -0.4}, {x + half, half, height + 0.2}, p.board);
  if (rng.chance(0.3)) return;  // stands open
  Pen leaf = pen.at(half, 0, 0);
  draw_bars(leaf, width - 2 * half, 0.1, height, rng.uniform(0.1, 0.2), 0.015, p.iron);
}

}  // namespace saker::simulation
