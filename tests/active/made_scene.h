#pragma once

#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "made_flight.h"
#include "made_street.h"
#include "saker/active/views/view_chooser.h"
#include "saker/active/views/viewpoint_sampler.h"

/// What a chooser of views is asked with, for tests.
namespace saker::active::made {

inline ViewpointSampler sampler(const InGeofence& in_geofence = everywhere) {
  return {ViewpointConfig(), FieldOfViewConfig(), in_geofence};
}

/// Targets in the order of the tour, a vehicle at the place of take-off.
struct Scene {
  Scene(const ViewChooser& chooser, const std::vector<objects::Cuboid>& cars)
      : targets({}, {}, map_of(cars)),
        states(cars.size(), TargetState({.refused_m = 3, .most_refusals = 3, .most_goals = 9})),
        records(cars.size(), chooser.unseen()),
        tour(cars.size()) {
    std::iota(tour.begin(), tour.end(), 0);
    fly(Eigen::Vector3d(0, 0, 3));
  }

  void have(objects::ObjectMap found) {
    map = std::move(found);
    targets.associate(*map);
  }
  void have(const std::vector<objects::Cuboid>& cars) { have(map_of(cars)); }

  void fly(const Eigen::Vector3d& place) {
    SE3 T = SE3::Identity();
    T.translation() = place;
    EXPECT_TRUE(vehicle.advance(vehicle.stamp() + kNanosecondsPerSecond, T));
  }

  /// In view from where the vehicle is, since the last decision.
  ViewOutcome see(const ViewChooser& chooser, int target) {
    records[target].history.add(vehicle.stamp(), vehicle.position(), targets[target].place(),
                                vehicle.elapsed_s(), vehicle.flown_m());
    return chooser.observe(*this, target, records[target]);
  }

  /// As the tour does.
  void fly_to(int target, const ViewChoice& choice) {
    expected = choice.expected;
    states[target].fly_to(choice.viewpoint, vehicle.position());
  }

  operator ViewScene() const {  // NOLINT(google-explicit-constructor): the scene that is meant
    return {vehicle,       map ? &*map : nullptr,
            block,         reachability,
            targets.all(), states,
            records,       tour,
            end,           expected};
  }

  TargetList targets;
  std::vector<TargetState> states;
  std::vector<ViewRecord> records;
  std::vector<int> tour;
  std::optional<Eigen::Vector3d> end;
  std::optional<Expectation> expected;
  std::optional<objects::ObjectMap> map;
  VehicleTrack vehicle;
  OccupancyView block;
  Reachability reachability;
};

inline const ViewpointCandidate* candidate_at(const ViewChoice& choice, int id) {
  for (const ViewpointCandidate& candidate : choice.candidates) {
    if (candidate.viewpoint.id == id) return &candidate;
  }
  return nullptr;
}

}  // namespace saker::active::made
