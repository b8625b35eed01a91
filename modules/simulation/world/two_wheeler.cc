#include "saker/simulation/world/two_wheeler.h"

#include <cmath>
#include <numbers>

#include "saker/simulation/world/person.h"
#include "saker/simulation/world/vehicle_parts.h"

namespace saker::simulation {
namespace {

using V = Eigen::Vector3d;

/// A wheel that one sees through: a tyre, a rim of half its depth and a hub.
void draw_wheel(Pen& pen, double x, double radius, double tyre, MaterialId rubber,
                MaterialId spokes) {
  std::vector<V> ring;
  for (int i = 0; i <= 18; ++i) {
    const double angle = 2 * std::numbers::pi * i / 18;
    ring.emplace_back(x + (radius - tyre) * std::cos(angle), 0,
                      radius + (radius - tyre) * std::sin(angle));
  }
  pen.tube(ring, std::vector<double>(ring.size(), tyre), 6, rubber, false);
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi * i / 6;
    const V reach(0.9 * radius * std::cos(angle), 0, 0.9 * radius * std::sin(angle));
    const V hub(x, 0, radius);
    pen.tube({hub - reach, hub + reach}, {0.008, 0.008}, 4, spokes);
  }
}

void bar(Pen& pen, const V& a, const V& b, double thick, MaterialId material) {
  pen.tube({a, b}, {thick, thick}, 6, material);
}

void draw_motorcycle(Pen& pen, const Parts& p, core::Rng& rng) {
  const double base = rng.uniform(1.38, 1.65), r = rng.uniform(0.29, 0.33);
  const double rear = -base / 2, front = base / 2;
  draw_wheel(pen, rear, r, 0.08, p.rubber, p.rim);
  draw_wheel(pen, front, r, 0.06, p.rubber, p.rim);
  const V head(front - 0.35, 0, 0.95);
  for (const double y : {-0.09, 0.09}) {
    bar(pen, {front, y, r}, {head.x(), y, head.z()}, 0.025, p.chrome);
    bar(pen, {rear, y, r}, {rear + 0.5, y, 0.45}, 0.03, p.dark);
    bar(pen, {rear + 0.1, 1.6 * y, 0.4}, {0.1, 1.6 * y, 0.3}, 0.045, p.chrome);  // exhaust
  }
  pen.box({-0.25, -0.17, 0.2}, {0.3, 0.17, 0.55}, p.dark);        // engine
  pen.ellipsoid({0.12, 0, 0.78}, {0.3, 0.15, 0.15}, p.paint);     // tank
  pen.ellipsoid({-0.4, 0, 0.78}, {0.4, 0.13, 0.07}, p.interior);  // seat
  bar(pen, {-0.3, 0, 0.75}, {rear - 0.2, 0, 0.8}, 0.07, p.paint);
  bar(pen, {head.x(), -0.38, 1.02}, {head.x(), 0.38, 1.02}, 0.02, p.chrome);
  pen.ellipsoid({head.x() + 0.1, 0, 0.88}, {0.1, 0.1, 0.1}, p.chrome);  // lamp
  for (const double side : {-1.0, 1.0}) {
    pen.ellipsoid({head.x() + 0.02, side * 0.4, 1.14}, {0.02, 0.06, 0.04}, p.chrome);
  }
  if (rng.chance(0.45)) {  // a fairing
    draw_prism(pen,
               {{head.x() + 0.3, 0.75}, {head.x() + 0.1, 1.2}, {head.x() - 0.05, 1.0}, {0.2, 0.5}},
               -0.2, 0.2, p.paint);
  }
  if (rng.chance(0.3)) {
    for (const double y : {-0.42, 0.2}) {
      pen.box({rear - 0.25, y, 0.5}, {rear + 0.3, y + 0.22, 0.85}, p.second);
    }
  }
}

void draw_scooter(Pen& pen, const Parts& p, core::Rng& rng) {
  const double base = rng.uniform(1.22, 1.4), r = rng.uniform(0.21, 0.25);
  const double rear = -base / 2, front = base / 2;
  draw_wheel(pen, rear, r, 0.06, p.rubber, p.rim);
  draw_wheel(pen, front, r, 0.055, p.rubber, p.rim);
  const V head(front - 0.25, 0, 0.95);
  bar(pen, {front, 0, r}, head, 0.05, p.dark);
  draw_prism(
      pen,
      {{front - 0.1, 0.35}, {head.x() + 0.08, 1.0}, {head.x() - 0.02, 1.0}, {front - 0.3, 0.3}},
      -0.2, 0.2, p.paint);
  pen.box({-0.15, -0.16, 0.25}, {front - 0.2, 0.16, 0.32}, p.paint);  // where the feet stand
  draw_prism(pen, {{-0.15, 0.3}, {-0.1, 0.72}, {rear - 0.25, 0.75}, {rear - 0.15, 0.45}}, -0.16,
             0.16, p.paint);
  pen.ellipsoid({rear / 2 - 0.15, 0, 0.78}, {0.4, 0.15, 0.07}, p.interior);
  bar(pen, {head.x(), -0.34, 1.03}, {head.x(), 0.34, 1.03}, 0.025, p.dark);
  for (const double side : {-1.0, 1.0}) {
    pen.ellipsoid({head.x() + 0.02, side * 0.3, 1.18}, {0.02, 0.06, 0.05}, p.chrome);
  }
  if (rng.chance(0.35)) {
    pen.box({rear - 0.35, -0.2, 0.82}, {rear + 0.05, 0.2, rng.uniform(1.1, 1.3)}, p.second);
  }
  if (rng.chance(0.25)) {  // a screen
    pen.quad({head.x() + 0.08, -0.2, 1.0}, {head.x() + 0.08, 0.2, 1.0},
             {head.x() - 0.05, 0.18, 1.35}, {head.x() - 0.05, -0.18, 1.35}, p.glass);
  }
}

void draw_bicycle(Pen& pen, const Parts& p, bool cargo, core::Rng& rng) {
  const double r = rng.uniform(0.3, 0.36),
               base = cargo ? rng.uniform(1.6, 1.9) : rng.uniform(0.98, 1.1);
  const double rear = -base / 2, front = base / 2;
  draw_wheel(pen, rear, r, 0.02, p.rubber, p.rim);
  draw_wheel(pen, front, cargo ? 0.26 : r, 0.02, p.rubber, p.rim);
  const V crank(rear + 0.45, 0, 0.28), seat(rear + 0.28, 0, rng.uniform(0.8, 1.0));
  const V head(rear + 0.9, 0, 0.85), grip(rear + 0.85, 0, 1.03);
  bar(pen, crank, seat, 0.018, p.paint);
  bar(pen, crank, head, 0.022, p.paint);
  if (rng.chance(0.6)) bar(pen, {seat.x() + 0.05, 0, 0.75}, head, 0.018, p.paint);
  bar(pen, {rear, 0, r}, crank, 0.014, p.paint);
  bar(pen, {rear, 0, r}, {seat.x() + 0.05, 0, 0.7}, 0.014, p.paint);
  bar(pen, head, grip, 0.018, p.chrome);
  bar(pen, head, {front, 0, cargo ? 0.26 : r}, 0.02, p.paint);
  bar(pen, grip + V(0, -0.29, 0), grip + V(0, 0.29, 0), 0.016, p.chrome);
  pen.ellipsoid(seat + V(0, 0, 0.03), {0.13, 0.08, 0.04}, p.interior);
  bar(pen, crank + V(0.12, -0.14, 0.1), crank + V(-0.12, 0.14, -0.1), 0.015, p.chrome);
  if (rng.chance(0.4)) pen.box({rear - 0.2, -0.07, 0.7}, {rear + 0.2, 0.07, 0.73}, p.chrome);
  if (cargo) {
    pen.box({front - 0.75, -0.32, 0.3}, {front - 0.1, 0.32, rng.uniform(0.7, 0.9)}, p.second);
  } else if (rng.chance(0.2)) {
    pen.box({grip.x() + 0.05, -0.17, 0.8}, {grip.x() + 0.35, 0.17, 1.02}, p.second);
  }
}

SE3 leaning(double angle) {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::AngleAxisd(angle, V::UnitX()).toRotationMatrix();
  return T;
}

}  // namespace

void add_two_wheeler(World& world, const Palette& palette, TwoWheeler kind,
                     const SE3& T_world_ground, bool ridden, core::Rng& rng) {
  const bool motor = kind == TwoWheeler::motorcycle || kind == TwoWheeler::scooter;
  const Parts parts = make_parts(world, palette, motor ? kMotorcycle : kBicycle, rng);
  const double lean = ridden ? rng.normal(0, 0.03) : rng.uniform(-0.2, 0.2);
  Pen pen = Pen(world.mesh, T_world_ground).at(leaning(lean));
  if (kind == TwoWheeler::motorcycle) {
    draw_motorcycle(pen, parts, rng);
  } else if (kind == TwoWheeler::scooter) {
    draw_scooter(pen, parts, rng);
  } else {
    draw_bicycle(pen, parts, kind == TwoWheeler::cargo_bicycle, rng);
  }
  if (!ridden) return;
  const Clothes clothes = random_clothes(world, motor ? kMotorcyclist : kBicyclist, rng);
  const double seat = motor ? 0.84 : 1.0;
  const double back = kind == TwoWheeler::cargo_bicycle ? -0.55 : motor ? -0.3 : -0.2;
  draw_person(pen.at(back, 0, 0), Posture::riding, rng.uniform(1.55, 1.9), seat, clothes, rng);
  if (motor && rng.chance(0.15)) {
    draw_person(pen.at(back - 0.4, 0, 0), Posture::riding, rng.uniform(1.5, 1.8), seat + 0.05,
                clothes, rng);
  }
}

void add_bicycle_stand(World& world, const Palette& palette, const SE3& T_world_ground,
                       core::Rng& rng) {
  Pen pen(world.mesh, T_world_ground);
  const double height = rng.uniform(0.4, 0.85), half = rng.uniform(0.25, 0.45);
  pen.tube({{-half, 0, 0}, {-half, 0, height}, {half, 0, height}, {half, 0, 0}},
           {0.025, 0.025, 0.025, 0.025}, 6, palette.structure);
}

}  // namespace saker::simulation
