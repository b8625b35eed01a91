#pragma once

#include "saker/simulation/world/plants.h"
#include "saker/simulation/world/street_palette.h"

namespace saker::simulation {

/// The plants that only training's streets hold, each drawn once and placed many times.
struct StreetFlora {
  std::vector<std::size_t> boxes;    ///< clipped: unit blocks as hedges are, sharper edges
  std::vector<std::size_t> rounds;   ///< clipped to a dome: unit radius, unit height
  std::vector<std::size_t> twiggy;   ///< bushes whose stems show between few leaves
  std::vector<std::size_t> sheets;   ///< ivy: x ±0.5, z 0 … 1 before y = 0
  std::vector<std::size_t> tufts;    ///< tall grass: unit radius, unit height
  std::vector<std::size_t> beds;     ///< flowers and ground cover: x, y ±0.5, unit height
  std::vector<std::size_t> fronds;   ///< a palm's head: unit radius, from z = −0.5
  std::vector<std::size_t> skirted;  ///< conifers with boughs to the ground
};

[[nodiscard]] StreetFlora grow_street_flora(World& world, const StreetPalette& palette,
                                            core::Rng& rng);

/// Adds to the world's own crowns and bushes: bare and sparse ones, ones that no beam passes.
void widen_flora(World& world, const StreetPalette& palette, Flora& flora, core::Rng& rng);

/// How a tree's wood stands.
enum class TreeHabit {
  single,
  forked,
  many_stems,
  pollarded,
  staked,
  palm,
  skirted,
  thick,
  fallen
};

/// What plants are drawn from.
struct Nursery {
  World& world;
  const StreetPalette& palette;
  const Flora& flora;
  const StreetFlora& street;
  double bare_share = 0.3;  ///< of the trees: without leaves
};

[[nodiscard]] TreeHabit any_habit(core::Rng& rng);

/// Radius of the ground that its wood takes.
[[nodiscard]] double room_of(TreeHabit habit);

/// A tree at the origin: stems are trunk, the crown vegetation. `size` about 1.
void add_street_tree(const Nursery& nursery, TreeHabit habit, double size,
                     const SE3& T_world_ground, core::Rng& rng);

/// A clipped hedge that begins at the origin and runs along x.
struct HedgeSize {
  double length = 4, depth = 1, height = 1.5;  ///< m
};
void add_clipped_hedge(const Nursery& nursery, const HedgeSize& size, const SE3& T_world_start,
                       core::Rng& rng);

/// A hedge or dome of a car's size, about the origin.
void add_car_sized_bush(const Nursery& nursery, const SE3& T_world_ground, core::Rng& rng);

/// A bush whose stems show, or a dome.
void add_any_bush(const Nursery& nursery, const SE3& T_world_ground, double radius, double height,
                  core::Rng& rng);

void add_tuft(const Nursery& nursery, const SE3& T_world_ground, core::Rng& rng);
void add_bed(const Nursery& nursery, const SE3& T_world_ground, double length, double depth,
             core::Rng& rng);
/// Ivy along x before a wall or fence at y = 0.
void add_ivy(const Nursery& nursery, const SE3& T_world_start, double length, double height,
             core::Rng& rng);
/// A box of wood, stone or metal with earth and plants in it.
void add_planter(const Nursery& nursery, const SE3& T_world_ground, core::Rng& rng);

}  // namespace saker::simulation
