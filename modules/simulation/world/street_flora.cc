#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/simulation/world/street_plants.h"

namespace saker::simulation {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;

Eigen::Vector3d any_direction(core::Rng& rng) {
  const double z = rng.uniform(-1, 1);
  const double angle = rng.uniform(0, kFullTurn);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A spray of leaves: a card whose normal is `facing`, tilted at random.
void draw_card(Pen& pen, const Eigen::Vector3d& centre, const Eigen::Vector3d& facing, double size,
               MaterialId material, core::Rng& rng) {
  const Eigen::Vector3d normal = (facing + 0.8 * any_direction(rng)).normalized();
  const Eigen::Vector3d u = 0.5 * size * normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  pen.quad(centre - u - v, centre + u - v, centre + u + v, centre - u + v, material);
}

std::size_t keep(World& world, Mesh mesh) {
  world.prototypes.push_back(std::move(mesh));
  return world.prototypes.size() - 1;
}

/// A core under a thin skin: faces and edges nearly as sharp as a car's, ragged by `ragged`.
Mesh box_hedge(const StreetPalette& p, double ragged, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const double skin = 0.03 + ragged;
  pen.box({-0.5 + 0.3 * skin, -0.5 + skin, 0}, {0.5 - 0.3 * skin, 0.5 - skin, 1 - skin}, p.hedge);
  const int leaves = 500 + rng.index(500);
  for (int i = 0; i < leaves; ++i) {
    Eigen::Vector3d at(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), rng.uniform(0, 1));
    Eigen::Vector3d facing = Eigen::Vector3d::Zero();
    const int axis = rng.chance(0.35) ? 2 : rng.chance(0.75) ? 1 : 0;
    const double side = axis == 2 || rng.chance(0.5) ? 1 : -1;
    facing[axis] = side;
    const double face = axis == 2 ? 1 : side * 0.5;
    at[axis] = face - side * std::abs(rng.normal(0, skin));
    draw_card(pen, at, facing, rng.uniform(0.02, 0.09), p.leaves, rng);
  }
  return mesh;
}

/// A bush clipped to a dome, or grown to one.
Mesh dome(const StreetPalette& p, double ragged, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const double core = 0.94 - ragged;
  const double squareness = rng.uniform(0.5, 1);  // of its outline: 1 is an ellipsoid
  const auto shaped = [&](Eigen::Vector3d v, double r) -> Eigen::Vector3d {
    v.z() = std::copysign(std::pow(std::abs(v.z()), squareness), v.z());
    return {r * v.x(), r * v.y(), std::max(0.0, 0.45 + 0.55 * r * v.z())};
  };
  pen.ellipsoid({0, 0, 0.42}, {core, core, 0.5 * core}, p.hedge);
  pen.box({-0.6 * core, -0.6 * core, 0}, {0.6 * core, 0.6 * core, 0.5}, p.hedge);
  const int leaves = 900 + rng.index(1200);
  for (int i = 0; i < leaves; ++i) {
    const Eigen::Vector3d v = any_direction(rng);
    const double r = 1 - std::abs(rng.normal(0, 0.03 + ragged));
    draw_card(pen, shaped(v, r), v, rng.uniform(0.03, 0.11), p.leaves, rng);
  }
  return mesh;
}

/// Stems from the ground that spread, with leaves at their ends only.
Mesh twiggy_bush(const StreetPalette& p, double leafy, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const int stems = 9 + rng.index(25);
  for (int i = 0; i < stems; ++i) {
    const double turn = rng.uniform(0, kFullTurn);
    const double out = rng.uniform(0.1, 1);
    const Eigen::Vector3d foot(0.15 * std::cos(turn), 0.15 * std::sin(turn), -0.05);
    const Eigen::Vector3d tip(out * std::cos(turn), out * std::sin(turn), rng.uniform(0.5, 1));
    const Eigen::Vector3d knee = 0.5 * (foot + tip) + Eigen::Vector3d(0, 0, rng.uniform(0, 0.15));
    pen.tube({foot, knee, tip}, {rng.uniform(0.008, 0.03), 0.012, 0.005}, 4, p.stems, false);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d twig =
          knee + 0.35 * any_direction(rng).cwiseAbs().cwiseProduct(
                            Eigen::Vector3d(std::cos(turn), std::sin(turn), 1));
      pen.tube({knee, twig}, {0.008, 0.003}, 3, p.stems, false);
    }
    const int leaves = static_cast<int>(leafy * rng.uniform(20, 70));
    for (int k = 0; k < leaves; ++k) {
      const double along = std::pow(rng.uniform(), 0.5);
      Eigen::Vector3d at = knee + along * (tip - knee) + 0.16 * any_direction(rng);
      at.z() = std::clamp(at.z(), 0.0, 1.0);
      draw_card(pen, at, any_direction(rng), rng.uniform(0.03, 0.1), p.leaves, rng);
    }
  }
  return mesh;
}

Mesh ivy_sheet(const StreetPalette& p, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const int leaves = 300 + rng.index(600);
  for (int i = 0; i < leaves; ++i) {
    const double z = std::pow(rng.uniform(), rng.uniform(1, 2));
    draw_card(pen, {rng.uniform(-0.5, 0.5), -std::abs(rng.normal(0, 0.08)), z}, {0, -1, 0},
              rng.uniform(0.04, 0.13), p.ivy, rng);
  }
  return mesh;
}

Mesh tuft(const StreetPalette& p, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const int blades = 60 + rng.index(160);
  for (int i = 0; i < blades; ++i) {
    const double turn = rng.uniform(0, kFullTurn);
    const double out = std::sqrt(rng.uniform());
    const Eigen::Vector3d foot(0.6 * out * std::cos(turn), 0.6 * out * std::sin(turn), 0);
    const Eigen::Vector3d tip =
        foot + Eigen::Vector3d(rng.normal(0, 0.25), rng.normal(0, 0.25), rng.uniform(0.4, 1));
    const Eigen::Vector3d wide(-0.03 * std::sin(turn), 0.03 * std::cos(turn), 0);
    pen.triangle(foot - wide, foot + wide, tip, p.blades);
  }
  return mesh;
}

Mesh flower_bed(const StreetPalette& p, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const bool even = rng.chance(0.5);
  const int plants = 200 + rng.index(300);
  for (int i = 0; i < plants; ++i) {
    const double z = even ? rng.uniform(0.6, 1) : rng.uniform(0, 1);
    draw_card(pen, {rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5), z}, {0, 0, 1},
              rng.uniform(0.04, 0.14), rng.chance(0.3) ? p.bloom : p.leaves, rng);
  }
  return mesh;
}

/// Fronds that rise from the middle and hang down at their ends.
Mesh palm_head(const StreetPalette& p, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const int fronds = 14 + rng.index(20);
  for (int i = 0; i < fronds; ++i) {
    const double turn = rng.uniform(0, kFullTurn);
    const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0);
    const Eigen::Vector3d across(-std::sin(turn), std::cos(turn), 0);
    const double rise = rng.uniform(-0.3, 0.9);
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (int k = 1; k <= 5; ++k) {
      const double t = 0.2 * k;
      const Eigen::Vector3d at = t * out + Eigen::Vector3d(0, 0, rise * t - 0.9 * t * t);
      const Eigen::Vector3d w = 0.13 * (1.1 - t) * across + Eigen::Vector3d(0, 0, -0.04);
      pen.quad(before, at, at + w, before + w, p.blades);
      pen.quad(before, at, at - w, before - w, p.blades);
      before = at;
    }
  }
  return mesh;
}

Mesh skirted_conifer(const StreetPalette& p, core::Rng& rng) {
  Mesh mesh;
  Pen pen(mesh);
  const int leaves = 2500 + rng.index(2500);
  const double power = rng.uniform(0.25, 0.6);
  pen.tube({{0, 0, 0}, {0, 0, 0.5}, {0, 0, 0.95}}, {0.5, 0.3, 0.02}, 8, p.hedge);
  for (int i = 0; i < leaves; ++i) {
    const double z = 1 - std::sqrt(rng.uniform());
    const double r = std::pow(1 - z, 0.9) * std::pow(rng.uniform(), power);
    const double turn = rng.uniform(0, kFullTurn);
    draw_card(pen, {r * std::cos(turn), r * std::sin(turn), z}, {0, 0, 1}, rng.uniform(0.02, 0.08),
              p.leaves, rng);
  }
  return mesh;
}

}  // namespace

StreetFlora grow_street_flora(World& world, const StreetPalette& p, core::Rng& rng) {
  StreetFlora f;
  for (int i = 0; i < 3; ++i) {
    f.boxes.push_back(keep(world, box_hedge(p, 0.02 * i, rng)));
    f.rounds.push_back(keep(world, dome(p, 0.05 * i, rng)));
    f.twiggy.push_back(keep(world, twiggy_bush(p, i * rng.uniform(0.3, 1), rng)));
    f.tufts.push_back(keep(world, tuft(p, rng)));
  }
  for (int i = 0; i < 2; ++i) {
    f.sheets.push_back(keep(world, ivy_sheet(p, rng)));
    f.beds.push_back(keep(world, flower_bed(p, rng)));
    f.skirted.push_back(keep(world, skirted_conifer(p, rng)));
  }
  f.fronds.push_back(keep(world, palm_head(p, rng)));
  return f;
}

void widen_flora(World& world, const StreetPalette& p, Flora& flora, core::Rng& rng) {
  flora.bushes.push_back(keep(world, twiggy_bush(p, 1.2, rng)));
  flora.bushes.push_back(keep(world, dome(p, rng.uniform(0.02, 0.2), rng)));
  flora.hedges.push_back(keep(world, box_hedge(p, rng.uniform(0, 0.06), rng)));
}

}  // namespace saker::simulation
