#pragma once

#include <limits>

#include "saker/simulation/mission/flight.h"

namespace saker::simulation {

inline constexpr double kBeyondSite = 12;  ///< m at either end, beyond what is populated

/// What stands where a mission is flown, before take-off and targets are chosen.
struct MissionSite {
  FlightWorld flight;
  double aisle_d = 0;  ///< m to the left of the middle line: where nobody parks, to take off from
  double ceiling_m = std::numeric_limits<double>::infinity();  ///< over the ground
};

/// A function of config and seed. Throws Error where the kind of site has not what is asked for.
[[nodiscard]] MissionSite build_mission_site(const MissionSiteConfig& config, std::uint64_t seed);

}  // namespace saker::simulation
