#pragma once

#include <optional>

#include "saker/objects/object_map.h"
#include "saker/simulation/mission/flight.h"
#include "saker/simulation/mission/mission_config.h"
#include "saker/simulation/mission/takeoff.h"

namespace saker::simulation {

/// Where the vehicle may fly: a box, as the geofence's polygon and heights.
struct MissionFence {
  std::vector<double> polygon_m;  ///< corners x1, y1, x2, y2, …
  double lowest_m = NAN;          ///< of the body's centre over the take-off point
  double highest_m = NAN;
};

/// A street, a garage or a dirt road, a free place to take off from in an aisle or on the road, and
/// what is said beforehand of the targets. `world` is the levelled frame of the body where it
/// stands. `base` is a team's frame, in the middle of the aisle with x along it; for a vehicle
/// alone it is `world`.
struct MissionWorld {
  FlightWorld flight;
  SE3 T_sim_base = SE3::Identity();
  SE3 T_sim_world = SE3::Identity();
  std::vector<int> targets;           ///< ids, in the truth, of the vehicles that are to be mapped
  objects::ObjectMap prior;           ///< in `base`: the targets, roughly; ids as in the truth
  std::vector<std::size_t> inserted;  ///< movers that events bring in, under the ground till then
  MissionFence fence;                 ///< in `base`

  [[nodiscard]] const World& world() const { return flight.built.world; }
};

/// Corners of a box about the targets and the origin, wide enough to fly around the outer ones.
[[nodiscard]] std::vector<double> fence_polygon(const objects::ObjectMap& prior,
                                                const MissionSiteConfig& site);

/// What is said of the site beforehand is wrong as far as the configuration says so, or empty.
/// A function of config and seed; \param place where a robot of a team takes off, in the same world
/// whichever of them. Throws Error where the site has no room for what is asked.
[[nodiscard]] MissionWorld build_mission_world(const MissionConfig& config, std::uint64_t seed,
                                               const std::optional<TakeoffPlace>& place = {});

/// Vehicles on their way, `t` seconds after the start: up and down the street again and again.
void drive(const FlightWorld& flight, double t, RayCaster& caster);

}  // namespace saker::simulation
