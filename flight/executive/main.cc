#include <spdlog/spdlog.h>

#include <cstdlib>

#include "flight/bus/machine.h"
#include "flight/command_line/output.h"
#include "flight/executive/briefing.h"
#include "flight/executive/executive.h"
#include "flight/process/process.h"
#include "flight/process/service.h"
#include "saker/exchange/robot_key.h"
#include "saker/lidar/metadata.h"
#include "saker/objects/map_io.h"

namespace saker::flight {
namespace {

struct FlightOptions {
  std::string prior;
  std::string metadata;
  CommonOptions output;
};

/// A loop hangs, and with it what it uses: nothing is destroyed. All files are written.
[[noreturn]] void leave(FlightMark& mark, int status) {
  spdlog::critical("the process ends without the loops that hang");
  spdlog::default_logger()->flush();
  mark.clear();
  std::_Exit(status);
}

int fly(const ProcessOptions& options, const FlightOptions& flight) {
  ProcessConfig config = read_configuration(options.configuration);
  config.autonomy = autonomy::within_geofence(std::move(config.autonomy));
  ExecutiveInput input{lidar::read_metadata(flight.metadata), {}};
  if (!flight.prior.empty()) input.prior = objects::read_map(flight.prior, config.autonomy.objects);
  FlightMark mark;
  require_fit(check_machine(
      {.bus = config.bus, .lidar_ports = {input.sensor.lidar_port, input.sensor.imu_port}}));
  Bus bus(config.bus, options.robot);
  Presence presence(bus, "saker-flight");
  presence.claim();
  const exchange::RobotKeyFile key = exchange::robot_key_file(config.exchange.key_file);
  if (!key.note.empty()) spdlog::warn(key.note);
  config.exchange.key_file = key.file;
  const std::unique_ptr<RobotExchange> exchange = make_exchange(config, bus);
  std::optional<Briefing> briefing;
  if (exchange != nullptr) {
    briefing.emplace(config, *exchange, bus, presence);
    input.prior = briefing->brief(input.prior);
    input.exchange = exchange.get();
    input.figures = briefing->figures();
  }
  Executive executive(config, input, bus, presence);
  const OutputFolder out(flight.output);
  spdlog::info("flies as {}", options.robot);
  const std::string note =
      autonomy::noise_note(config.autonomy, lidar::name_and_mode(input.sensor));
  if (!note.empty()) spdlog::info(note);
  if (briefing) spdlog::info(briefing->text());
  Service service;
  service.ready();
  const bool succeeded = executive.run(service, mark);
  executive.save(out.path());
  if (briefing && executive.ended({"mapping", "exchange"}))
    briefing->debrief(executive.history(), out.path());
  const int status = succeeded ? 0 : 1;
  if (!executive.ended()) leave(mark, status);
  return status;
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  auto flight = std::make_shared<saker::flight::FlightOptions>();
  return saker::flight::run_program(
      {.name = "saker-flight",
       .does = "The autonomy executive of one robot: flies a mission over the targets of a prior "
               "map and maps them.",
       .add_options =
           [flight](CLI::App& app) {
             app.add_option("--prior", flight->prior,
                            "map of the targets' rough places; without one the geofence is swept")
                 ->type_name("FILE");
             app.add_option("--meta", flight->metadata, "the sensor's metadata (JSON)")
                 ->type_name("FILE")
                 ->required();
             app.add_option("-o", flight->output.out, "folder of the results")
                 ->type_name("OUT")
                 ->required();
             app.add_flag("--force", flight->output.force, "replace results in OUT");
           },
       .run =
           [flight](const saker::flight::ProcessOptions& options) {
             return saker::flight::fly(options, *flight);
           }},
      argc, argv);
}
