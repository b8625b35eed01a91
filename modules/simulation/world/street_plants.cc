#include "saker/simulation/world/street_plants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::simulation {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;

std::size_t any_of(const std::vector<std::size_t>& prototypes, core::Rng& rng) {
  return prototypes[rng.index(static_cast<int>(prototypes.size()))];
}

void place(World& world, std::size_t prototype, const SE3& T_world_foot,
           const Eigen::Vector3d& scale, double yaw) {
  Eigen::Affine3d T(T_world_foot.matrix());
  T = T * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::Scaling(scale);
  world.placements.push_back({prototype, T.cast<float>(), 0});
}

/// One stem from the ground to `tip`, bent, with its taper; returns nothing: it is trunk.
void draw_stem(Pen& pen, const Eigen::Vector3d& foot, const Eigen::Vector3d& tip, double radius,
               MaterialId bark, core::Rng& rng) {
  const Eigen::Vector3d bend(rng.normal(0, 0.05), rng.normal(0, 0.05), 0);
  const Eigen::Vector3d low = foot + 0.12 * (tip - foot);
  const Eigen::Vector3d middle = foot + 0.5 * (tip - foot) + bend;
  pen.tube({foot - Eigen::Vector3d(0, 0, 0.3), foot, low, middle, tip},
           {1.4 * radius, 1.3 * radius, 1.05 * radius, radius, 0.75 * radius},
           radius > 0.15 ? 14 : 9, bark);
}

/// Boughs of a winter tree above `fork`: thick ones are trunk no more, but vegetation.
void draw_boughs(Pen& pen, const Eigen::Vector3d& fork, double reach, double radius,
                 MaterialId wood, bool bare, core::Rng& rng) {
  const int count = bare ? 8 + rng.index(10) : 3 + rng.index(3);
  for (int i = 0; i < count; ++i) {
    const double turn = rng.uniform(0, kFullTurn);
    const double out = reach * rng.uniform(0.3, 1);
    const Eigen::Vector3d tip = fork + Eigen::Vector3d(out * std::cos(turn), out * std::sin(turn),
                                                       reach * rng.uniform(0.3, 1.4));
    const Eigen::Vector3d middle = fork + 0.5 * (tip - fork) - Eigen::Vector3d(0, 0, 0.05 * reach);
    pen.tube({fork, middle, tip}, {0.35 * radius, 0.2 * radius, 0.01}, 5, wood, false);
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d from = k < 2 ? middle : 0.5 * (middle + tip);
      const Eigen::Vector3d twig(rng.normal(0, 0.3), rng.normal(0, 0.3), rng.uniform(0, 0.5));
      pen.tube({from, from + reach * 0.5 * twig}, {0.015, 0.005}, 3, wood, false);
    }
  }
}

void crown(const Nursery& n, const Eigen::Vector3d& at, double radius, double height, const SE3& T,
           core::Rng& rng) {
  place(n.world, any_of(n.flora.crowns, rng), T * placed(at.x(), at.y(), at.z()),
        {radius, radius * rng.uniform(0.75, 1.25), height}, rng.uniform(0, kFullTurn));
}

/// Leaves or winter's boughs.
void top_off(const Nursery& n, Pen& pen, const Eigen::Vector3d& at, double radius, double size,
             bool bare, const SE3& T, core::Rng& rng) {
  const double reach = size * rng.uniform(1.2, 2.6);
  draw_boughs(pen, at, reach, radius, n.palette.stems, bare, rng);
  if (!bare) crown(n, at - Eigen::Vector3d(0, 0, 0.2), reach, 2 * reach, T, rng);
}

/// Radius at breast height of a tree of size 1: 0.12 to 0.72 m across, half of them below 0.3 m.
double any_stem(core::Rng& rng) { return 0.06 * std::pow(0.36 / 0.06, rng.uniform()); }

MaterialId any_bark(const Nursery& n, core::Rng& rng) {
  const double usual = n.world.materials[n.palette.bark].reflectivity;
  return any_tint(n.world, n.palette.bark, 0.5 * usual, 1.5 * usual, rng);
}

void add_single(const Nursery& n, double size, bool thick, const SE3& T, core::Rng& rng) {
  Pen pen(n.world.mesh, T);
  const double radius = thick ? rng.uniform(0.3, 0.7) : size * any_stem(rng);
  const double height = thick ? rng.uniform(2, 4) : rng.uniform(1.8, 4);
  const double lean = rng.chance(0.3) ? rng.uniform(0.1, 0.35) : rng.uniform(0, 0.06);
  const double turn = rng.uniform(0, kFullTurn);
  const Eigen::Vector3d tip(lean * height * std::cos(turn), lean * height * std::sin(turn), height);
  draw_stem(pen, {0, 0, 0}, tip, radius, any_bark(n, rng), rng);
  top_off(n, pen, tip, radius, thick ? 1.8 * size : size, rng.chance(n.bare_share), T, rng);
}

void add_forked(const Nursery& n, double size, const SE3& T, core::Rng& rng) {
  Pen pen(n.world.mesh, T);
  const MaterialId bark = any_bark(n, rng);
  const double radius = size * std::max(0.09, any_stem(rng));
  const double fork = rng.uniform(0.4, 1.6);
  draw_stem(pen, {0, 0, 0}, {0, 0, fork}, radius, bark, rng);
  const double turn = rng.uniform(0, kFullTurn);
  const bool bare = rng.chance(n.bare_share);
  for (const double side : {-1.0, 1.0}) {
    const double out = side * rng.uniform(0.3, 1.0);
    const Eigen::Vector3d tip(out * std::cos(turn), out * std::sin(turn),
                              fork + rng.uniform(1.2, 2.6));
    pen.tube({{0, 0, fork - 0.1}, 0.5 * (Eigen::Vector3d(0, 0, fork) + tip), tip},
             {0.8 * radius, 0.7 * radius, 0.55 * radius}, 10, bark, false);
    top_off(n, pen, tip, 0.6 * radius, size, bare, T, rng);
  }
}

void add_many_stems(const Nursery& n, double size, const SE3& T, core::Rng& rng) {
  Pen pen(n.world.mesh, T);
  const MaterialId bark = any_bark(n, rng);
  const int stems = 3 + rng.index(4);
  const double height = rng.uniform(2, 4);
  for (int i = 0; i < stems; ++i) {
    const double turn = kFullTurn * (i + rng.uniform(0, 0.6)) / stems;
    const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0);
    const Eigen::Vector3d tip = rng.uniform(0.3, 1.1) * out + Eigen::Vector3d(0, 0, height);
    draw_stem(pen, rng.uniform(0.05, 0.25) * out, tip, size * rng.uniform(0.03, 0.1), bark, rng);
  }
  top_off(n, pen, {0, 0, height - 0.4}, 0.12, 1.3 * size, rng.chance(n.bare_share), T, rng);
}

void add_pollarded(const Nursery& n, double size, const SE3& T, core::Rng& rng) {
  Pen pen(n.world.mesh, T);
  const double radius = size * std::max(0.12, any_stem(rng));
  const double height = rng.uniform(2, 3.5);
  const MaterialId bark = any_bark(n, rng);
  draw_stem(pen, {0, 0, 0}, {0, 0, height}, radius, bark, rng);
  const int fists = 3 + rng.index(4);
  for (int i = 0; i < fists; ++i) {
    const double turn = kFullTurn * i / fists;
    const Eigen::Vector3d at(0.7 * std::cos(turn), 0.7 * std::sin(turn),
                             height + rng.uniform(0, 0.6));
    pen.tube({{0, 0, height - 0.1}, at}, {0.6 * radius, 0.5 * radius}, 8, bark);
    for (int k = 0; k < 9; ++k) {
      const Eigen::Vector3d shoot(rng.normal(0, 0.3), rng.normal(0, 0.3), rng.uniform(0.5, 1.4));
      pen.tube({at, at + shoot}, {0.015, 0.005}, 3, n.palette.stems, false);
    }
  }
}

void add_staked(const Nursery& n, const SE3& T, core::Rng& rng) {
  Pen pen(n.world.mesh, T);
  const double height = rng.uniform(1.8, 2.6);
  draw_stem(pen, {0, 0, 0}, {0, 0, height}, rng.uniform(0.02, 0.05), any_bark(n, rng), rng);
  top_off(n, pen, {0, 0, height}, 0.04, 0.5, rng.chance(n.bare_share), T, rng);
  const int stakes = 1 + rng.index(3);
  for (int i = 0; i < stakes; ++i) {
    const double turn = kFullTurn * i / stakes;
    pen.at(0.3 * std::cos(turn), 0.3 * std::sin(turn), 0)
        .post(rng.uniform(0.025, 0.045), rng.uniform(1, 1.8), n.palette.timber, 7);
  }
  if (stakes == 3) pen.box({-0.3, -0.3, 0.9}, {0.3, 0.3, 0.96}, n.palette.timber);
}

void add_palm(const Nursery& n, double size, const SE3& T, core::Rng& rng) {
  Pen pen(n.world.mesh, T);
  const double height = rng.uniform(1.5, 9);
  const double lean = rng.normal(0, 0.06);
  const double r = size * rng.uniform(0.12, 0.25);
  const Eigen::Vector3d top(lean * height, 0, height);
  pen.tube({{0, 0, -0.3}, {0, 0, 0.3}, 0.5 * top, top}, {1.5 * r, 1.2 * r, r, 0.9 * r}, 12,
           any_bark(n, rng));
  const double reach = rng.uniform(1.2, 2.6);
  place(n.world, any_of(n.street.fronds, rng), T * placed(top.x(), top.y(), top.z()),
        {reach, reach, reach}, rng.uniform(0, kFullTurn));
}

void add_fallen(const Nursery& n, const SE3& T, core::Rng& rng) {
  Pen pen(n.world.mesh, T * placed(0, 0, 0, rng.uniform(0, kFullTurn)));
  const double length = rng.uniform(1.5, 5);
  const double radius = rng.uniform(0.04, 0.2);
  pen.tube({{0, 0, radius}, {length, 0, radius}}, {radius, 0.5 * radius}, 9, n.palette.stems);
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d at(length * rng.uniform(0.3, 1), 0, radius);
    const Eigen::Vector3d twig(rng.normal(0.3, 0.3), rng.normal(0, 0.6), rng.uniform(0, 0.6));
    pen.tube({at, at + twig}, {0.02, 0.006}, 4, n.palette.stems, false);
  }
}

}  // namespace

TreeHabit any_habit(core::Rng& rng) {
  using enum TreeHabit;
  constexpr TreeHabit kHabits[] = {single, single,  forked,  forked, many_stems, pollarded,
                                   staked, skirted, skirted, thick,  single,     palm};
  return kHabits[rng.index(12)];
}

double room_of(TreeHabit habit) {
  return habit == TreeHabit::skirted || habit == TreeHabit::thick ? 0.9 : 0.45;
}

void add_street_tree(const Nursery& n, TreeHabit habit, double size, const SE3& T, core::Rng& rng) {
  switch (habit) {
    case TreeHabit::single:
      return add_single(n, size, false, T, rng);
    case TreeHabit::thick:
      return add_single(n, size, true, T, rng);
    case TreeHabit::forked:
      return add_forked(n, size, T, rng);
    case TreeHabit::many_stems:
      return add_many_stems(n, size, T, rng);
    case TreeHabit::pollarded:
      return add_pollarded(n, size, T, rng);
    case TreeHabit::staked:
      return add_staked(n, T, rng);
    case TreeHabit::palm:
      return add_palm(n, size, T, rng);
    case TreeHabit::fallen:
      return add_fallen(n, T, rng);
    case TreeHabit::skirted: {
      const double radius = size * rng.uniform(0.7, 1.8);
      const double height = radius * rng.uniform(1.3, 4);
      place(n.world, any_of(n.street.skirted, rng), T, {radius, radius, height},
            rng.uniform(0, kFullTurn));
    }
  }
}

void add_clipped_hedge(const Nursery& n, const HedgeSize& size, const SE3& T_world_start,
                       core::Rng& rng) {
  const int blocks = std::max(1, static_cast<int>(size.length / std::max(1.0, size.height)));
  const double piece = size.length / blocks;
  const std::size_t alike = any_of(n.street.boxes, rng);
  for (int i = 0; i < blocks; ++i) {
    place(n.world, alike, T_world_start * placed((i + 0.5) * piece, 0, 0),
          {piece, size.depth, size.height * rng.uniform(0.98, 1.0)},
          rng.chance(0.5) ? 0 : std::numbers::pi);
  }
}

void add_car_sized_bush(const Nursery& n, const SE3& T, core::Rng& rng) {
  if (rng.chance(0.6)) {
    const HedgeSize size{rng.uniform(3, 6), rng.uniform(1.4, 2.2), rng.uniform(1, 1.8)};
    return add_clipped_hedge(n, size, T * placed(-size.length / 2, 0, 0), rng);
  }
  const double radius = rng.uniform(0.7, 1.1);
  const double stretch = rng.chance(0.5) ? 1 : rng.uniform(1.3, 2.6);
  place(n.world, any_of(n.street.rounds, rng), T, {radius * stretch, radius, rng.uniform(1, 1.9)},
        rng.normal(0, 0.1));
}

void add_any_bush(const Nursery& n, const SE3& T, double radius, double height, core::Rng& rng) {
  const auto& kind = rng.chance(0.5) ? n.street.twiggy : n.street.rounds;
  place(n.world, any_of(kind, rng), T, {radius, radius * rng.uniform(0.7, 1.3), height},
        rng.uniform(0, kFullTurn));
}

void add_tuft(const Nursery& n, const SE3& T, core::Rng& rng) {
  const double radius = rng.uniform(0.2, 0.9);
  place(n.world, any_of(n.street.tufts, rng), T, {radius, radius, rng.uniform(0.2, 1.1)},
        rng.uniform(0, kFullTurn));
}

void add_bed(const Nursery& n, const SE3& T, double length, double depth, core::Rng& rng) {
  const double height = rng.uniform(0.12, 0.6);
  for (double x = 0.5; x < length; x += 1) {
    place(n.world, any_of(n.street.beds, rng), T * placed(x - length / 2, 0, 0),
          {1, depth, height * rng.uniform(0.8, 1.2)}, 0);
  }
}

void add_ivy(const Nursery& n, const SE3& T, double length, double height, core::Rng& rng) {
  for (double x = 0.5; x < length; x += 1) {
    place(n.world, any_of(n.street.sheets, rng), T * placed(x, -0.02, 0),
          {1.1, 1, height * rng.uniform(0.5, 1.1)}, 0);
  }
}

void add_planter(const Nursery& n, const SE3& T, core::Rng& rng) {
  const double half = rng.uniform(0.3, rng.chance(0.3) ? 1.6 : 0.7);
  const double deep = rng.uniform(0.25, 0.5);
  const double high = rng.uniform(0.35, 0.9);
  const MaterialId side = any_tint(n.world, n.palette.timber, 0.1, 0.5, rng);
  Pen(n.world.mesh, T).box({-half, -deep, 0}, {half, deep, high}, side);
  const SE3 T_top = T * placed(0, 0, high - 0.02);
  if (rng.chance(0.4)) return add_bed(n, T_top, 2 * half, 2 * deep, rng);
  add_any_bush(n, T_top, std::min(half, 0.8), rng.uniform(0.4, 1.3), rng);
}

}  // namespace saker::simulation
