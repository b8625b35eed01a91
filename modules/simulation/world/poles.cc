#include <algorithm>

#include "saker/simulation/world/furniture.h"

namespace saker::simulation {
namespace {

/// A pole enters the truth with the radius at breast height and the height of its shaft.
ObjectId add_pole(World& world, const std::string& kind, const SE3& T_world_ground, double radius,
                  double height) {
  objects::Cylinder cylinder;
  cylinder.root = T_world_ground.translation();
  cylinder.axis = T_world_ground.linear().col(2);
  cylinder.radius = radius;
  cylinder.height = height;
  return world.add({"pole", kind, cylinder});
}

SE3 leaning(const SE3& T, core::Rng& rng, double sd) {
  SE3 lean = SE3::Identity();
  lean.linear() = core::so3_exp({rng.normal(0, sd), rng.normal(0, sd), 0});
  return T * lean;
}

MaterialId any_metal(World& world, const Palette& palette, core::Rng& rng) {
  return tinted(world, palette.metal, rng.uniform(0.08, 0.5));
}

}  // namespace

void add_lamp(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  const SE3 T = leaning(T_world_ground, rng, 0.008);
  const double r = rng.uniform(0.05, 0.13);
  const double height = rng.uniform(3.8, 9.5);
  const MaterialId metal = any_metal(world, palette, rng);
  Pen pen(world.mesh, T, add_pole(world, "lamp", T, r, height));
  const double top = r * rng.uniform(0.5, 0.9);
  pen.tube({{0, 0, -0.2}, {0, 0, 1.2}, {0, 0, height}}, {1.05 * r, r, top}, 12, metal);
  if (rng.chance(0.5)) pen.post(1.4 * r, rng.uniform(0.5, 1.2), metal);
  if (rng.chance(0.3)) {
    pen.ellipsoid({0, 0, height + 0.2}, {0.22, 0.22, 0.28}, palette.lamp);
    return;
  }
  const double arm = rng.uniform(0.4, 2.2);
  const double rise = rng.uniform(0, 0.4);
  const double side = rng.chance(0.5) ? 1 : -1;
  pen.tube({{0, 0, height - 0.05}, {0, side * arm, height + rise}}, {top, 0.03}, 8, metal);
  pen.box({-0.12, side * arm - 0.3, height + rise - 0.08},
          {0.12, side * arm + 0.3, height + rise + 0.06}, palette.lamp);
}

void add_power_pole(World& world, const Palette& palette, const SE3& T_world_ground,
                    core::Rng& rng) {
  const SE3 T = leaning(T_world_ground, rng, 0.02);
  const double r = rng.uniform(0.1, 0.17);
  const double height = rng.uniform(7, 10);
  const MaterialId wood = tinted(world, palette.metal, rng.uniform(0.2, 0.45));
  Pen pen(world.mesh, T, add_pole(world, "power", T, r, height));
  pen.tube({{0, 0, -0.2}, {0, 0, 1.2}, {0, 0, height}}, {1.08 * r, r, 0.7 * r}, 12, wood);
  pen.box({-0.05, -0.9, height - 0.6}, {0.05, 0.9, height - 0.48}, wood);
}

void add_traffic_light(World& world, const Palette& palette, const SE3& T_world_ground,
                       core::Rng& rng) {
  const double r = rng.uniform(0.05, 0.09);
  const double height = rng.uniform(3.0, 3.8);
  const MaterialId metal = any_metal(world, palette, rng);
  Pen pen(world.mesh, T_world_ground, add_pole(world, "traffic light", T_world_ground, r, height));
  pen.post(r, height, metal);
  pen.box({0.08, -0.16, height - 1.0}, {0.36, 0.16, height - 0.1}, palette.lamp);
  if (rng.chance(0.5)) pen.box({-0.1, -0.4, 2.1}, {-0.06, 0.4, 2.5}, palette.sign);
}

void add_sign(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  const SE3 T = leaning(T_world_ground, rng, 0.015);
  const double r = rng.uniform(0.025, 0.045);
  const double height = rng.uniform(2.1, 3.2);
  Pen pen(world.mesh, T, add_pole(world, "sign", T, r, height));
  pen.tube({{0, 0, -0.1}, {0, 0, height}}, {r, r}, 8, any_metal(world, palette, rng));
  const double w = rng.uniform(0.2, 0.45);
  const double h = rng.uniform(0.2, 0.45);
  Pen plate = pen.at(r + 0.01, 0, height - h, rng.normal(0, 0.25));
  if (rng.chance(0.5)) {
    plate.tube({{0, 0, 0}, {0.02, 0, 0}}, {w, w}, 14, palette.sign);
  } else {
    plate.box({0, -w, -h}, {0.02, w, h}, palette.sign);
  }
}

void add_bollard(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  Pen pen(world.mesh, T_world_ground);
  const double radius = rng.uniform(0.04, 0.1);
  pen.post(radius, rng.uniform(0.6, 1.05), palette.object, 10);
}

}  // namespace saker::simulation
