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

/// Takes it over on the way, and an operator who gives it back a while later.
class Pilot : public autonomy::MissionObserver {
 public:
  Pilot(MavlinkPlant& plant, autonomy::MissionLockstep& mission)
      : plant_(plant), mission_(mission) {}

  void on_setpoint(const Setpoint& setpoint, const VehicleOdometry& /*odometry*/) override {
    if (took_ == 0 && setpoint.velocity.norm() > kFast) {
      took_ = plant_.now();
      plant_.switch_mode(kLoiter);
    } else if (took_ != 0 && !resumed_ && plant_.now() > took_ + kSoon) {
      ++moved_;
    }
  }
  void on_scan(const autonomy::IngestedScan& /*scan*/) override {
    if (took_ == 0 || resumed_ || plant_.now() < took_ + kFlies) return;
    resumed_ = true;
    mission_.give({1, autonomy::OrderKind::resume});
  }
  void on_reply(const autonomy::OrderReply& reply) override { reply_ = reply; }

  [[nodiscard]] bool resumed() const { return resumed_; }
  /// Setpoints while it was the pilot's.
  [[nodiscard]] int moved() const { return moved_; }
  [[nodiscard]] const autonomy::OrderReply& reply() const { return reply_; }

 private:
  static constexpr double kFast = 0.5;
  static constexpr std::uint32_t kLoiter = 5;
  static constexpr Time kSoon = kNanosecondsPerSecond / 5, kFlies = 4 * kNanosecondsPerSecond;

  MavlinkPlant& plant_;
  autonomy::MissionLockstep& mission_;
  Time took_ = 0;
  bool resumed_ = false;
  int moved_ = 0;
  autonomy::OrderReply reply_;
};

TEST_P(MavlinkMission, APilotHasItUntilAnOperatorResumesAndThenTheMissionEndsWell) {
  autonomy::MissionLockstep mission(config_, vehicle_.sensor(), vehicle_.site().prior, plant_,
                                    checker_, 2, timings_);
  Pilot pilot(plant_, mission);
  const autonomy::MissionResult result = mission.run(200, pilot);
  EXPECT_TRUE(pilot.resumed());
  EXPECT_EQ(pilot.moved(), 0);
  EXPECT_EQ(pilot.reply().state, autonomy::OrderState::accepted) << pilot.reply().text;
  EXPECT_TRUE(result.succeeded) << to_string(result.outcome);
  EXPECT_FALSE(plant_.autopilot().armed());
  EXPECT_EQ(vehicle_.truth().collisions, 0);
}

INSTANTIATE_TEST_SUITE_P(Both, MavlinkMission,
                         ::testing::Values(Autopilot::ardupilot, Autopilot::px4),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

}  // namespace
}  // namespace saker::tools
