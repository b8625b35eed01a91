#pragma once

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

enum class TwoWheeler { motorcycle, scooter, bicycle, cargo_bicycle };

/// Puts one on the ground, its middle at the origin, x to its front: with someone on it, or leaning
/// on its stand. Who rides has SemanticKITTI's label of a rider.
void add_two_wheeler(World& world, const Palette& palette, TwoWheeler kind,
                     const SE3& T_world_ground, bool ridden, core::Rng& rng);

/// A hoop or comb that bicycles lean on, across x.
void add_bicycle_stand(World& world, const Palette& palette, const SE3& T_world_ground,
                       core::Rng& rng);

}  // namespace saker::simulation
