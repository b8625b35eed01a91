#include <spdlog/spdlog.h>

#include <string>
#include <utility>
#include <vector>

#include "flight/bus/multicast.h"
#include "flight/bus/presence.h"
#include "flight/bus/priority.h"
#include "flight/mavlink/check.h"
#include "flight/mavlink/mavlink_process.h"
#include "flight/process/configuration.h"
#include "flight/process/process.h"
#include "flight/process/service.h"
#include "saker/core/error.h"

namespace saker::flight::mavlink {
namespace {

using Steady = MavlinkProcess::Steady;

constexpr int kPriority = 50;  // as what flies: the vehicle hangs on it

/// One thread: waits for messages of the bus and bytes of the line.
void serve(Presence& presence, MavlinkProcess& bridge) {
  Service service;
  service.ready();
  Steady::time_point next_announcement = Steady::now();
  while (stop_requests() == 0) {
    if (!bridge.serve()) throw Error("the LCM network is gone");
    service.alive(Steady::now());
    if (Steady::now() < next_announcement) continue;
    presence.announce();
    next_announcement = Steady::now() + Presence::kPeriod;
  }
  service.stopping();
}

/// Nothing else wakes it: half of what it takes is being woken.
void hear_subscribed_alone(const Bus& bus, const std::string& url) {
  std::vector<std::string> channels;
  for (const Bus::Counters& subscription : bus.counters()) channels.push_back(subscription.channel);
  hear_channels_alone(multicast_group(url).port, std::move(channels));
}

int bridge(const ProcessOptions& options) {
  const ProcessConfig config = read_configuration(options.configuration);
  Bus bus = Bus::of_control(config.bus, options.robot);  // scans would cost more than all else
  Presence presence(bus, "saker-mavlink");
  presence.claim();
  MavlinkProcess bridge(config.mavlink, bus);
  hear_subscribed_alone(bus, config.bus.control_url);
  if (const std::string fault = take_priority(kPriority); !fault.empty()) spdlog::warn(fault);
  spdlog::info("listens as {}, autopilot {} on {}", options.robot,
               to_string(config.mavlink.bridge.autopilot), config.mavlink.line);
  serve(presence, bridge);
  if (bridge.added().count() > 0) spdlog::info("{}", bridge.cost_text());
  spdlog::info("ends as asked");
  return 0;
}

/// `saker-mavlink check`, which goes to the line instead of the bridge.
void add_check(CLI::App& app, CLI::App*& check, CheckOptions& options) {
  check = app.add_subcommand(
      "check", "reads the autopilot's parameters that matter and says which differ, and why");
  check->fallthrough();
  check->add_option("--table", options.table, "of configs/autopilots; the autopilot's own")
      ->type_name("FILE");
  check->add_option("--latency-ms", options.latency_ms,
                    "of odometry, as HEALTH of the bridge shows it in flight");
  check->add_flag("--write", options.write, "writes what differs; needs --confirm");
  check->add_option("--confirm", options.confirm, "write: the second word")->type_name("WORD");
}

}  // namespace
}  // namespace saker::flight::mavlink

int main(int argc, char** argv) {
  namespace mavlink = saker::flight::mavlink;
  CLI::App* check = nullptr;
  mavlink::CheckOptions options;
  return saker::flight::run_program(
      {.name = "saker-mavlink",
       .does = "The bridge to PX4 and ArduPilot: the flight-controller interface of one robot as "
               "MAVLink 2.",
       .add_options = [&](CLI::App& app) { mavlink::add_check(app, check, options); },
       .run =
           [&](const saker::flight::ProcessOptions& common) {
             if (!check->parsed()) return mavlink::bridge(common);
             const auto config = saker::flight::read_configuration(common.configuration);
             return mavlink::check_parameters(config.mavlink, options);
           }},
      argc, argv);
}
