#include "flight/mavlink/check.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <optional>
#include <thread>

#include "flight/mavlink/dialect.h"
#include "flight/mavlink/frame.h"
#include "flight/mavlink/host_clock.h"
#include "flight/mavlink/line.h"
#include "flight/mavlink/parameter_exchange.h"
#include "flight/mavlink/parameter_table.h"
#include "flight/process/process.h"
#include "saker/core/config_folder.h"
#include "saker/core/error.h"

namespace saker::flight::mavlink {
namespace {

constexpr Time kPatience = 10 * kNanosecondsPerSecond;  // for a heartbeat
constexpr Time kHeartbeat = kNanosecondsPerSecond;
constexpr std::uint8_t kAutopilotComponent = 1;
constexpr std::chrono::milliseconds kLook{5};
constexpr const char* kSecondWord = "write";

/// The line, with whom it speaks to.
class Talk {
 public:
  explicit Talk(const MavlinkConfig& config)
      : config_(config.bridge),
        signing_(signing_of(config.signing_key)),
        reader_(signing_ ? &*signing_ : nullptr),
        writer_(static_cast<std::uint8_t>(config.bridge.system),
                static_cast<std::uint8_t>(config.bridge.component)),
        line_(parsed_address(config.line)) {}

  /// Who says HEARTBEAT as an autopilot.
  struct Met {
    std::uint8_t system = 0;
    std::uint8_t kind = 0;  // MAV_AUTOPILOT
  };

  /// Nothing: none was heard.
  [[nodiscard]] std::optional<Met> meet(Time patience) {
    const Time end = host_now() + patience;
    std::optional<Met> met;
    while (!met && host_now() < end && stop_requests() == 0) {
      step([&](const Frame& frame) {
        if (frame.id != Heartbeat::kId || frame.component != kAutopilotComponent) return;
        if (config_.autopilot_system != 0 && frame.system != config_.autopilot_system) return;
        met = {frame.system, decode<Heartbeat>(frame.bytes()).autopilot};
      });
    }
    return met;
  }

  void run(ParameterExchange& exchange, std::uint8_t system) {
    while (!exchange.done() && stop_requests() == 0) {
      if (const auto request = exchange.due(host_now())) {
        std::visit([&](const auto& message) { send(message); }, *request);
      }
      step([&](const Frame& frame) {
        if (frame.id == ParamValue::kId && frame.system == system)
          exchange.hear(decode<ParamValue>(frame.bytes()));
      });
    }
  }

  [[nodiscard]] const std::string& fault() const { return line_.fault(); }

 private:
  [[nodiscard]] static std::optional<Signing> signing_of(const std::string& file) {
    if (file.empty()) return std::nullopt;
    return Signing{.key = read_signing_key(file), .clock = {}};
  }

  template <class Message>
  void send(const Message& message) {
    const auto frame = writer_.write(message, signing_ ? &*signing_ : nullptr, signing_now());
    if (frame) line_.write(frame->span());
  }

  /// What came, and a heartbeat of ours where it is due: some autopilots answer to nobody unknown.
  template <class Take>
  void step(const Take& take) {
    const Time now = host_now();
    line_.step(now);
    if (now >= next_heartbeat_) {
      next_heartbeat_ = now + kHeartbeat;
      Heartbeat heartbeat;
      heartbeat.type = 18;      // MAV_TYPE_ONBOARD_CONTROLLER
      heartbeat.autopilot = 8;  // MAV_AUTOPILOT_INVALID
      heartbeat.system_status = 4;
      heartbeat.mavlink_version = 3;
      send(heartbeat);
    }
    std::array<std::uint8_t, 2048> buffer;
    auto bytes = line_.read(buffer, now);
    if (bytes.empty()) return std::this_thread::sleep_for(kLook);
    while (!bytes.empty()) {
      bytes = bytes.subspan(reader_.push(bytes));
      while (const auto frame = reader_.next(signing_now())) take(*frame);
    }
    if (!line_.in_datagrams()) return;
    reader_.settle();
    while (const auto frame = reader_.next(signing_now())) take(*frame);
  }

  BridgeConfig config_;
  std::optional<Signing> signing_;
  FrameReader reader_;
  FrameWriter writer_;
  Line line_;
  Time next_heartbeat_ = 0;
};

/// Empty: the autopilot is the configured one.
std::string another_kind(const BridgeConfig& config, std::uint8_t kind) {
  const std::uint8_t expected = dialect_of(config.autopilot).heartbeat_kind;
  if (kind == expected) return "";
  return fmt::format("mavlink.autopilot: the line has kind {} of MAV_AUTOPILOT, expected {} ({})",
                     kind, expected, to_string(config.autopilot));
}

/// \param option  of the command line; empty: the configuration's
ParameterTable table_of(const MavlinkConfig& config, const std::string& option) {
  const Autopilot autopilot = config.bridge.autopilot;
  const std::string own = fmt::format("autopilots/{}.yaml", to_string(autopilot));
  const std::string file = !option.empty() ? option : !config.table.empty() ? config.table : own;
  ParameterTable table = read_parameter_table(
      core::find_in_configs(file, option.empty() ? "mavlink.table" : "--table"),
      config.bridge.system);
  if (table.autopilot == autopilot) return table;
  throw Error(fmt::format("{}: autopilot {}, expected {} as mavlink.autopilot says", file,
                          to_string(table.autopilot), to_string(autopilot)));
}

bool fits(const ExpectedParameter& expected, const Parameter& read, double latency_ms) {
  if (read.outcome != ParameterOutcome::known) return expected.optional;
  return expected.fits(read.value, latency_ms);
}

/// Prints one. \return whether it is as it has to be
bool print(const ExpectedParameter& expected, const Parameter& read, double latency_ms) {
  const bool missing = read.outcome != ParameterOutcome::known;
  const bool fine = fits(expected, read, latency_ms);
  const std::string value = missing ? "–" : fmt::format("{:g}", read.value);
  fmt::print("{:<6} {:<17} {:>9}  {}\n", fine ? "ok" : "wrong", expected.name, value,
             expected.expected_text(latency_ms));
  if (!fine)
    fmt::print("{:<6} {}{}\n", "", missing ? "the autopilot has none: " : "", expected.why);
  return fine;
}

std::vector<Parameter> to_read(const ParameterTable& table) {
  std::vector<Parameter> parameters;
  for (const ExpectedParameter& expected : table.parameters)
    parameters.push_back({.name = expected.name, .set = std::nullopt});
  return parameters;
}

/// What differs and what it has to be, where the table says one value.
std::vector<Parameter> to_write(const ParameterTable& table, const std::vector<Parameter>& read,
                                double latency_ms) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const ExpectedParameter& expected = table.parameters[i];
    const double wanted = expected.wanted(latency_ms);
    const bool known = read[i].outcome == ParameterOutcome::known;
    if (!known || expected.fits(read[i].value, latency_ms) || std::isnan(wanted)) continue;
    parameters.push_back({.name = expected.name, .set = wanted, .type = read[i].type});
  }
  return parameters;
}

/// \return whether all were taken
bool write(Talk& talk, std::vector<Parameter> parameters, std::uint8_t system, bool bytewise) {
  ParameterExchange exchange(std::move(parameters), system, kAutopilotComponent, bytewise);
  talk.run(exchange, system);
  bool all = true;
  for (const Parameter& parameter : exchange.parameters()) {
    const bool taken = parameter.outcome == ParameterOutcome::known;
    all = all && taken;
    fmt::print("{:<6} {:<17} {:>9g}  {}\n", taken ? "set" : "wrong", parameter.name, *parameter.set,
               taken ? "" : "not taken");
  }
  fmt::print("boot the autopilot anew: some are read then alone\n");
  return all;
}

}  // namespace

int check_parameters(const MavlinkConfig& config, const CheckOptions& options) {
  if (options.write && options.confirm != kSecondWord) {
    throw Error(fmt::format("--write: expected --confirm {} beside it", kSecondWord));
  }
  const ParameterTable table = table_of(config, options.table);
  const bool bytewise = config.bridge.autopilot == Autopilot::px4;
  Talk talk(config);
  const auto met = talk.meet(kPatience);
  if (!met) {
    spdlog::error("no heartbeat on {} for {:g} s{}{}", config.line, to_seconds(kPatience),
                  talk.fault().empty() ? "" : ": ", talk.fault());
    return 1;
  }
  if (const std::string other = another_kind(config.bridge, met->kind); !other.empty())
    throw Error(other);
  fmt::print("{}, system {}; table: {} ({})\n", to_string(table.autopilot), met->system,
             table.firmware, table.evidence);
  ParameterExchange exchange(to_read(table), met->system, kAutopilotComponent, bytewise);
  talk.run(exchange, met->system);
  bool all = true;
  for (std::size_t i = 0; i < table.parameters.size(); ++i)
    all = print(table.parameters[i], exchange.parameters()[i], options.latency_ms) && all;
  const auto differing = to_write(table, exchange.parameters(), options.latency_ms);
  if (!options.write || differing.empty()) return all ? 0 : 1;
  return write(talk, differing, met->system, bytewise) ? 0 : 1;
}

AutopilotLook look_at_autopilot(const MavlinkConfig& config, Time patience) {
  using Outcome = AutopilotLook::Outcome;
  const ParameterTable table = table_of(config, "");
  Talk talk(config);
  const auto met = talk.meet(patience);
  if (!met)
    return {Outcome::silent, talk.fault().empty() ? fmt::format("no heartbeat on {} for {:g} s",
                                                                config.line, to_seconds(patience))
                                                  : talk.fault()};
  if (std::string other = another_kind(config.bridge, met->kind); !other.empty())
    return {Outcome::another, std::move(other)};
  ParameterExchange exchange(to_read(table), met->system, kAutopilotComponent,
                             config.bridge.autopilot == Autopilot::px4);
  talk.run(exchange, met->system);
  std::vector<std::string> differing;
  for (std::size_t i = 0; i < table.parameters.size(); ++i)
    if (!fits(table.parameters[i], exchange.parameters()[i], NAN))
      differing.push_back(table.parameters[i].name);
  const std::string who = fmt::format("{}, system {}", to_string(table.autopilot), met->system);
  if (differing.empty())
    return {Outcome::fits, fmt::format("{}, {} parameters fit", who, table.parameters.size())};
  return {Outcome::differs,
          fmt::format("{}, not as they have to be: {}", who, fmt::join(differing, ", "))};
}

}  // namespace saker::flight::mavlink
