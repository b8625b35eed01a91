#include <gtest/gtest.h>

#include "mavlink_plant.h"
#include "saker/autonomy/local_checker.h"
#include "saker/autonomy/mission_lockstep.h"

/// Whole missions through the bridge, on simulated time: the autonomy, bytes of MAVLink, an
/// autopilot's behaviour and the simulated vehicle. mavlink_flight_test.py does it by processes.
namespace saker::tools {
namespace {

using autonomy::Cause;

class MavlinkMission : public ::testing::TestWithParam<Autopilot> {
 protected:
  MavlinkMission()
      : quirks_(quirks_of(GetParam(), false)),
        vehicle_(scenario(quirks_), 1),
        plant_(vehicle_, quirks_),
        checker_(config_.local_checker, config_.collision_checker, config_.motion.clearance) {
    const simulation::MissionFence& fence = vehicle_.site().fence;
    config_.active.policy = active::PolicyName::visit;
    config_.motion.geofence = {fence.lowest_m, fence.highest_m, fence.polygon_m};
    config_.mission.command.deadline_s = 60;
    config_.mission.column_free = true;
  }

  static simulation::MissionConfig scenario(const Quirks& quirks) {
    simulation::MissionConfig config;
    config.capture.rows = 32;
    config.capture.columns = 512;
    config.site.targets = 1;
    put_behind(quirks, config);
    return config;
  }

  Quirks quirks_;
  autonomy::Config config_;
  core::Timings timings_;
  simulation::SimulatedVehicle vehicle_;
  MavlinkPlant plant_;
  autonomy::LocalChecker checker_;
};

TEST_P(MavlinkMission, ArmsTakesOffGoesToItsTargetReturnsAndLands) {
  autonomy::MissionLockstep mission(config_, vehicle_.sensor(), vehicle_.site().prior, plant_,
                                    checker_, 2, timings_);
  autonomy::MissionObserver nobody;
  const autonomy::MissionResult result = mission.run(180, nobody);
  std::string story;
  for (const autonomy::MissionEvent& event : result.events)
    story += std::to_string(to_seconds(event.stamp)) + " " + to_string(event.to) + ": " +
             event.text + "\n";
  EXPECT_TRUE(result.succeeded) << story;
  EXPECT_EQ(result.phase, autonomy::MissionPhase::done) << story;
  EXPECT_FALSE(plant_.autopilot().armed()) << story;
  EXPECT_EQ(vehicle_.truth().collisions, 0);
  EXPECT_GT(vehicle_.truth().path_m, 10);
  EXPECT_EQ(plant_.autopilot().cancelled(), 0);
  EXPECT_EQ(plant_.bridge().counters().losses, 0) << plant_.bridge().cause();
  EXPECT_EQ(plant_.bridge().counters().not_finite, 0);
  EXPECT_EQ(plant_.modes().back(), quirks_.dialect.land.custom);
  EXPECT_EQ(std::count(plant_.modes().begin(), plant_.modes().end(), quirks_.dialect.guided.custom),
            1);
}

INSTANTIATE_TEST_SUITE_P(Both, MavlinkMission,
                         ::testing::Values(Autopilot::ardupilot, Autopilot::px4),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

}  // namespace
}  // namespace saker::tools
