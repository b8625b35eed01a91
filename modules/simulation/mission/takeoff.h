#pragma once

#include "saker/core/rng.h"
#include "saker/core/se3.h"
#include "saker/simulation/mission/mission_site.h"
#include "saker/simulation/vehicle/flight_controller.h"

namespace saker::simulation {

/// Where a robot of a team is to take off, in the frame `base`.
struct TakeoffPlace {
  double x_m = 0;
  double y_m = 0;
  double yaw_deg = 0;
  double within_m = 0;  ///< the nearest free place in this distance
};

/// Somewhere in the aisle, turned anyhow: the levelled frame of the body as it stands there.
/// Throws Error where there is no room.
[[nodiscard]] SE3 find_takeoff(const MissionSite& site, const AirframeConfig& airframe,
                               core::Rng& rng);

/// The same at, or near, a place. Throws Error where nothing within reach is free.
[[nodiscard]] SE3 takeoff_near(const MissionSite& site, const SE3& T_sim_base,
                               const TakeoffPlace& place, const AirframeConfig& airframe);

/// T_sim_base of a team: on the ground in the middle of the aisle, x along it, levelled.
[[nodiscard]] SE3 team_base(const MissionSite& site);

}  // namespace saker::simulation
