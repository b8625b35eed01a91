#include "saker/autonomy/mission_lockstep.h"

#include <gtest/gtest.h>

#include "saker/autonomy/local_checker.h"
#include "saker/core/error.h"
#include "saker/objects/map_io.h"
#include "tools/plant/simulated_plant.h"

namespace saker::autonomy {
namespace {

/// A mission over a small car park, sensor of 32 × 512.
class SmallMission {
 public:
  explicit SmallMission(int threads, std::vector<simulation::ScenarioEvent> events = {})
      : vehicle_(scenario(std::move(events)), 1),
        plant_(vehicle_),
        checker_(config_.local_checker, config_.collision_checker, config_.motion.clearance) {
    const simulation::MissionFence& fence = vehicle_.site().fence;
    config_.active.policy = active::PolicyName::visit;
    config_.motion.geofence = {fence.lowest_m, fence.highest_m, fence.polygon_m};
    mission_ = std::make_unique<MissionLockstep>(config_, vehicle_.sensor(), vehicle_.site().prior,
                                                 plant_, checker_, threads, timings_);
  }

  MissionResult fly(double seconds) {
    MissionObserver nobody;
    return mission_->run(seconds, nobody);
  }
  [[nodiscard]] simulation::VehicleTruth truth() const { return vehicle_.truth(); }

  static simulation::MissionConfig scenario(std::vector<simulation::ScenarioEvent> events) {
    simulation::MissionConfig config;
    config.capture.rows = 32;
    config.capture.columns = 512;
    config.site.targets = 2;
    config.events = std::move(events);
    return config;
  }

 private:
  Config config_;
  core::Timings timings_;
  simulation::SimulatedVehicle vehicle_;
  tools::SimulatedPlant plant_;
  LocalChecker checker_;
  std::unique_ptr<MissionLockstep> mission_;
};

bool said(const MissionResult& result, Cause cause) {
  return std::any_of(result.events.begin(), result.events.end(),
                     [cause](const MissionEvent& event) { return event.cause == cause; });
}

TEST(MissionLockstep, IsTheSameToTheByteForAnyNumberOfThreads) {
  const MissionResult one = SmallMission(1).fly(12), two = SmallMission(2).fly(12);
  const objects::ClassTable table;
  EXPECT_EQ(objects::to_smap(one.map, table), objects::to_smap(two.map, table));
  ASSERT_EQ(one.scans.size(), two.scans.size());
  ASSERT_GT(one.scans.size(), 50u);
  for (std::size_t i = 0; i < one.scans.size(); ++i) {
    ASSERT_EQ(one.T_world_lidar[i].matrix(), two.T_world_lidar[i].matrix());
  }
  ASSERT_EQ(one.events.size(), two.events.size());
  EXPECT_TRUE(said(one, Cause::took_off));
}

simulation::ScenarioEvent event(simulation::ScenarioEventKind kind, double at_s) {
  simulation::ScenarioEvent event;
  event.kind = kind;
  event.at_s = at_s;
  return event;
}

TEST(MissionLockstep, ComesDownWithItsCauseWhenTheLidarStops) {
  SmallMission mission(2, {event(simulation::ScenarioEventKind::lidar_stop, 5)});
  const MissionResult result = mission.fly(60);
  EXPECT_EQ(result.phase, MissionPhase::done);
  EXPECT_TRUE(said(result, Cause::lidar_silent) || said(result, Cause::odometry_stale));
  EXPECT_FALSE(result.succeeded);
  EXPECT_EQ(mission.truth().collisions, 0);
}

TEST(MissionLockstep, RefusesALatencyThatNoProposalSurvives) {
  const simulation::MissionConfig scenario = SmallMission::scenario({});
  simulation::SimulatedVehicle vehicle(scenario, 1);
  tools::SimulatedPlant plant(vehicle);
  Config config;
  config.latency.planning_s = config.planning.horizon_s;
  LocalChecker checker(config.local_checker, config.collision_checker, config.motion.clearance);
  core::Timings timings;
  EXPECT_THROW(
      MissionLockstep(config, vehicle.sensor(), vehicle.site().prior, plant, checker, 1, timings),
      Error);
}

}  // namespace
}  // namespace saker::autonomy
