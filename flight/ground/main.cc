#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "flight/ground/live_source.h"
#include "flight/ground/run_source.h"
#include "flight/ground/server.h"
#include "flight/ground/store_watch.h"
#include "flight/ground/team_order_line.h"
#include "flight/process/configuration.h"
#include "flight/process/process.h"
#include "flight/process/service.h"
#include "saker/core/error.h"
#include "saker/objects/map_io.h"

namespace saker::flight::ground {
namespace {

namespace fs = std::filesystem;

struct GroundOptions {
  std::string run, prior, record, listen;
  int port = -1;
};

ServerConfig server_config(const GroundConfig& config) {
  ServerConfig server{.port = config.port, .page = page_folder(), .tls = {}};
  if (config.listen.empty()) return server;
  server.address = config.listen;
  server.tls = credentials(config.folder, config.listen);
  return server;
}

/// The key is for the eyes of who sits before it: on a terminal, in no log.
void say_address(const Server& server, const ServerConfig& config) {
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  std::cout << server.address() << (config.tls && terminal ? "?key=" + config.tls->key : "")
            << std::endl;
  if (!config.tls) return;
  if (!terminal)
    spdlog::info("opens as {}?key=KEY, with the key in {}", server.address(),
                 config.tls->key_file.string());
  spdlog::info("the certificate is this server's own; browsers show its SHA-256: {}",
               config.tls->fingerprint);
}

void say_totals(const Hub& hub, const Server& server) {
  const Hub::Counters c = hub.counters();
  spdlog::info(
      "{} clients, {} refused, {} cut that took nothing, {} cut that sent garbage, {} "
      "messages dropped for slow ones",
      c.opened, server.refused(), c.stuck, c.garbage, c.dropped);
}

/// Another one each start.
std::string session_name() {
  return std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
}

int show_run(const ProcessConfig& config, const viewers::Site& site, const GroundOptions& options) {
  const std::unique_ptr<viewers::Run> run = viewers::open_run(options.run, site);
  Hub hub({.mode = "run",
           .version = SAKER_VERSION,
           .session = session_name(),
           .begin = viewers_time(run->begin_s()),
           .end = viewers_time(run->end_s())});
  RunSource source(*run, site, hub);
  source.offer();
  const ServerConfig how = server_config(config.ground);
  const Server server(how, hub);
  say_address(server, how);
  flight::Service service;
  service.ready();
  constexpr std::chrono::milliseconds kPeriod{50};
  auto before = std::chrono::steady_clock::now();
  while (stop_requests() == 0) {
    std::this_thread::sleep_for(kPeriod);
    const auto now = std::chrono::steady_clock::now();
    source.step(std::chrono::duration<double>(now - before).count());
    before = now;
    service.alive(now);
  }
  service.stopping();
  say_totals(hub, server);
  return 0;
}

int show_live(const ProcessConfig& config, viewers::Site site, const std::string& name,
              const GroundOptions& options) {
  if (!options.prior.empty())
    site.prior = objects::read_map(options.prior, config.autonomy.objects);
  std::optional<viewers::Recording> recording;
  if (!options.record.empty()) recording.emplace(options.record);
  Hub hub({.mode = "live",
           .version = SAKER_VERSION,
           .session = session_name(),
           .begin = {},
           .end = {}});
  OrderDesk orders(nullptr, fs::path(config.ground.folder) / "orders.log");
  orders.offer_to(hub);
  LiveSource source(config.bus, name, std::make_shared<const viewers::Site>(std::move(site)), hub,
                    orders, recording ? &*recording : nullptr);
  if (fs::exists(config.exchange.key_file)) {
    fs::create_directories(config.ground.folder);
    orders.send_by(std::make_unique<TeamOrderLine>(source.bus(), config.exchange.key_file, name,
                                                   config.ground.folder));
  } else {
    spdlog::info("no key of a team at {}: orders are refused", config.exchange.key_file);
  }
  const ServerConfig how = server_config(config.ground);
  const Server server(how, hub);
  const StoreWatch store(store_file(config.base), hub);
  say_address(server, how);
  flight::Service service;
  service.ready();
  while (stop_requests() == 0) {
    source.step();
    service.alive(std::chrono::steady_clock::now());
  }
  service.stopping();
  if (recording) recording->finish();
  say_totals(hub, server);
  return 0;
}

int run(const ProcessOptions& process, const GroundOptions& options) {
  ProcessConfig config = read_configuration(process.configuration);
  if (!options.listen.empty()) config.ground.listen = options.listen;
  if (options.port >= 0) config.ground.port = options.port;
  viewers::Site site = viewers::site_of(config.autonomy, config.site.origin);
  if (options.run.empty()) return show_live(config, std::move(site), process.robot, options);
  if (!options.record.empty())
    throw Error("--record is of what flies; of a finished run: saker convert " + options.run +
                " FILE.mcap");
  return show_run(config, site, options);
}

void add_options(CLI::App& app, GroundOptions& options) {
  app.add_option("RUN", options.run,
                 "a finished run: a folder of saker replay, experiment, mission or of "
                 "saker-flight, or a log of lcm-logger; without it what flies now");
  app.add_option("--prior", options.prior, "the prior map that the robots fly by")
      ->type_name("MAP");
  app.add_option("--record", options.record, "write what is shown into an MCAP file")
      ->type_name("FILE");
  app.add_option("--listen", options.listen, "as ground.listen")->type_name("ADDRESS");
  app.add_option("--port", options.port, "as ground.port")->type_name("PORT");
}

}  // namespace
}  // namespace saker::flight::ground

int main(int argc, char** argv) {
  using namespace saker::flight;
  auto options = std::make_shared<ground::GroundOptions>();
  return run_program(
      {.name = "saker-ground",
       .does = "What people on the ground see and order: a page and a Foxglove WebSocket of what "
               "flies now, or of a finished run.",
       .robot = "GROUND",
       .add_options = [options](CLI::App& app) { ground::add_options(app, *options); },
       .run = [options](const ProcessOptions& process) { return ground::run(process, *options); }},
      argc, argv);
}
