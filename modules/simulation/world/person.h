#pragma once

#include "saker/simulation/world/palette.h"

namespace saker::simulation {

enum class Posture { standing, walking, seated, riding, child };

/// What someone has with them.
enum class Belonging { none, pram, wheelchair, umbrella, suitcase, bag, rucksack };

/// Materials of one person and what they have, with the label of what they do.
struct Clothes {
  MaterialId coat, trousers, skin, gear;
};
[[nodiscard]] Clothes random_clothes(World& world, std::uint16_t label, core::Rng& rng);

/// Someone at the pen's origin, facing x. Who sits or rides has the hips at `seat` above it.
void draw_person(const Pen& pen, Posture posture, double height, double seat,
                 const Clothes& clothes, core::Rng& rng);

/// Someone of any age and size with anything or nothing, standing, walking or in a chair.
void add_passer_by(World& world, const SE3& T_world_ground, core::Rng& rng);

/// One to three people side by side on a low wall or block.
void add_sitters(World& world, const Palette& palette, const SE3& T_world_ground, core::Rng& rng);

}  // namespace saker::simulation
