#include "saker/simulation/world/furniture.h"

#include <cmath>
#include <numbers>

namespace saker::simulation {

void add_bin(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  Pen pen = Pen(world.mesh, T_world_ground).at(0, 0, 0, rng.uniform(-0.4, 0.4));
  const MaterialId material = tinted(world, palette.object, rng.uniform(0.05, 0.5));
  if (rng.chance(0.3)) {  // a container on wheels
    pen.box({-0.65, -0.5, 0.12}, {0.65, 0.5, 1.05}, material);
    pen.box({-0.68, -0.53, 1.05}, {0.68, 0.53, 1.25}, material);
    return;
  }
  const double w = rng.uniform(0.24, 0.32);
  const double h = rng.uniform(0.9, 1.1);
  pen.box({-w, -w, 0.04}, {w, w, h}, material);
  pen.box({-w - 0.03, -w - 0.03, h}, {w + 0.05, w + 0.03, h + 0.06}, material);
}

void add_bench(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng&) {
  Pen pen(world.mesh, T_world_ground);
  for (const double y : {-0.15, 0.0, 0.15}) {
    pen.box({-0.8, y - 0.06, 0.42}, {0.8, y + 0.06, 0.46}, palette.object);
  }
  for (const double z : {0.58, 0.75}) {
    pen.box({-0.8, 0.22, z}, {0.8, 0.26, z + 0.12}, palette.object);
  }
  for (const double x : {-0.6, 0.6}) {
    pen.box({x - 0.03, -0.2, 0}, {x + 0.03, 0.25, 0.42}, palette.object);
    pen.box({x - 0.03, 0.21, 0.42}, {x + 0.03, 0.25, 0.88}, palette.object);
  }
}

void add_box(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  const double w = rng.uniform(0.3, 0.9);
  const double d = rng.uniform(0.15, 0.4);
  const double h = rng.uniform(0.7, 1.6);
  const MaterialId material =
      tinted(world, rng.chance(0.5) ? palette.object : palette.structure, rng.uniform(0.15, 0.5));
  Pen(world.mesh, T_world_ground).box({-w, -d, 0}, {w, d, h}, material);
}

void add_shelter(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  Pen pen(world.mesh, T_world_ground);
  const double w = rng.uniform(1.5, 2.4);
  const MaterialId pane = world.add({kOtherStructure, 0.06F, 0.04F, 0.995F, 0.5F, 0});
  pen.box({-w, -0.8, 2.3}, {w, 0.8, 2.42}, palette.structure);
  for (const double x : {-w, w}) {
    for (const double y : {-0.7, 0.7}) pen.at(0.97 * x, y, 0).post(0.05, 2.3, palette.structure, 8);
    pen.box({x - 0.01, -0.7, 0.2}, {x + 0.01, 0.5, 2.1}, pane);
  }
  pen.box({-w, 0.69, 0.2}, {w, 0.71, 2.1}, pane);
  pen.box({-0.8 * w, 0.3, 0.4}, {0.5 * w, 0.65, 0.46}, palette.structure);
}

void add_person(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  const double h = rng.uniform(1.5, 1.9);
  const MaterialId clothes = tinted(world, palette.person, rng.uniform(0.05, 0.6));
  Pen pen = Pen(world.mesh, T_world_ground).at(0, 0, 0, rng.uniform(0, 2 * std::numbers::pi));
  const double step = rng.uniform(0, 0.3);
  for (const double side : {-1.0, 1.0}) {
    pen.tube({{side * step, 0.09 * side, 0.03}, {0, 0.09 * side, 0.48 * h}}, {0.06, 0.085}, 8,
             clothes);
    pen.tube({{0, 0.22 * side, 0.8 * h}, {-side * 0.7 * step, 0.27 * side, 0.45 * h}}, {0.05, 0.04},
             6, clothes);
  }
  pen.ellipsoid({0, 0, 0.65 * h}, {0.14, 0.21, 0.22 * h}, clothes);
  pen.ellipsoid({0, 0, 0.92 * h}, {0.1, 0.09, 0.08 * h}, palette.person);
}

void add_bicycle(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  Pen pen = Pen(world.mesh, T_world_ground).at(0, 0, 0, rng.normal(0, 0.3));
  constexpr double kWheel = 0.34;
  for (const double x : {-0.52, 0.52}) {
    std::vector<Eigen::Vector3d> rim;
    for (int i = 0; i <= 16; ++i) {
      const double angle = 2 * std::numbers::pi * i / 16;
      rim.emplace_back(x + kWheel * std::cos(angle), 0, kWheel + kWheel * std::sin(angle));
    }
    pen.tube(rim, std::vector<double>(rim.size(), 0.025), 5, palette.bicycle, false);
  }
  const Eigen::Vector3d crank(-0.05, 0, 0.3), seat(-0.2, 0, 0.9), head(0.38, 0, 0.85);
  for (const auto& [a, b] : {std::pair(crank, seat), std::pair(crank, head), std::pair(seat, head),
                             std::pair(Eigen::Vector3d(0.52, 0, kWheel), head)}) {
    pen.tube({a, b}, {0.022, 0.022}, 5, palette.bicycle);
  }
  pen.box({0.3, -0.28, 0.98}, {0.36, 0.28, 1.02}, palette.bicycle);
  pen.box({-0.3, -0.08, 0.9}, {-0.08, 0.08, 0.96}, palette.bicycle);
  if (!rng.chance(0.2)) return;
  add_person(world, palette, T_world_ground * placed(-0.15, 0, 0.25), rng);
}

void add_container(World& world, const Palette& palette, const SE3& T_world_ground,
                   core::Rng& rng) {
  const double length = rng.chance(0.5) ? rng.uniform(2.5, 4) : rng.uniform(6, 6.1);
  const double width = rng.uniform(1.6, 2.45);
  const double height = rng.uniform(1.3, 2.6);
  const MaterialId material = tinted(world, palette.structure, rng.uniform(0.1, 0.5));
  Pen(world.mesh, T_world_ground)
      .box({-length / 2, -width / 2, 0}, {length / 2, width / 2, height}, material);
}

}  // namespace saker::simulation
