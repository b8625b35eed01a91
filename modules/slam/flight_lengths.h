#pragma once

#include <vector>

#include "core/budget.h"
#include "slam/graph.h"
#include "slam/merge_config.h"

namespace saker::slam {

/// Lengths of vehicles that several flights saw. What hides an end from one window of a flight
/// hides it from the next: however many windows a flight has, they share that error. So each
/// flight's length, by the graph's one-sided error over its own windows with the poses held,
/// counts once, and between flights a shorter one is a hidden end again.
/// Windows from afar do not count where any flight came near. The vehicle's two ends move as its
/// length does; all else stays.
void weigh_flights(std::vector<Landmark>& landmarks, Chains chains, const GraphConfig& graph,
                   const MergeConfig& config, const core::Budget& budget);

}  // namespace saker::slam
