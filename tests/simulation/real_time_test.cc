#include "tools/sim/real_time.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "flight/bus/messages.h"
#include "paths.h"
#include "saker/core/config_io.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/ouster_stream.h"
#include "saker/lidar/udp_receiver.h"
#include "saker/objects/map_io.h"
#include "saker/simulation/mission/scenario.h"

namespace saker::tools {
namespace {

simulation::MissionConfig small_sensor() {
  simulation::MissionConfig config;
  config.capture.rows = 16;
  config.capture.columns = 512;
  return config;
}

std::filesystem::path empty_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// A simulator on a network of its own.
struct Running {
  explicit Running(const std::string& name, double factor = 1)
      : out(empty_folder(name)),
        config(small_sensor()),
        vehicle(config, 3),
        lidar(0),
        imu(0),
        bus(flight::Bus::in_memory("R1")),
        presence(bus, "saker-sim"),
        real_time(vehicle, bus, presence, {factor, lidar.port(), imu.port()}),
        recorder(out, config, vehicle, vehicle.sensor()) {}

  SimRecorder::Run run_for(double simulated_s) {
    const Time end = vehicle.now() + from_seconds(simulated_s);
    const auto run = real_time.run(recorder, [&] { return vehicle.now() >= end; });
    recorder.finish(vehicle, run);
    return run;
  }

  std::filesystem::path out;
  simulation::MissionConfig config;
  simulation::SimulatedVehicle vehicle;
  lidar::UdpReceiver lidar, imu;
  flight::Bus bus;
  flight::Presence presence;
  RealTime real_time;
  SimRecorder recorder;
};

TEST(RealTime, PacketsArriveOverUdpAndDecodeToWholeScans) {
  Running sim("sim_packets");
  lidar::OusterStream stream(sim.vehicle.sensor());
  sim.run_for(0.55);
  for (auto p = sim.lidar.receive(std::chrono::milliseconds(0)); !p.empty();
       p = sim.lidar.receive(std::chrono::milliseconds(0)))
    stream.add(p);
  int scans = 0;
  while (const auto item = stream.take()) {
    EXPECT_EQ(item->assembled.valid_columns, 512);
    ++scans;
  }
  EXPECT_EQ(scans, 5);
  int samples = 0;
  while (!sim.imu.receive(std::chrono::milliseconds(0)).empty()) ++samples;
  EXPECT_NEAR(samples, 55, 3);
}

TEST(RealTime, StatesGoOutAt50HzAndCommandsAreAnswered) {
  Running sim("sim_states");
  int states = 0;
  std::vector<CommandAck> acks;
  sim.bus.subscribe<vehicle_state_t>([&](const vehicle_state_t& message) {
    if (states++ == 5) sim.bus.publish(flight::to_lcm(Command{0, 7, CommandKind::arm, NAN}));
    return flight::from_lcm(message).has_value();
  });
  sim.bus.subscribe<command_ack_t>([&](const command_ack_t& message) {
    acks.push_back(*flight::from_lcm(message));
    return true;
  });
  sim.run_for(1.0);
  EXPECT_NEAR(states, 50, 3);
  ASSERT_EQ(acks.size(), 1U);
  EXPECT_EQ(acks[0].id, 7);
  EXPECT_EQ(acks[0].reason, "no odometry");
}

TEST(RealTime, TheFactorScalesTime) {
  Running sim("sim_factor", 4);
  const SimRecorder::Run run = sim.run_for(2);
  EXPECT_NEAR(run.wall_s - run.behind_s, 0.5, 0.15);
}

TEST(SimRecorder, LeavesWhatTheExecutiveNeedsAndWhatWasTrue) {
  Running sim("sim_files");
  sim.run_for(0.35);
  EXPECT_EQ(lidar::read_metadata(sim.out / "metadata.json").columns, 512);
  EXPECT_EQ(objects::read_map(sim.out / "prior.json", {}).objects.size(), 8U);
  EXPECT_GT(objects::read_map(sim.out / "truth.json", {}).objects.size(), 8U);
  const std::string rows = core::read_file(sim.out / "trajectory_truth.txt");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 3);
  const auto figures = nlohmann::json::parse(core::read_file(sim.out / "sim.json"));
  EXPECT_EQ(figures.at("collisions"), 0);
  EXPECT_TRUE(figures.at("min_clearance_m").is_null());
  EXPECT_NE(core::read_file(sim.out / "site.yaml").find("polygon_m: ["), std::string::npos);
}

TEST(SimRecorder, WritesWhereItIsTwentyTimesASecondAsItGoes) {
  Running sim("sim_flight");
  const Time end = sim.vehicle.now() + from_seconds(1);
  sim.real_time.run(sim.recorder, [&] { return sim.vehicle.now() >= end; });
  const std::string rows = core::read_file(sim.out / "flight_truth.csv");  // before `finish`
  EXPECT_NEAR(static_cast<double>(std::count(rows.begin(), rows.end(), '\n')), 21, 2);
  EXPECT_NE(rows.find(",0,idle,"), std::string::npos) << rows;
}

TEST(Scenarios, ThoseOfTheRepositoryAreMissionsWithRoom) {
  for (const std::string name : {"demo", "small"}) {
    const std::string file = source_dir() + "/configs/scenarios/" + name + ".yaml";
    const auto scenario = core::load_config<simulation::Scenario>(file, {});
    ASSERT_EQ(scenario.kind, simulation::ScenarioKind::mission);
    const auto site = simulation::build_mission_world(scenario.mission, 1);
    EXPECT_EQ(static_cast<int>(site.prior.objects.size()), scenario.mission.site.targets);
  }
}

}  // namespace
}  // namespace saker::tools
