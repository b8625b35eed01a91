#pragma once

#include "saker/objects/object_map.h"
#include "saker/simulation/mission/mission_world.h"

namespace saker::simulation {

/// What somebody who surveyed the site badly says of it: leaves targets out, names some twice,
/// takes trees and poles for vehicles, and adds vehicles where none is, inside the fence. \param
/// prior  the targets' rough places, `world` \return ids of targets as in `prior`; the others'
/// follow those of the world's objects. Throws Error where the world has too few trees and poles,
/// or no room, for what is asked.
[[nodiscard]] objects::ObjectMap with_errors(const objects::ObjectMap& prior, const World& world,
                                             const SE3& T_world_sim, const MissionFence& fence,
                                             const MissionSiteConfig& site, core::Rng& rng);

}  // namespace saker::simulation
