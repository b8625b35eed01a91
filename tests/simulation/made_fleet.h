#pragma once

#include <memory>

#include "drawn.h"
#include "saker/simulation/world/fleet.h"

namespace saker::simulation {

/// One member of the fleet about the origin.
struct Member : Sketch {
  Member(FleetKind kind, std::uint64_t seed) : Sketch(seed), shape(random_shape(kind, rng)) {
    constexpr std::size_t kPaintAndCover = 2;  // come before it, see make_parts()
    glass = static_cast<MaterialId>(world.materials.size() + kPaintAndCover);
    add_fleet_vehicle(world, palette, shape, SE3::Identity(), false, rng);
    caster = std::make_unique<RayCaster>(world);
  }

  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  [[nodiscard]] double front() const { return shape.length / 2; }
  [[nodiscard]] bool is_glass(const Shot& shot) const { return shot.hit && shot.material == glass; }
  /// Height of what is uppermost at x and y, beside the seam of both halves; NaN where nothing is.
  [[nodiscard]] double top_at(double x, double y = 0.03) const {
    const Shot down = shoot(*caster, {x, y, 9}, {0, 0, -1}, 8.99F);
    return down.hit ? place_of(down).z() : NAN;
  }
  /// Share of the beams across the vehicle at a height that meet it, over [from, to] in x.
  [[nodiscard]] double covered(double z, double from, double to) const {
    int met = 0, all = 0;
    for (double x = from; x < to; x += 0.05) {
      ++all;
      met += shoot(*caster, {x, 8, z}, {0, -1, 0}).hit;
    }
    return static_cast<double>(met) / all;
  }

  FleetShape shape;
  MaterialId glass = 0;
  std::unique_ptr<RayCaster> caster;
};

/// `check` on several members of each of the kinds.
template <class Kinds, class Check>
void for_each_member(const Kinds& kinds, Check check, std::uint64_t seeds = 6) {
  for (const FleetKind kind : kinds) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(std::string(entry_of(kind).name) + " " + std::to_string(seed));
      check(Member(kind, seed));
    }
  }
}

}  // namespace saker::simulation
