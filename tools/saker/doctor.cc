#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "flight/bus/machine.h"
#include "flight/bus/presence.h"
#include "flight/mavlink/check.h"
#include "saker/core/error.h"
#include "saker/exchange/key.h"
#include "saker/exchange/robot_key.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

using flight::Finding;
using flight::Weight;

const char* word(Weight weight) {
  constexpr const char* kWords[] = {"ok", "worse", "wrong"};
  return kWords[static_cast<int>(weight)];
}

void print(const Finding& finding) {
  fmt::print("{:<6} {:<24} {}\n", word(finding.weight), finding.subject, finding.found);
  if (finding.weight != Weight::fine) fmt::print("{:<6} mend with: {}\n", "", finding.remedy);
}

constexpr const char* kInstalledKey = "/etc/saker/robot.key";  // docs/deploy.md

/// Of a robot: the one that is configured or, where that is not there, the installed one.
Finding check_key(const flight::ExchangeConfig& config) {
  std::error_code hidden;
  std::filesystem::path file = config.key_file;
  if (!std::filesystem::exists(exchange::robot_key_file(file).file, hidden)) file = kInstalledKey;
  const auto key = exchange::robot_key_file(file);
  if (key.note.empty()) return {"key", Weight::fine, "the team's is not here", ""};
  if (exchange::team_key_note(key.file).empty())
    return {"key", Weight::drawback, key.note,
            fmt::format("mv {} {}", key.file.c_str(), file.c_str())};
  return {"key", Weight::drawback, key.note,
          "saker base key --robot NAME -o FILE at the base, where this one belongs, and FILE here"};
}

/// A bridge that runs: the line is its own, and is left alone. Empty: none does, or there is no
/// network on which it could.
std::string running_bridge(const flight::BusConfig& config) {
  using Steady = std::chrono::steady_clock;
  std::string found;
  try {
    flight::Bus bus(config, "DOCTOR");
    bus.subscribe_all<presence_t>([&](const std::string& robot, const presence_t& message) {
      if (message.role == "saker-mavlink")
        found = fmt::format("saker-mavlink of {} (process {}) has its line: {}_HEALTH says more",
                            robot, message.pid, robot);
      return true;
    });
    const auto end = Steady::now() + 2 * flight::Presence::kPeriod;
    while (found.empty() && Steady::now() < end)
      if (bus.handle(std::chrono::milliseconds(20)) < 0) break;
  } catch (const Error&) {
    return "";
  }
  return found;
}

/// Of the line to it: who has no autopilot flies the simulated vehicle, so that silence is no
/// fault.
Finding check_autopilot(const flight::BusConfig& bus,
                        const flight::mavlink::MavlinkConfig& config) {
  using Outcome = flight::mavlink::AutopilotLook::Outcome;
  if (std::string bridge = running_bridge(bus); !bridge.empty())
    return {"autopilot", Weight::fine, std::move(bridge), ""};
  const std::string set = fmt::format("--set mavlink.line={}", config.line);
  try {
    const auto look = flight::mavlink::look_at_autopilot(config);
    switch (look.outcome) {
      case Outcome::fits:
        return {"autopilot", Weight::fine, look.line, ""};
      case Outcome::silent:
        return {
            "autopilot", Weight::drawback, look.line,
            "wire it to mavlink.line, or end what has the line; a simulated aircraft needs none"};
      case Outcome::another:
        return {"autopilot", Weight::grounding, look.line, "--set mavlink.autopilot=…"};
      case Outcome::differs:
        return {"autopilot", Weight::grounding, look.line, "saker-mavlink check " + set};
    }
  } catch (const Error& error) {
    return {"autopilot", Weight::grounding, error.what(), "mend the configuration"};
  }
  return {};
}

int doctor(const CommonOptions& common) {
  const flight::ProcessConfig config = read_configuration(common);
  std::vector<Finding> findings = flight::check_machine({.bus = config.bus});
  findings.push_back(check_key(config.exchange));
  findings.push_back(check_autopilot(config.bus, config.mavlink));
  for (const Finding& finding : findings) print(finding);
  const auto grounding = std::count_if(findings.begin(), findings.end(), [](const Finding& f) {
    return f.weight == Weight::grounding;
  });
  if (grounding == 0) {
    fmt::print("nothing keeps a mission from flying\n");
    return 0;
  }
  fmt::print("{} to mend before a mission can fly\n", grounding);
  return 1;
}

}  // namespace

void add_doctor(Commands& commands) {
  commands.add(
      {.name = "doctor",
       .does = "what on this machine would keep a mission from flying, and the command that "
               "mends it; status 1 when there is such a thing",
       .example = "saker doctor"},
      doctor);
}

}  // namespace saker::tools
