#include "saker/simulation/vehicle/simulated_vehicle.h"

#include <gtest/gtest.h>

#include <memory>

#include "pilot.h"
#include "saker/core/error.h"
#include "saker/lidar/ouster_stream.h"
#include "saker/lidar/sensor_gate.h"

namespace saker::simulation {
namespace {

MissionConfig small_sensor() {
  MissionConfig config;
  config.capture.rows = 16;
  config.capture.columns = 512;
  return config;
}

TEST(SimulatedVehicle, PacketsDecodeToScansWithTheirStampsAndSamples) {
  SimulatedVehicle vehicle(small_sensor(), 1);
  lidar::OusterStream stream(vehicle.sensor());
  const Time start = vehicle.now();
  int scans = 0;
  std::vector<ScanTruth> truth;
  Time last = 0;
  for (int i = 1; i <= 100; ++i) {
    vehicle.step_to(start + i * from_seconds(0.01));
    for (const ScanTruth& scan : vehicle.take_scan_truth()) truth.push_back(scan);
    for (const SensorDatagram& datagram : vehicle.take_packets()) {
      EXPECT_GE(datagram.received, last);
      EXPECT_LE(datagram.received, vehicle.now());
      last = datagram.received;
      stream.add(datagram.payload);
    }
    while (const auto item = stream.take()) {
      EXPECT_EQ(item->frame.fault, "");
      EXPECT_EQ(item->frame.scan.stamp, truth.at(static_cast<std::size_t>(scans)).stamp);
      EXPECT_NEAR(static_cast<double>(item->frame.imu.size()), 10, 1);
      EXPECT_EQ(item->assembled.valid_columns, 512);
      ++scans;
    }
  }
  EXPECT_EQ(scans, 9);
  EXPECT_EQ(stream.counters().summary(), "");
}

/// In lockstep the gate refuses nothing of the simulated sensor, and changes no stamp.
TEST(SimulatedVehicle, ItsPacketsPassTheGateAsTheyAre) {
  MissionConfig config = small_sensor();
  config.capture.lost_share = config.capture.late_share = config.capture.repeated_share = 0.05;
  SimulatedVehicle vehicle(config, 1);
  lidar::SensorGate gate(vehicle.sensor(), {.address = {}, .offset = Time{0}});
  const Time start = vehicle.now();
  for (int i = 1; i <= 1000; ++i) {
    vehicle.step_to(start + i * from_seconds(0.01));
    for (const SensorDatagram& datagram : vehicle.take_packets()) {
      const auto verdict = gate.judge(datagram.payload, {}, datagram.received);
      ASSERT_EQ(verdict.cause, lidar::GateCause::none) << to_string(verdict.cause);
      ASSERT_EQ(verdict.correction, 0);
    }
  }
  EXPECT_GT(gate.figures().passed, 3000);
}

/// Points on the ground lie on the plane under the standing vehicle.
TEST(SimulatedVehicle, AStandingVehicleSeesTheGroundAtItsFeet) {
  SimulatedVehicle vehicle(small_sensor(), 2);
  lidar::OusterStream stream(vehicle.sensor());
  vehicle.step_to(vehicle.now() + from_seconds(0.25));
  for (const SensorDatagram& datagram : vehicle.take_packets()) stream.add(datagram.payload);
  const auto item = stream.take();
  ASSERT_TRUE(item.has_value());
  const MissionConfig config = small_sensor();
  const double height = config.airframe.leg_m + config.mount.position_m[2];
  int near = 0, on_ground = 0;
  for (const Eigen::Vector3f& p : item->frame.scan.points) {
    if (!p.allFinite() || p.norm() > 2 || p.z() > -0.1) continue;
    ++near;
    on_ground += std::abs(p.z() + height) < 0.08;
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(on_ground, 0.95 * near);
}

TEST(SimulatedVehicle, ItFliesToWhereItIsTold) {
  Pilot pilot(small_sensor(), 3);
  ASSERT_TRUE(pilot.take_off(3));
  pilot.guide({0, 0, 3}, 4);
  EXPECT_LT((pilot.vehicle.truth().T_world_body.translation() - Eigen::Vector3d(0, 0, 3)).norm(),
            0.3);
  EXPECT_EQ(pilot.vehicle.truth().collisions, 0);
  EXPECT_GT(pilot.vehicle.truth().min_clearance_m, 0.5);
  EXPECT_NEAR(pilot.vehicle.truth().path_m, 3, 1.5);
}

TEST(SimulatedVehicle, FlownIntoAParkedVehicleItCountsACollision) {
  Pilot pilot(small_sensor(), 3);
  const Eigen::Vector3d target = objects::place(pilot.vehicle.true_map().objects.front().model);
  Eigen::Vector3d nearest = target;
  for (const objects::MapObject& object : pilot.vehicle.true_map().objects) {
    const Eigen::Vector3d p = objects::place(object.model);
    if (std::holds_alternative<objects::Cuboid>(object.model) && p.norm() < nearest.norm())
      nearest = p;
  }
  ASSERT_TRUE(pilot.take_off(1.2));
  nearest.z() += 0.3;
  pilot.fly_to(nearest, 1.5);
  EXPECT_GE(pilot.vehicle.truth().collisions, 1);
  EXPECT_LE(pilot.vehicle.truth().min_clearance_m, 0);
  EXPECT_EQ(pilot.vehicle.truth().nearest_label, kCar);
  EXPECT_FALSE(pilot.vehicle_state.faults & kCollision) << "the truth, which it cannot know";
}

TEST(SimulatedVehicle, TwoRunsCutIntoOtherStepsAreByteIdentical) {
  MissionConfig config = small_sensor();
  config.capture.lost_share = config.capture.late_share = config.capture.repeated_share = 0.05;
  const auto flown = [&](double step) {
    SimulatedVehicle vehicle(config, 4);
    std::vector<std::uint8_t> bytes;
    const Time end = vehicle.now() + from_seconds(0.6);
    while (vehicle.now() < end) {
      vehicle.step_to(std::min(end, vehicle.now() + from_seconds(step)));
      for (const SensorDatagram& d : vehicle.take_packets())
        bytes.insert(bytes.end(), d.payload.begin(), d.payload.end());
    }
    return bytes;
  };
  const auto bytes = flown(0.002);
  EXPECT_GT(bytes.size(), 100000U);
  EXPECT_TRUE(bytes == flown(0.05));
}

MissionConfig with_event(ScenarioEvent event) {
  MissionConfig config = small_sensor();
  config.events.push_back(event);
  return config;
}

TEST(SimulatedVehicle, AnInsertedObstacleIsSeenAndTouchedWhereItWasPut) {
  ScenarioEvent wall;
  wall.at_s = 6;
  wall.ahead_m = 2;
  Pilot pilot(with_event(wall), 5);
  ASSERT_TRUE(pilot.take_off(2));
  pilot.guide({0, 0, 2}, 0.1);
  const double before = pilot.vehicle.truth().min_clearance_m;
  EXPECT_GT(before, 1.3);
  pilot.guide({0, 0, 2}, 6);
  const VehicleTruth truth = pilot.vehicle.truth();
  EXPECT_LT(truth.min_clearance_m, 2 - 0.15 - 0.4 + 0.3);
  EXPECT_EQ(truth.nearest_label, kOtherStructure);
}

TEST(SimulatedVehicle, AGustIsFlownThroughWithinAMetre) {
  ScenarioEvent gust;
  gust.kind = ScenarioEventKind::gust;
  gust.at_s = 6;
  gust.gust_mps = 6;
  MissionConfig config = with_event(gust);
  config.wind.mean_mps = config.wind.gust_mps = 0;
  Pilot pilot(config, 9);
  ASSERT_TRUE(pilot.take_off(3));
  const Eigen::Vector3d place(0, 0, 3);
  double before = 0, worst = 0;
  for (int i = 0; i < 200; ++i) {
    pilot.guide(place, 0.02);
    const VehicleTruth truth = pilot.vehicle.truth();
    const double off = (truth.T_world_body.translation() - place).norm();
    (truth.flight_time_s < 5.9 ? before : worst) =
        std::max(truth.flight_time_s < 5.9 ? before : worst, off);
  }
  EXPECT_LT(before, 0.25);
  EXPECT_GT(worst, 0.1);
  EXPECT_LT(worst, 1.0);
}

TEST(SimulatedVehicle, TruthCountsTheReturnsOfEachObject) {
  SimulatedVehicle vehicle(small_sensor(), 11);
  vehicle.step_to(vehicle.now() + from_seconds(0.5));
  int hit = 0;
  for (const objects::MapObject& object : vehicle.true_map().objects) hit += object.points > 20;
  EXPECT_GT(hit, 2);
}

TEST(SimulatedVehicle, AStoppedLidarSendsNothing) {
  ScenarioEvent stop;
  stop.kind = ScenarioEventKind::lidar_stop;
  stop.at_s = 1;
  Pilot pilot(with_event(stop), 6);
  ASSERT_TRUE(pilot.take_off(2));
  (void)pilot.vehicle.take_packets();
  pilot.guide({0, 0, 2}, 1);
  EXPECT_TRUE(pilot.vehicle.take_packets().empty());
}

TEST(SimulatedVehicle, AnEventWaitsUntilItFliesSoFast) {
  ScenarioEvent stop;
  stop.kind = ScenarioEventKind::lidar_stop;
  stop.at_s = 0;
  stop.from_speed_mps = 0.5;
  Pilot pilot(with_event(stop), 6);
  ASSERT_TRUE(pilot.take_off(2));
  EXPECT_EQ(pilot.vehicle.truth().events_begun, 0);
  pilot.fly_to({3, 0, 2}, 1.5, 4);
  EXPECT_EQ(pilot.vehicle.truth().events_begun, 1);
}

TEST(SimulatedVehicle, WithoutOdometryItDescendsAndWithFrozenOdometryToo) {
  for (const auto kind : {ScenarioEventKind::odometry_stop, ScenarioEventKind::odometry_freeze}) {
    ScenarioEvent event;
    event.kind = kind;
    event.at_s = 5;
    Pilot pilot(with_event(event), 7);
    ASSERT_TRUE(pilot.take_off(2.5));
    pilot.fly_to({3, 0, 2.5}, 1.5, 4);
    EXPECT_EQ(pilot.vehicle_state.mode, VehicleMode::descend);
  }
}

TEST(SimulatedVehicle, BeyondTheWorldsEdgeItLandsOnAPlain) {
  Pilot pilot(small_sensor(), 3);
  ASSERT_TRUE(pilot.take_off(3));
  pilot.fly_to({0, 0, 20}, 4);
  pilot.fly_to({0, 150, 20}, 8);
  ASSERT_TRUE(pilot.command(CommandKind::land));
  pilot.run(50);
  EXPECT_EQ(pilot.vehicle_state.mode, VehicleMode::idle);
  EXPECT_FALSE(pilot.vehicle.truth().airborne);
  EXPECT_NEAR(pilot.vehicle.truth().T_world_body.translation().y(), 150, 5);
}

TEST(SimulatedVehicle, AnEmptyBatteryEndsTheFlight) {
  MissionConfig config = small_sensor();
  config.battery.capacity_wh = 1.2;
  Pilot pilot(config, 8);
  ASSERT_TRUE(pilot.take_off(2));
  pilot.guide({0, 0, 2}, 15);
  EXPECT_FALSE(pilot.vehicle_state.armed);
  EXPECT_FALSE(pilot.vehicle.truth().airborne);
}

TEST(SimulatedVehicle, AnInertialUnitThatDoesNotFitTheStepIsRefusedByName) {
  MissionConfig config = small_sensor();
  config.imu.rate_hz = 300;
  try {
    SimulatedVehicle vehicle(config, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("mission.imu.rate_hz"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::simulation
