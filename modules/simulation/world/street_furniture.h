#pragma once

#include "saker/simulation/world/street_palette.h"

namespace saker::simulation {

/// What stands in training's streets, each about the origin, upright, x along the street, its back
/// to +y. Labels: other object, but shelters, scaffolds, gantries' feet: other structure; signs'
/// plates: traffic sign.
struct Furnishing {
  StreetAdder add;
  double half_length, half_width;  ///< m of ground that it takes
};

/// Things of less than about a metre: bins, hydrants, cones, meters, boxes.
[[nodiscard]] Furnishing any_small_thing(core::Rng& rng);
/// Things of one to three metres: benches, cabinets, kiosks, tables, pallets.
[[nodiscard]] Furnishing any_middling_thing(core::Rng& rng);
/// Things of a car's size and larger: containers, skips, igloos in a row, tents, piles, stalls.
[[nodiscard]] Furnishing any_car_sized_thing(core::Rng& rng);

/// Bollards or cones in a row along x from the origin.
void add_bollard_row(World& world, const StreetPalette& palette, const SE3& T_world_start,
                     core::Rng& rng);
/// Wheelie bins side by side.
void add_wheelie_bins(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                      core::Rng& rng);
/// Poles and planks before a front that runs along x, to y < 0.
void add_scaffold(World& world, const StreetPalette& palette, const SE3& T_world_start,
                  double length, double height);

// Poles: shafts and arms are pole, plates sign.
void add_armed_lamp(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                    core::Rng& rng);
void add_boxed_pole(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                    core::Rng& rng);
/// A traffic light whose mast reaches over the lane, to y < 0.
void add_mast_light(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                    core::Rng& rng);
void add_catenary_pole(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                       core::Rng& rng);
void add_cross_arm_pole(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                        core::Rng& rng);
void add_plain_pole(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                    core::Rng& rng);
void add_big_sign(World& world, const StreetPalette& palette, const SE3& T_world_ground,
                  core::Rng& rng);
/// Signs over the road on a beam between two feet `width` apart, along +y from the origin.
void add_gantry(World& world, const StreetPalette& palette, const SE3& T_world_ground, double width,
                core::Rng& rng);

[[nodiscard]] StreetAdder any_pole(core::Rng& rng);

}  // namespace saker::simulation
