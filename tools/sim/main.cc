#include <spdlog/spdlog.h>

#include <optional>

#include "flight/bus/priority.h"
#include "flight/process/configuration.h"
#include "flight/process/process.h"
#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/simulation/mission/scenario.h"
#include "tools/saker/command.h"
#include "tools/sim/real_time.h"
#include "tools/sim/vehicle_craft.h"

namespace saker::tools {
namespace {

constexpr int kPriority = 45;  // an aircraft waits for no program: below the executive's I/O alone

struct SimOptions {
  std::string scenario;
  RealTimeOptions real_time;
  std::string mavlink;  // autopilot; empty: the flight-controller interface of LCM
  std::string mavlink_line = "udp:127.0.0.1:14550";
  CommonOptions output;
};

simulation::MissionConfig read_mission(const std::string& file) {
  const auto scenario = core::load_config<simulation::Scenario>(file, {});
  if (scenario.kind != simulation::ScenarioKind::mission)
    throw Error(file + ": kind: expected mission");
  return scenario.mission;
}

std::optional<Quirks> quirks_for(const std::string& mavlink) {
  if (mavlink.empty()) return std::nullopt;
  return quirks_of(mavlink == "px4" ? Autopilot::px4 : Autopilot::ardupilot);
}

/// 0 when it flew, or was ended, without touching anything.
int simulate(const flight::ProcessOptions& options, const SimOptions& sim) {
  const flight::ProcessConfig config = flight::read_configuration(options.configuration);
  simulation::MissionConfig mission = read_mission(sim.scenario);
  const std::optional<Quirks> quirks = quirks_for(sim.mavlink);
  if (quirks) put_behind(*quirks, mission);
  simulation::SimulatedVehicle vehicle(mission, sim.output.seed);
  std::optional<MavlinkLine> mavlink;
  if (quirks) mavlink.emplace(*quirks, sim.mavlink_line, vehicle.now());
  flight::Bus bus(config.bus, options.robot);
  flight::Presence presence(bus, "saker-sim");
  presence.claim();
  RealTime real_time(vehicle, bus, presence, sim.real_time, mavlink ? &*mavlink : nullptr);
  const OutputFolder out(sim.output);
  lidar::SensorInfo sensor = vehicle.sensor();
  sensor.lidar_port = sim.real_time.lidar_port;
  sensor.imu_port = sim.real_time.imu_port;
  SimRecorder recorder(out.path(), mission, vehicle, sensor);
  spdlog::info("{} stands at the take-off point; {} targets", options.robot,
               vehicle.site().prior.objects.size());
  if (const std::string fault = flight::take_priority(kPriority); !fault.empty())
    spdlog::warn(fault);
  SimRecorder::Run run = real_time.run(recorder, [] { return flight::stop_requests() > 0; });
  run.seed = sim.output.seed;
  recorder.finish(vehicle, run);
  spdlog::info("{}; {} collisions, {:.2f} CPU seconds a second",
               run.landed ? "landed" : "ends as asked", vehicle.truth().collisions,
               run.cpu_s / run.wall_s);
  return vehicle.truth().collisions == 0 ? 0 : 1;
}

void add_options(CLI::App& app, SimOptions& sim) {
  app.add_option("SCENARIO", sim.scenario, "what to simulate (*.yaml of kind mission)")->required();
  app.add_option("--factor", sim.real_time.factor, "simulated seconds a second")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--seed", sim.output.seed, "of world, wind and noise")->capture_default_str();
  app.add_option("--lidar-port", sim.real_time.lidar_port, "UDP, of this machine")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  app.add_option("--imu-port", sim.real_time.imu_port, "UDP, of this machine")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  app.add_option("--mavlink", sim.mavlink,
                 "behind this autopilot's MAVLink instead of LCM: ardupilot or px4")
      ->check(CLI::IsMember({"ardupilot", "px4"}));
  app.add_option("--mavlink-line", sim.mavlink_line, "where the bridge listens")
      ->capture_default_str();
  app.add_option("-o,--out", sim.output.out, "folder of the results")->type_name("OUT")->required();
  app.add_flag("--force", sim.output.force, "replace results in OUT");
}

}  // namespace
}  // namespace saker::tools

int main(int argc, char** argv) {
  auto sim = std::make_shared<saker::tools::SimOptions>();
  return saker::flight::run_program(
      {.name = "saker-sim",
       .does = "World, sensor, vehicle and flight controller of one robot in real time: packets "
               "over UDP, the rest over LCM.",
       .add_options = [sim](CLI::App& app) { saker::tools::add_options(app, *sim); },
       .run =
           [sim](const saker::flight::ProcessOptions& options) {
             return saker::tools::simulate(options, *sim);
           }},
      argc, argv);
}
