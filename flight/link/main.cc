#include <spdlog/spdlog.h>

#include <chrono>

#include "flight/bus/counter.h"
#include "flight/bus/exchange_messages.h"
#include "flight/bus/multicast.h"
#include "flight/bus/presence.h"
#include "flight/link/radio.h"
#include "flight/process/configuration.h"
#include "flight/process/loop_meter.h"
#include "flight/process/process.h"
#include "flight/process/service.h"
#include "saker/core/error.h"
#include "saker/exchange/robot_key.h"

namespace saker::flight {
namespace {

using Steady = LinkEnd::Steady;

constexpr const char* kRole = "saker-link";
constexpr std::chrono::milliseconds kHealthPeriod{1000};

health_t health_of(const LinkEnd& end, LoopMeter& meter) {
  const LinkEnd::Report report = end.report();
  const LinkEnd::Counters& counters = report.counters;
  auto figures = health(report);
  figures.emplace_back("link_unsealed", counters.refused.unsealed);
  figures.emplace_back("link_replayed", counters.refused.replayed);
  figures.emplace_back("link_strangers", counters.refused.strangers);
  figures.emplace_back("link_without_right", counters.refused.without_right);
  figures.emplace_back("link_replaced", counters.replaced);
  health_t message{};
  message.utime = system_utime();
  message.process = kRole;
  message.loops = {meter.take_period(kHealthPeriod, std::nan(""), counters.not_sent)};
  message.num_loops = 1;
  for (const auto& [name, value] : figures) message.counters.push_back(counter(name, value));
  message.num_counters = static_cast<std::int32_t>(message.counters.size());
  return message;
}

void serve(Bus& bus, Presence& presence, Radio& radio, Service service) {
  LoopMeter meter("link");
  Steady::time_point next_health = Steady::now(), next_announcement = next_health;
  while (stop_requests() == 0) {
    const auto due = std::min({radio.end().next_due(), next_health, next_announcement});
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(due - Steady::now());
    if (Bus::handle({&bus}, wait, radio.descriptor()) < 0) throw Error("the LCM network is gone");
    const LoopMeter::Run run(meter);
    const auto now = Steady::now();
    radio.step(now);
    service.alive(now);
    if (now >= next_health) {
      next_health = now + kHealthPeriod;
      bus.publish(health_of(radio.end(), meter));
    }
    if (now < next_announcement) continue;
    next_announcement = now + Presence::kPeriod;
    presence.announce();
    if (presence.outranked()) throw Error(presence.other());
  }
  service.stopping();
  radio.end().say_goodbye();
}

int run(const ProcessOptions& options) {
  const ProcessConfig config = read_configuration(options.configuration);
  Service service;
  if (config.link.ground.empty()) {
    service.ready();
    spdlog::info("link.ground is empty: {} tells the ground nothing", options.robot);
    return 0;
  }
  require_on_machine("bus.control_url", config.bus.control_url);
  if (is_own(address_of("link.ground", config.link.ground)))
    throw Error("link.ground " + config.link.ground +
                " is this machine: its LCM would hear late what it said before");
  const exchange::RobotKeyFile key_file = exchange::robot_key_file(config.exchange.key_file);
  if (!key_file.note.empty()) spdlog::warn(key_file.note);
  const exchange::Key key = exchange::read_key(key_file.file);
  Bus bus = Bus::on_network(config.bus.control_url, config.bus.receive_buffer_kb, options.robot);
  Presence presence(bus, kRole);
  Radio radio(config.link, LinkEnd::End::robot, 0, key, bus, 1);
  presence.claim();
  service.ready();
  spdlog::info("joins {} with the ground at {}", options.robot, config.link.ground);
  serve(bus, presence, radio, service);
  spdlog::info("ends as asked");
  return 0;
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  return saker::flight::run_program(
      {.name = "saker-link",
       .does = "A robot's end of the sealed link: tells the base station what the robot says, "
               "tells the robot orders and what other robots know.",
       .run = saker::flight::run},
      argc, argv);
}
