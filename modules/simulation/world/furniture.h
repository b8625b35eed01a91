#pragma once

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

/// What stands in streets. Each is drawn at the origin of `T_world_ground`, upright, x along the
/// street; poles enter the world's truth.
void add_lamp(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_power_pole(World& world, const Palette& palette, const SE3& T_world_ground,
                    core::Rng& rng);
void add_traffic_light(World& world, const Palette& palette, const SE3& T_world_ground,
                       core::Rng& rng);
void add_sign(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_bollard(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_bin(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_bench(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_box(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_shelter(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_person(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_bicycle(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);
void add_container(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);

}  // namespace saker::simulation
