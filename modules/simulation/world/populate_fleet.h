#pragma once

#include "saker/simulation/world/populate.h"

namespace saker::simulation {

/// A theme that fits a kind of world.
[[nodiscard]] FleetTheme any_theme(WorldKind kind, core::Rng& rng);

// What the fleet of a training world does, by what the strip is used for. They stand in for the
// builders of populate.h where the population has a fleet.
void drive_fleet(Site& site, const Lot& lot);
void park_fleet_along(Site& site, const Lot& lot);
void park_fleet_across(Site& site, const Lot& lot);
/// One car in the drive before a house at s.
void park_in_drive(Site& site, const Lot& lot, double s);
/// People, two-wheelers, machines and stored vehicles, besides what the builders put there.
void add_street_life(Site& site, const Lot& lot);

}  // namespace saker::simulation
