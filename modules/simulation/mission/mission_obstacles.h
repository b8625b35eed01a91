#pragma once

#include "saker/simulation/mission/flight.h"

namespace saker::simulation {

/// Puts `count` posts, walls and hedges, in turn, between targets (indices into the world's truth),
/// each higher than one flies, with room to fly around it on either side. Posts enter the truth as
/// poles. Throws Error when the site has no room for that many.
void add_obstacles(FlightWorld& flight, const std::vector<std::size_t>& targets,
                   const Eigen::Vector3d& takeoff_sim, int count, core::Rng& rng);

}  // namespace saker::simulation
