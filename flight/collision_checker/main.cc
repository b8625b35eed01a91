#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "flight/bus/presence.h"
#include "flight/bus/priority.h"
#include "flight/collision_checker/checker_process.h"
#include "flight/command_line/output.h"
#include "flight/process/process.h"
#include "flight/process/service.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using Steady = CheckerProcess::Steady;

constexpr int kPriority = 30;  // above the executive's ingestion, below all that flies

/// One thread: waits for messages until something is due, works, says.
void serve(Bus& bus, Presence& presence, CheckerProcess& checker) {
  Service service;
  service.ready();
  Steady::time_point next_announcement = Steady::now();
  while (stop_requests() == 0) {
    const auto until = std::min(checker.next_due(), next_announcement);
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(until - Steady::now());
    if (bus.handle(std::max(wait, std::chrono::milliseconds{0})) < 0)
      throw Error("the LCM network is gone");
    checker.step(Steady::now());
    service.alive(Steady::now());
    if (Steady::now() < next_announcement) continue;
    presence.announce();
    next_announcement = Steady::now() + Presence::kPeriod;
  }
  service.stopping();
}

/// What the report of the flight says of this process.
void leave_loops(const CommonOptions& output, const CheckerProcess& checker, Steady::duration ran) {
  const OutputFolder out(output);
  write_loops(out / "loops.json", std::chrono::duration<double>(ran).count(), process_seconds(),
              checker.loops());
}

int run(const ProcessOptions& options, const CommonOptions& output) {
  const auto begin = Steady::now();
  const ProcessConfig config = read_configuration(options.configuration);
  Bus bus(config.bus, options.robot);
  Presence presence(bus, "saker-collision-checker");
  presence.claim();
  CheckerProcess checker(config, bus);
  if (const std::string fault = take_priority(kPriority); !fault.empty()) spdlog::warn(fault);
  spdlog::info("listens as {}", options.robot);
  serve(bus, presence, checker);
  if (!output.out.empty()) leave_loops(output, checker, Steady::now() - begin);
  spdlog::info("ends as asked");
  return 0;
}

}  // namespace
}  // namespace saker::flight

int main(int argc, char** argv) {
  auto output = std::make_shared<saker::flight::CommonOptions>();
  return saker::flight::run_program(
      {.name = "saker-collision-checker",
       .does = "Keeps the occupancy map of one robot and says how far its committed trajectory may "
               "be flown.",
       .add_options =
           [output](CLI::App& app) {
             app.add_option("-o", output->out,
                            "folder of loops.json: processor time, for the report")
                 ->type_name("OUT");
             app.add_flag("--force", output->force, "replace results in OUT");
           },
       .run =
           [output](const saker::flight::ProcessOptions& options) {
             return saker::flight::run(options, *output);
           }},
      argc, argv);
}
