#include "saker/simulation/world/person.h"

#include <cmath>
#include <numbers>

#include "saker/simulation/world/vehicle_parts.h"

namespace saker::simulation {
namespace {

constexpr double kPi = std::numbers::pi;

void limb(Pen& pen, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
          double thick, MaterialId material) {
  pen.tube({a, b, c}, {thick, 0.85 * thick, 0.6 * thick}, 7, material);
}

/// Hips at `hips` above the ground; `leg` and `arm` swing fore and aft.
void draw_trunk(Pen& pen, double h, double hips, double lean, const Clothes& clothes,
                double girth) {
  const double chest = hips + 0.2 * h, neck = hips + 0.33 * h;
  pen.tube({{0, 0, hips - 0.05 * h},
            {0.4 * lean, 0, hips + 0.08 * h},
            {0.8 * lean, 0, chest},
            {lean, 0, neck}},
           {0.1 * h * girth, 0.095 * h * girth, 0.11 * h * girth, 0.05 * h}, 10, clothes.coat);
  pen.ellipsoid({lean + 0.01, 0, hips + 0.4 * h}, {0.058 * h, 0.048 * h, 0.07 * h}, clothes.skin);
}

void draw_upright(Pen& pen, double h, double stride, const Clothes& clothes, core::Rng& rng) {
  const double hips = 0.51 * h;
  const double girth = rng.uniform(0.85, 1.3);
  draw_trunk(pen, h, hips, rng.uniform(0, 0.06) * h, clothes, girth);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * 0.05 * h;
    const double reach = side * stride * h;
    limb(pen, {0, y, hips}, {0.6 * reach + 0.03 * h * stride, y, 0.27 * h}, {reach, y, 0.02},
         0.055 * h, clothes.trousers);
    pen.box({reach - 0.05 * h, y - 0.025 * h, 0}, {reach + 0.1 * h, y + 0.025 * h, 0.05 * h},
            clothes.gear);
    const double shoulder = side * 0.12 * h * girth;
    limb(pen, {0, shoulder, 0.81 * h}, {-0.4 * reach, 1.15 * shoulder, 0.63 * h},
         {-0.8 * reach + 0.04 * h, 1.1 * shoulder, 0.46 * h}, 0.033 * h, clothes.coat);
  }
}

/// Sits at `seat`; knees forward, feet on the ground or, of a rider, on pegs.
void draw_seated(Pen& pen, double h, double seat, bool rides, const Clothes& clothes,
                 core::Rng& rng) {
  const double lean = rides ? rng.uniform(0.05, 0.25) : rng.uniform(-0.05, 0.1);
  draw_trunk(pen, h, seat, lean, clothes, rng.uniform(0.85, 1.25));
  for (const double side : {-1.0, 1.0}) {
    const double y = side * 0.09 * h;
    const double foot = rides ? std::max(0.1, seat - 0.42 * h) : std::max(0.0, seat - 0.27 * h);
    const double knee = rides ? seat - 0.12 * h : seat + 0.02;
    limb(pen, {0, 0.6 * y, seat}, {0.25 * h, y, knee}, {(rides ? 0.12 : 0.28) * h, y, foot},
         0.05 * h, clothes.trousers);
    const double hand = rides ? 0.33 * h : 0.18 * h;
    limb(pen, {lean, 1.3 * y, seat + 0.3 * h}, {lean + 0.12 * h, 1.5 * y, seat + 0.16 * h},
         {lean + hand, 1.3 * y, seat + (rides ? 0.14 : 0.06) * h}, 0.033 * h, clothes.coat);
  }
}

void draw_ring(Pen& pen, double x, double y, double radius, double tube, MaterialId material) {
  std::vector<Eigen::Vector3d> rim;
  for (int i = 0; i <= 14; ++i) {
    const double angle = 2 * kPi * i / 14;
    rim.emplace_back(x + radius * std::cos(angle), y, radius + radius * std::sin(angle));
  }
  pen.tube(rim, std::vector<double>(rim.size(), tube), 5, material, false);
}

void draw_pram(Pen& pen, const Clothes& c, core::Rng& rng) {
  const double r = rng.uniform(0.1, 0.16);
  for (const double x : {0.4, 0.95}) {
    for (const double y : {-0.26, 0.26}) draw_ring(pen, x, y, r, 0.02, c.gear);
  }
  for (const double y : {-0.24, 0.24}) {
    pen.tube({{0.9, y, r}, {0.35, y, 0.75}, {0.15, y, 1.02}}, {0.015, 0.015, 0.015}, 5, c.gear);
  }
  pen.tube({{0.15, -0.24, 1.02}, {0.15, 0.24, 1.02}}, {0.015, 0.015}, 5, c.gear);
  pen.ellipsoid({0.72, 0, 0.62}, {0.4, 0.22, 0.18}, c.coat);
  if (rng.chance(0.6)) pen.ellipsoid({0.55, 0, 0.8}, {0.22, 0.23, 0.22}, c.coat);
}

void draw_wheelchair(Pen& pen, const Clothes& c) {
  for (const double side : {-0.3, 0.3}) {
    draw_ring(pen, -0.05, side, 0.3, 0.02, c.gear);
    draw_ring(pen, 0.4, side, 0.09, 0.02, c.gear);
    pen.box({-0.25, side - 0.02, 0.3}, {0.4, side + 0.02, 0.7}, c.gear);
  }
  pen.box({-0.22, -0.25, 0.45}, {0.25, 0.25, 0.5}, c.gear);
  pen.box({-0.25, -0.25, 0.5}, {-0.2, 0.25, 0.95}, c.gear);
}

void draw_umbrella(Pen& pen, double h, const Clothes& c) {
  const Eigen::Vector3d hub(0.15, 0.1, 1.2 * h);
  pen.tube({{0.2, 0.1, 0.7 * h}, hub}, {0.012, 0.012}, 5, c.gear);
  for (int i = 0; i < 8; ++i) {
    const auto rib = [&](int k) -> Eigen::Vector3d {
      const double angle = kPi * k / 4;
      return hub + Eigen::Vector3d(0.5 * std::cos(angle), 0.5 * std::sin(angle), -0.2);
    };
    pen.triangle(hub, rib(i), rib(i + 1), c.gear);
  }
}

void draw_belonging(Pen& pen, Belonging what, double h, const Clothes& c, core::Rng& rng) {
  switch (what) {
    case Belonging::none:
      return;
    case Belonging::pram:
      return draw_pram(pen, c, rng);
    case Belonging::wheelchair:
      return draw_wheelchair(pen, c);
    case Belonging::umbrella:
      return draw_umbrella(pen, h, c);
    case Belonging::suitcase:
      pen.box({-0.65, 0.1, 0.05}, {-0.4, 0.5, rng.uniform(0.55, 0.75)}, c.gear);
      pen.tube({{-0.4, 0.3, 0.65}, {-0.1, 0.3, 0.95}}, {0.012, 0.012}, 5, c.gear);
      return;
    case Belonging::bag:
      pen.box({-0.15, 0.28, 0.3 * h}, {0.2, 0.42, 0.46 * h}, c.gear);
      return;
    case Belonging::rucksack:
      pen.box({-0.3, -0.15, 0.56 * h}, {-0.08, 0.15, 0.8 * h}, c.gear);
  }
}

Belonging any_belonging(core::Rng& rng) {
  const double draw = rng.uniform();
  if (draw < 0.5) return Belonging::none;
  if (draw < 0.6) return Belonging::pram;
  if (draw < 0.65) return Belonging::wheelchair;
  if (draw < 0.7) return Belonging::umbrella;
  if (draw < 0.78) return Belonging::suitcase;
  return draw < 0.9 ? Belonging::bag : Belonging::rucksack;
}

}  // namespace

Clothes random_clothes(World& world, std::uint16_t label, core::Rng& rng) {
  const auto cloth = [&](double low, double high) {
    return world.add({label, static_cast<float>(rng.uniform(low, high)), 0.1F, 0, 0, 0.01F});
  };
  return {cloth(0.04, 0.7), cloth(0.04, 0.5), cloth(0.25, 0.5), cloth(0.05, 0.5)};
}

void draw_person(const Pen& pen, Posture posture, double height, double seat,
                 const Clothes& clothes, core::Rng& rng) {
  Pen draw = pen;
  switch (posture) {
    case Posture::seated:
      return draw_seated(draw, height, seat, false, clothes, rng);
    case Posture::riding:
      return draw_seated(draw, height, seat, true, clothes, rng);
    case Posture::standing:
      return draw_upright(draw, height, rng.uniform(0, 0.05), clothes, rng);
    default:
      return draw_upright(draw, height, rng.uniform(0.08, 0.22), clothes, rng);
  }
}

void add_passer_by(World& world, const SE3& T_world_ground, core::Rng& rng) {
  Pen pen(world.mesh, T_world_ground);
  const Clothes clothes = random_clothes(world, kPerson, rng);
  const bool child = rng.chance(0.15);
  const double h = child ? rng.uniform(0.9, 1.45) : rng.uniform(1.5, 1.95);
  const Belonging what = child ? Belonging::none : any_belonging(rng);
  const Posture posture = what == Belonging::wheelchair ? Posture::seated
                          : rng.chance(0.45)            ? Posture::standing
                                                        : Posture::walking;
  draw_person(pen, posture, h, 0.52, clothes, rng);
  draw_belonging(pen, what, h, clothes, rng);
}

void add_sitters(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng) {
  Pen pen(world.mesh, T_world_ground);
  const double top = rng.uniform(0.4, 0.5);
  const int count = 1 + rng.index(3);
  pen.box({-0.25, -0.4 * count, 0}, {0.2, 0.4 * count, top}, palette.structure);
  for (int i = 0; i < count; ++i) {
    const Clothes clothes = random_clothes(world, kPerson, rng);
    const double y = 0.75 * (i - 0.5 * (count - 1));
    draw_person(pen.at(0, y, 0), Posture::seated, rng.uniform(1.5, 1.9), top + 0.1, clothes, rng);
  }
}

}  // namespace saker::simulation
