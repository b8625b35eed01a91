#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "made_flight.h"
#include "made_model.h"
#include "saker/active/views/pams_chooser.h"

namespace saker::active::made {

const objects::ClassTable kTable;
const std::vector<objects::Cuboid> kStreet = {car(20, 5), car(40, -4, 0.5), car(60, 6, 1.2),
                                              car(80, -8, 3)};

/// A tour by information gain, with a model that the test made.
inline TargetTour pams_tour(const PamsConfig& pams, TargetList targets,
                            const InGeofence& in_geofence, const ViewModel& model) {
  const ActiveConfig config;
  const ViewpointSampler sampler(config.viewpoints, config.view, in_geofence);
  auto chooser = std::make_unique<PamsChooser>(pams, config.visit_policy, sampler, model,
                                               motion::LimitsConfig{});
  return {config, std::move(targets), sampler, std::move(chooser)};
}

/// A flight over mapped cars with the made model.
struct PamsFlight : Flight {
  PamsFlight(const PamsConfig& pams, const std::vector<objects::Cuboid>& cars,
             const InGeofence& in_geofence = everywhere, const ViewModel& model = oblique_model())
      : Flight(pams_tour(pams, TargetList({}, kTable, map_of(cars)), in_geofence, model)) {
    map(cars);
  }
};

inline PamsConfig never_enough(PamsConfig config) {
  config.enough_entropy = -40;
  return config;
}

}  // namespace saker::active::made
