#include <cmath>
#include <numbers>

#include "saker/simulation/world/street_furniture.h"

namespace saker::simulation {
namespace {

/// Most stand upright within a degree, some lean by several.
SE3 leaning(const SE3& T, core::Rng& rng) {
  const double sd = rng.chance(0.15) ? 0.05 : 0.01;
  SE3 lean = SE3::Identity();
  lean.linear() = core::so3_exp({rng.normal(0, sd), rng.normal(0, sd), 0});
  return T * lean;
}

/// Of tube, thicker the higher it is: a sign's post 0.06 to 0.11 m across, a lamp of 10 m 0.1 to
/// 0.26.
double any_radius(double height, core::Rng& rng) {
  return rng.uniform(0.025, 0.04) + height * rng.uniform(0.002, 0.009);
}

MaterialId any_coat(World& world, const StreetPalette& p, core::Rng& rng) {
  return any_tint(world, p.metal, 0.06, 0.6, rng);
}

void draw_shaft(Pen& pen, double radius, double height, double taper, MaterialId m) {
  pen.tube({{0, 0, -0.3}, {0, 0, 1.2}, {0, 0, height}}, {radius, radius, taper * radius},
           radius > 0.1 ? 14 : 9, m);
}

/// An arm from the shaft at `z` to `reach` along −y, rising, with a lamp's head.
void draw_arm(Pen& pen, double z, double reach, double rise, double radius, MaterialId m,
              MaterialId head) {
  pen.tube({{0, 0, z}, {0, -0.5 * reach, z + 0.8 * rise}, {0, -reach, z + rise}},
           {radius, 0.8 * radius, 0.7 * radius}, 8, m, false);
  pen.box({-0.13, -reach - 0.35, z + rise - 0.07}, {0.13, -reach + 0.3, z + rise + 0.07}, head);
}

void draw_plate(Pen& pen, double z, double half_width, double half_height, MaterialId m) {
  pen.box({-0.02, -half_width, z - half_height}, {0.0, half_width, z + half_height}, m);
}

}  // namespace

void add_armed_lamp(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, leaning(T, rng));
  const double height = rng.uniform(4, 11);
  const double radius = any_radius(height, rng);
  const MaterialId coat = any_coat(world, p, rng);
  draw_shaft(pen, radius, height, rng.uniform(0.4, 1), coat);
  if (rng.chance(0.5)) pen.post(1.4 * radius, rng.uniform(0.3, 1.3), coat);
  const int arms = 1 + rng.index(2);
  for (int i = 0; i < arms; ++i) {
    Pen arm = pen.at(0, 0, 0, i * std::numbers::pi);
    draw_arm(arm, height - 0.1, rng.uniform(0.5, 3), rng.uniform(0, 0.9), 0.4 * radius + 0.01, coat,
             p.lamp);
  }
}

void add_boxed_pole(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, leaning(T, rng));
  const double height = rng.uniform(2.2, 8);
  const double r = any_radius(height, rng);
  const MaterialId coat = any_coat(world, p, rng);
  draw_shaft(pen, r, height, 1, coat);
  const int boxes = 1 + rng.index(3);
  for (int i = 0; i < boxes; ++i) {
    const double z = rng.uniform(0.6, height - 0.8);
    const double w = rng.uniform(0.1, 0.3);
    Pen turned = pen.at(0, 0, 0, rng.uniform(-3.1, 3.1));
    turned.box({r, -w, z}, {r + rng.uniform(0.1, 0.3), w, z + rng.uniform(0.2, 0.7)}, coat);
  }
  const int plates = rng.index(3);
  for (int i = 0; i < plates; ++i) {
    Pen turned = pen.at(0, 0, 0, rng.normal(0, 0.5));
    Pen forward = turned.at(-r, 0, 0);
    draw_plate(forward, std::min(height - 0.3, 2.3 + 0.5 * i), rng.uniform(0.2, 0.45),
               rng.uniform(0.1, 0.35), p.sign);
  }
}

void add_mast_light(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double r = rng.uniform(0.08, 0.18);
  const double height = rng.uniform(5.5, 7);
  const double reach = rng.uniform(3, 9);
  const MaterialId coat = any_coat(world, p, rng);
  draw_shaft(pen, r, height, 0.8, coat);
  pen.tube({{0, 0, height - 0.2}, {0, -reach, height + 0.3}}, {0.7 * r, 0.4 * r}, 9, coat);
  for (double y = reach; y > 1.5; y -= 3) {
    pen.box({-0.2, -y - 0.18, height - 1}, {0.12, -y + 0.18, height + 0.15}, p.lamp);
  }
  pen.box({-0.3, -0.16, 2.2}, {-r, 0.16, 3.1}, p.lamp);
  if (rng.chance(0.5)) {
    Pen plate = pen.at(0, -0.5 * reach, 0);
    draw_plate(plate, height - 0.25, 0.9, 0.25, p.sign);
  }
}

void add_catenary_pole(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, leaning(T, rng));
  const double r = rng.uniform(0.09, 0.2);
  const double height = rng.uniform(6.5, 9);
  const MaterialId coat = any_coat(world, p, rng);
  if (rng.chance(0.3)) {  // a rolled section
    pen.box({-r, -r, -0.2}, {r, -0.8 * r, height}, coat);
    pen.box({-r, 0.8 * r, -0.2}, {r, r, height}, coat);
    pen.box({-0.01, -r, -0.2}, {0.01, r, height}, coat);
  } else {
    draw_shaft(pen, r, height, 0.8, coat);
  }
  const double reach = rng.uniform(2, 5);
  pen.tube({{0, 0, height - 1}, {0, -reach, height - 0.8}}, {0.04, 0.03}, 6, coat);
  pen.tube({{0, 0, height - 0.1}, {0, -reach, height - 0.8}}, {0.015, 0.015}, 4, coat);
  pen.tube({{-25, -reach, height - 1.1}, {25, -reach, height - 1.1}}, {0.012, 0.012}, 4, coat);
}

void add_cross_arm_pole(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, leaning(T, rng));
  const double r = rng.uniform(0.1, 0.2);
  const double height = rng.uniform(7, 12);
  const MaterialId wood = any_tint(world, p.metal, 0.2, 0.5, rng);
  draw_shaft(pen, r, height, 0.65, wood);
  const int arms = 1 + rng.index(3);
  for (int i = 0; i < arms; ++i) {
    const double z = height - 0.4 - 0.8 * i;
    pen.box({-0.06, -1.2, z - 0.06}, {0.06, 1.2, z + 0.06}, wood);
    for (const double y : {-1.1, -0.5, 0.5, 1.1})
      pen.tube({{-22, y, z + 0.12}, {22, y, z + 0.12}}, {0.01, 0.01}, 3, wood, false);
  }
  if (rng.chance(0.4)) pen.at(0.3, 0, height - 3).post(0.25, 0.9, wood);  // a transformer
  if (rng.chance(0.35)) {
    const double out = rng.uniform(1.5, 3.5);
    pen.tube({{0, 0, 0.7 * height}, {out, 0, 0}}, {0.012, 0.012}, 4, wood, false);
  }
  if (rng.chance(0.2)) pen.tube({{0, 0.2, 0.6 * height}, {0, 1.8, 0}}, {r, r}, 9, wood);  // a strut
}

void add_plain_pole(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, leaning(T, rng));
  const double height = rng.uniform(2, 12);
  const double r = any_radius(height, rng);
  const MaterialId coat = any_coat(world, p, rng);
  draw_shaft(pen, r, height, rng.uniform(0.5, 1), coat);
  const double draw = rng.uniform();
  if (draw < 0.25) {  // a flag
    pen.quad({0, r, height - 1.6}, {0.1, r + 1, height - 1.8}, {0.1, r + 1, height - 0.2},
             {0, r, height - 0.1}, p.canvas);
  } else if (draw < 0.5) {  // a camera
    pen.tube({{0, 0, height - 0.1}, {0, -0.6, height}}, {0.02, 0.02}, 5, coat);
    pen.box({-0.15, -0.7, height - 0.2}, {0.15, -0.5, height}, p.lamp);
  } else if (draw < 0.6) {  // banded with posters
    pen.at(0, 0, 1).post(1.3 * r + 0.01, 0.6, coat);
  }
}

void add_big_sign(World& world, const StreetPalette& p, const SE3& T, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double half = rng.uniform(0.6, 2.2);
  const double low = rng.uniform(0.4, 2.4);
  const double high = low + rng.uniform(0.7, 2.2);
  const MaterialId coat = any_coat(world, p, rng);
  for (const double y : {-0.8 * half, 0.8 * half})
    pen.at(0, y, -0.2).post(rng.uniform(0.04, 0.09), high + 0.2, coat, 9);
  pen.box({-0.12, -half, low}, {-0.08, half, high}, p.sign);
}

void add_gantry(World& world, const StreetPalette& p, const SE3& T, double width, core::Rng& rng) {
  Pen pen(world.mesh, T);
  const double height = rng.uniform(5.5, 7);
  const double r = rng.uniform(0.12, 0.25);
  const MaterialId coat = any_coat(world, p, rng);
  for (const double y : {0.0, width}) pen.at(0, y, -1).post(r, height + 1.2, coat, 12);
  pen.box({-0.2, 0, height - 0.2}, {0.2, width, height + 0.2}, coat);
  for (double y = 2; y + 3 < width; y += 4)
    pen.box({-0.3, y, height - 1.2}, {-0.25, y + 3, height + 1}, p.sign);
}

StreetAdder any_pole(core::Rng& rng) {
  constexpr StreetAdder kPoles[] = {add_armed_lamp,     add_armed_lamp, add_boxed_pole,
                                    add_boxed_pole,     add_plain_pole, add_plain_pole,
                                    add_cross_arm_pole, add_big_sign,   add_catenary_pole};
  return kPoles[rng.index(9)];
}

}  // namespace saker::simulation
