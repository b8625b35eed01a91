#include "saker/simulation/world/plants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kLeastStem_m = 1.0;  // under the crown: boughs to the ground leave no trunk to see

std::size_t any_of(const std::vector<std::size_t>& prototypes, core::Rng& rng) {
  return prototypes[rng.index(static_cast<int>(prototypes.size()))];
}

void place(World& world, std::size_t prototype, const SE3& T_world_foot,
           const Eigen::Vector3d& scale, double yaw, ObjectId object) {
  Eigen::Affine3d T(T_world_foot.matrix());
  T = T * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::Scaling(scale);
  world.placements.push_back({prototype, T.cast<float>(), object});
}

double any_turn(core::Rng& rng) { return rng.uniform(0, 2 * std::numbers::pi); }

/// The trunk's middle line from below the ground to `top`, bent a little.
std::vector<Eigen::Vector3d> trunk_path(const TreeShape& s, double top, core::Rng& rng) {
  const double bend = rng.normal(0, 0.015);
  const double turn = any_turn(rng);
  std::vector<Eigen::Vector3d> path;
  for (const double z : {-0.3, 0.0, 0.15, 0.4, 1.2, 0.5 * (1.2 + top), top}) {
    const double out = bend * z * (z - 1.2);
    path.emplace_back(s.lean_x * z + out * std::cos(turn), s.lean_y * z + out * std::sin(turn), z);
  }
  return path;
}

/// From the flare of the roots to the taper under the crown.
std::vector<double> trunk_radii(const TreeShape& s, core::Rng& rng) {
  const double flare = rng.uniform(1.1, 1.6);
  std::vector<double> radii;
  for (const double factor : {flare, flare, 0.5 * (1.1 + flare), 1.06, 1.0, 0.85, 0.6}) {
    radii.push_back(factor * s.trunk_radius);
  }
  return radii;
}

void draw_branches(const TreeShape& s, const Eigen::Vector3d& fork, MaterialId material,
                   const Pen& pen, core::Rng& rng) {
  Pen draw = pen;
  const int count = s.bare ? 14 + rng.index(12) : 3 + rng.index(5);
  for (int i = 0; i < count; ++i) {
    const double turn = any_turn(rng);
    const double reach = s.crown_radius * rng.uniform(0.35, 0.85);
    const double rise = s.crown_height * rng.uniform(0.1, 0.8);
    const Eigen::Vector3d out(reach * std::cos(turn), reach * std::sin(turn), rise);
    const double radius = s.trunk_radius * rng.uniform(0.15, 0.4);
    const Eigen::Vector3d start = fork + Eigen::Vector3d(0, 0, rng.uniform(-0.1, 0.4 * rise));
    const Eigen::Vector3d middle = start + 0.5 * out + Eigen::Vector3d(0, 0, -0.08 * rise);
    draw.tube({start, middle, start + out}, {radius, 0.6 * radius, 0.012}, 5, material, false);
    if (!s.bare) continue;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d twig{rng.normal(0, 0.5), rng.normal(0, 0.5), rng.uniform(0, 0.8)};
      draw.tube({middle, middle + twig}, {0.02, 0.008}, 4, material, false);
    }
  }
}

ObjectId add_trunk(World& world, const TreeShape& shape, const SE3& T_world_ground) {
  objects::Cylinder cylinder;
  cylinder.root = T_world_ground.translation();
  cylinder.axis =
      T_world_ground.linear() * Eigen::Vector3d(shape.lean_x, shape.lean_y, 1).normalized();
  cylinder.radius = shape.trunk_radius;
  cylinder.height = shape.crown_start;
  return world.add({"trunk", shape.conifer ? "conifer" : "broadleaf", cylinder});
}

}  // namespace

TreeShape random_tree(core::Rng& rng) {
  TreeShape s;
  const double age = rng.uniform();
  s.conifer = rng.chance(0.15);
  s.bare = !s.conifer && rng.chance(0.08);
  s.trunk_radius = std::clamp((0.05 + 0.3 * age * age) * rng.uniform(0.8, 1.3), 0.045, 0.42);
  s.crown_start = rng.uniform(1.5, 2.2);
  s.crown_start += 2.4 * age * rng.uniform();
  s.crown_radius = (0.8 + 3.0 * age) * rng.uniform(0.75, 1.2);
  s.crown_height = (1.8 + 5.5 * age) * rng.uniform(0.8, 1.25);
  if (s.conifer) {
    s.crown_start *= rng.chance(0.5) ? 0.3 : 0.8;
    s.crown_radius *= 0.7;
    s.crown_height *= 1.5;
  }
  s.lean_x = rng.normal(0, 0.03);
  s.lean_y = rng.normal(0, 0.03);
  return s;
}

void add_tree(World& world, const Palette& palette, const Flora& flora, const TreeShape& shape,
              const SE3& T_world_ground, core::Rng& rng) {
  const ObjectId id =
      shape.crown_start < kLeastStem_m ? 0 : add_trunk(world, shape, T_world_ground);
  Pen pen(world.mesh, T_world_ground, id);
  const double top = shape.crown_start + 0.45 * shape.crown_height;
  const MaterialId bark = tinted(
      world, palette.bark, world.materials[palette.bark].reflectivity * rng.uniform(0.7, 1.3));
  const int sides = shape.trunk_radius > 0.15 ? 14 : 9;
  pen.tube(trunk_path(shape, top, rng), trunk_radii(shape, rng), sides, bark);
  const double z = shape.crown_start;
  const Eigen::Vector3d fork(shape.lean_x * z, shape.lean_y * z, z);
  if (!shape.conifer) draw_branches(shape, fork, palette.twigs, pen, rng);
  if (shape.bare) return;
  const SE3 T_world_crown = T_world_ground * placed(fork.x(), fork.y(), fork.z() - 0.1);
  const double depth = shape.crown_radius * rng.uniform(0.8, 1.2);
  const double turn = any_turn(rng);
  place(world, any_of(shape.conifer ? flora.conifers : flora.crowns, rng), T_world_crown,
        {shape.crown_radius, depth, shape.crown_height}, turn, id);
}

void add_bush(World& world, const Flora& flora, const SE3& T_world_ground, double radius,
              double height, core::Rng& rng) {
  const double depth = radius * rng.uniform(0.7, 1.3);
  const double turn = any_turn(rng);
  place(world, any_of(flora.bushes, rng), T_world_ground, {radius, depth, height}, turn, 0);
}

void add_hedge_block(World& world, const Flora& flora, const SE3& T_world_ground, double length,
                     double depth, double height, core::Rng& rng) {
  const double turn = rng.chance(0.5) ? 0 : std::numbers::pi;
  place(world, any_of(flora.hedges, rng), T_world_ground * placed(length / 2, 0, 0),
        {length, depth, height}, turn, 0);
}

}  // namespace saker::simulation
