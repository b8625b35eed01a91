#include <cmath>
#include <numbers>

#include "saker/simulation/world/populate_fleet.h"

namespace saker::simulation {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

/// Puts a vehicle with its middle at (s, d) if the place is free.
bool park(Site& site, double s, double d, double yaw, const VehicleShape& shape, bool moving) {
  if (!site.claim(s, d, yaw, shape.length / 2 + 0.12, shape.width / 2 + 0.18)) return false;
  add_vehicle(site.world, site.palette, shape, site.terrain.on_ground(s, d, yaw), moving, site.rng);
  return true;
}

VehicleShape next_shape(Site& site) { return random_shape(site.next_kind(), site.rng); }

/// Traffic keeps to the right: the right side drives along +s.
double driving_yaw(const Lot& lot) { return lot.side < 0 ? 0 : kHalfTurn; }

}  // namespace

void build_parallel_parking(Site& site, const Lot& lot) {
  if (site.population.fleet != FleetTheme::none) return park_fleet_along(site, lot);
  core::Rng& rng = site.rng;
  const double against = rng.uniform(0, 0.3);  // share that is parked against the traffic
  double s = lot.from;
  while (s < lot.to - 6) {
    const VehicleShape shape = next_shape(site);
    const double middle = s + shape.length / 2;
    if (rng.chance(site.population.parked)) {
      const double yaw =
          driving_yaw(lot) + (rng.chance(against) ? kHalfTurn : 0) + rng.normal(0, 0.025);
      park(site, middle, lot.at(0.5) + rng.normal(0, 0.08), yaw, shape, false);
    }
    s += shape.length + rng.uniform(0.5, 1.6);
  }
}

void build_perpendicular_parking(Site& site, const Lot& lot) {
  if (site.population.fleet != FleetTheme::none) return park_fleet_across(site, lot);
  core::Rng& rng = site.rng;
  const double slot = rng.uniform(2.45, 2.8);
  const double skew = rng.chance(0.25) ? rng.uniform(-0.5, 0.5) : 0;
  for (double s = lot.from; s < lot.to - 3; s += slot / std::cos(skew)) {
    if (!rng.chance(site.population.parked)) continue;
    VehicleShape shape = next_shape(site);
    if (shape.length > 6) continue;
    const bool nose_in = rng.chance(0.7);
    const double yaw =
        (lot.side > 0 ? 1 : -1) * (nose_in ? 1 : -1) * (kHalfTurn / 2 - skew) + rng.normal(0, 0.03);
    park(site, s, lot.at(0.5) + rng.normal(0, 0.15), yaw, shape, false);
  }
}

void build_lane(Site& site, const Lot& lot) {
  if (site.population.fleet != FleetTheme::none) return drive_fleet(site, lot);
  core::Rng& rng = site.rng;
  for (double s = lot.from; s < lot.to; s += 12) {
    if (!rng.chance(site.population.traffic)) continue;
    const VehicleShape shape = next_shape(site);
    const double middle = s + rng.uniform(0, 6);
    const double d = lot.at(0.5) + rng.normal(0, 0.15);
    park(site, middle, d, driving_yaw(lot) + rng.normal(0, 0.03), shape, true);
  }
}

}  // namespace saker::simulation
