#pragma once

#include <memory>
#include <vector>

#include "made_flight.h"
#include "made_model.h"
#include "saker/active/pams.h"

namespace saker::active::made {

const objects::ClassTable kTable;
const std::vector<objects::Cuboid> kStreet = {car(20, 5), car(40, -4, 0.5), car(60, 6, 1.2),
                                              car(80, -8, 3)};

/// A flight over mapped cars with the made model.
struct PamsFlight : Flight {
  PamsFlight(const PamsConfig& pams, const std::vector<objects::Cuboid>& cars,
             const InGeofence& in_geofence = everywhere, const ViewModel& model = oblique_model())
      : Flight(policy_for(pams, cars, in_geofence, model)) {
    map(cars);
  }

  static std::unique_ptr<Policy> policy_for(const PamsConfig& pams,
                                            const std::vector<objects::Cuboid>& cars,
                                            const InGeofence& in_geofence, const ViewModel& model) {
    const ActiveConfig config;
    return std::make_unique<PamsPolicy>(config, pams,
                                        TargetList(config.targets, kTable, map_of(cars)),
                                        in_geofence, model, motion::LimitsConfig{});
  }
};

inline PamsConfig never_enough(PamsConfig config) {
  config.enough_entropy = -40;
  return config;
}

}  // namespace saker::active::made
