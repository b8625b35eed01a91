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

  /// The autopilot's system, from its heartbeat; nothing: none came. Throws Error on another kind.
  [[nodiscard]] std::optional<std::uint8_t> meet() {
    const Time end = host_now() + kPatience;
    std::optional<std::uint8_t> system;
    while (!system && host_now() < end && stop_requests() == 0) {
      step([&](const Frame& frame) {
        if (frame.id != Heartbeat::kId || frame.component != kAutopilotComponent) return;
        if (config_.autopilot_system != 0 && frame.system != config_.autopilot_system) return;
        expect_kind(decode<Heartbeat>(frame.bytes()).autopilot);
        system = frame.system;
      });
    }
    return system;
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

  void expect_kind(std::uint8_t kind) const {
    const std::uint8_t expected = dialect_of(config_.autopilot).heartbeat_kind;
    if (kind == expected) return;
    throw Error(
        fmt::format("mavlink.autopilot: the line has kind {} of MAV_AUTOPILOT, expected {} ({})",
                    kind, expected, to_string(config_.autopilot)));
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

ParameterTable table_of(const MavlinkConfig& config, const CheckOptions& options) {
  const Autopilot autopilot = config.bridge.autopilot;
  const std::string file = options.table.empty()
                               ? fmt::format("autopilots/{}.yaml", to_string(autopilot))
                               : options.table;
  ParameterTable table =
      read_parameter_table(core::find_in_configs(file, "--table"), config.bridge.system);
  if (table.autopilot == autopilot) return table;
  throw Error(fmt::format("{}: autopilot {}, expected {} as mavlink.autopilot says", file,
                          to_string(table.autopilot), to_string(autopilot)));
}

/// Prints one. \return whether it is as it has to be
bool print(const ExpectedParameter& expected, const Parameter& read, double latency_ms) {
  const bool missing = read.outcome != ParameterOutcome::known;
  const bool fine = missing ? expected.optional : expected.fits(read.value, latency_ms);
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
  const ParameterTable table = table_of(config, options);
  const bool bytewise = config.bridge.autopilot == Autopilot::px4;
  Talk talk(config);
  const auto system = talk.meet();
  if (!system) {
    spdlog::error("no heartbeat on {} for {:g} s{}{}", config.line, to_seconds(kPatience),
                  talk.fault().empty() ? "" : ": ", talk.fault());
    return 1;
  }
  fmt::print("{}, system {}; table: {} ({})\n", to_string(table.autopilot), *system, table.firmware,
             table.evidence);
  ParameterExchange exchange(to_read(table), *system, kAutopilotComponent, bytewise);
  talk.run(exchange, *system);
  bool all = true;
  for (std::size_t i = 0; i < table.parameters.size(); ++i)
    all = print(table.parameters[i], exchange.parameters()[i], options.latency_ms) && all;
  const auto differing = to_write(table, exchange.parameters(), options.latency_ms);
  if (!options.write || differing.empty()) return all ? 0 : 1;
  return write(talk, differing, *system, bytewise) ? 0 : 1;
}

}  // namespace saker::flight::mavlink
