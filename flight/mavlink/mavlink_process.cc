#include "flight/mavlink/mavlink_process.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "flight/bus/counter.h"
#include "flight/bus/messages.h"
#include "flight/mavlink/host_clock.h"

namespace saker::flight::mavlink {
namespace {

constexpr Time kStatePeriod = kNanosecondsPerSecond / 50;
constexpr Time kHealthPeriod = kNanosecondsPerSecond;
constexpr Time kPause = kNanosecondsPerSecond / 20;  // of the line: a frame takes 12 ms at 230400
constexpr Time kRest = kNanosecondsPerSecond / 80;   // of the bus, where nothing in it is urgent
constexpr Time kSoon = kNanosecondsPerSecond / 125;  // less is not worth another rest
constexpr std::chrono::milliseconds kLongest{10};    // between looks at what is due
constexpr int kMostReads = 64;                       // in one step

std::optional<SigningKey> key_of(const std::string& file) {
  if (file.empty()) return std::nullopt;
  return read_signing_key(file);
}

}  // namespace

MavlinkProcess::MavlinkProcess(const MavlinkConfig& config, Bus& bus)
    : config_(config),
      bus_(bus),
      bridge_(config.bridge, key_of(config.signing_key)),
      line_(parsed_address(config.line)) {
  subscribe();
}

void MavlinkProcess::subscribe() {
  bus_.subscribe<odometry_t>([this](const odometry_t& message) {
    const auto odometry = from_lcm(message);
    if (!odometry) return false;
    const LoopMeter::Run run(odometry_meter_);
    pass_on(*odometry);
    return true;
  });
  bus_.subscribe<setpoint_t>([this](const setpoint_t& message) {
    const auto setpoint = from_lcm(message);
    if (setpoint) bridge_.hear(*setpoint, host_now());
    return setpoint.has_value();
  });
  bus_.subscribe<command_t>([this](const command_t& message) {
    const auto command = from_lcm(message);
    if (command) bridge_.hear(*command, host_now());
    return command.has_value();
  });
}

void MavlinkProcess::pass_on(const VehicleOdometry& odometry) {
  const long sent = bridge_.counters().odometry;
  const Time heard = host_now();
  bridge_.hear(odometry, heard, !waited_);
  write_line();
  if (bridge_.counters().odometry == sent) return;
  const double added_s = to_seconds(host_now() - heard);
  added_.add(added_s);
  since_stamp_.add(bridge_.odometry().latency_s() + added_s);
}

std::string MavlinkProcess::cost_text() const {
  const double ran_s = std::chrono::duration<double>(Steady::now() - begun_).count();
  return fmt::format(
      "{} of odometry: {:.3f} ms through the bridge (95 %: {:.3f}), {:.1f} ms since its stamp "
      "(95 %: {:.1f}); {:.2f} % of a core",
      added_.count(), 1e3 * added_.quantile(0.5), 1e3 * added_.quantile(0.95),
      1e3 * since_stamp_.quantile(0.5), 1e3 * since_stamp_.quantile(0.95),
      100 * (process_seconds() - begun_cpu_s_) / ran_s);
}

bool MavlinkProcess::serve() {
  using std::chrono::ceil, std::chrono::milliseconds, std::chrono::nanoseconds;
  const Time now = host_now(), next = bridge_.odometry().next();
  const Time rests_until = std::min(bus_heard_ + kRest, next);
  const Time rest = rests_until - now;
  int handled = 0;
  if (rest <= 0 || next - now < kSoon) {
    handled = Bus::handle({&bus_}, kLongest, line_.descriptor());
  } else {
    (void)Bus::handle({}, ceil<milliseconds>(nanoseconds(rest)), line_.descriptor());
    // Awake for the line shortly before: the bus does not wake it once more.
    if (host_now() >= rests_until - kRest / 2) handled = drain();
  }
  if (handled > 0) bus_heard_ = host_now();
  step();
  return handled >= 0;
}

/// What came in a rest.
int MavlinkProcess::drain() {
  waited_ = true;
  const int handled = bus_.handle(std::chrono::milliseconds(0));
  waited_ = false;
  return handled;
}

void MavlinkProcess::step() {
  const LoopMeter::Run run(line_meter_);
  line_.step(host_now());
  read_line();
  const Time now = host_now();
  bridge_.step(now, signing_now());
  for (saker::CommandAck& answer : bridge_.take_answers(now)) {
    answer.stamp = bridge_.odometry().clock().sensor(now).value_or(0);
    not_sent_ += !bus_.publish(to_lcm(answer));
  }
  write_line();
  if (now >= next_state_) say_state(now);
  if (now >= next_health_) say_health(now);
  log_changes(now);
}

void MavlinkProcess::read_line() {
  std::array<std::uint8_t, 2048> buffer;
  for (int i = 0; i < kMostReads; ++i) {
    const Time now = host_now();
    const auto bytes = line_.read(buffer, now);
    if (bytes.empty()) break;
    bridge_.hear_bytes(bytes, now, signing_now());
    last_bytes_ = now;
    settled_ = false;
    if (line_.in_datagrams()) bridge_.settle(now, signing_now());
  }
  if (settled_ || host_now() - last_bytes_ < kPause) return;
  bridge_.settle(host_now(), signing_now());
  settled_ = true;
}

void MavlinkProcess::write_line() {
  for (const FrameBytes& frame : bridge_.take_frames()) line_.write(frame.span());
}

void MavlinkProcess::say_state(Time now) {
  next_state_ = now - next_state_ > kStatePeriod ? now + kStatePeriod : next_state_ + kStatePeriod;
  if (const auto state = bridge_.vehicle_state(now)) not_sent_ += !bus_.publish(to_lcm(*state));
}

void MavlinkProcess::say_health(Time now) {
  next_health_ = now + kHealthPeriod;
  const auto& reader = bridge_.reader().counters();
  const auto& odometry = bridge_.odometry().counters();
  const double latency_ms = bridge_.odometry().latency_s() * 1e3;
  const auto offset = bridge_.time_sync().offset(now);
  health_t health{};
  health.utime = to_utime(bridge_.odometry().clock().sensor(now).value_or(0));
  health.process = "saker-mavlink";
  health.loops = {line_meter_.take_period(std::chrono::nanoseconds(kHealthPeriod), NAN, 0),
                  odometry_meter_.take_period(std::chrono::nanoseconds(kHealthPeriod), latency_ms,
                                              line_.counters().dropped)};
  health.num_loops = static_cast<std::int32_t>(health.loops.size());
  health.counters = {counter("frames", reader.frames),
                     counter("damaged", reader.damaged),
                     counter("forged", reader.forged + reader.unsigned_),
                     counter("odometry", bridge_.counters().odometry),
                     counter("odometry_refused", odometry.refused + odometry.lies),
                     counter("resets", odometry.resets),
                     counter("setpoints", bridge_.counters().setpoints),
                     counter("expired", bridge_.setpoints().counters().expired),
                     counter("commands", bridge_.counters().commands),
                     counter("losses", bridge_.counters().losses),
                     counter("not_finite", bridge_.counters().not_finite),
                     counter("line_lost", line_.counters().lost),
                     counter("bytes_sent", line_.counters().sent),
                     counter("bytes_received", line_.counters().received),
                     counter("reboots", bridge_.time_sync().restarts()),
                     counter("not_sent", not_sent_)};
  if (added_.count() > 0) {
    health.counters.push_back(counter("added_median_us", std::lround(1e6 * added_.quantile(0.5))));
    health.counters.push_back(counter("added_p95_us", std::lround(1e6 * added_.quantile(0.95))));
  }
  if (offset) health.counters.push_back(counter("time_bound_us", offset->bound / 1000));
  health.num_counters = static_cast<std::int32_t>(health.counters.size());
  not_sent_ += !bus_.publish(health);
}

/// One line an event: who is there, who flies, and why.
void MavlinkProcess::log_changes(Time now) {
  const StateIn& autopilot = bridge_.autopilot();
  const std::tuple<bool, bool, bool, int, const std::string&, const std::string&,
                   const std::string&>
      seen(line_.is_open(), autopilot.connected(now), autopilot.state().armed, autopilot.system(),
           line_.fault(), autopilot.refusal(), bridge_.cause());
  if (seen == seen_) return;
  seen_ = seen;
  const std::string line = situation(now);
  if (line == logged_) return;
  logged_ = line;
  spdlog::info("{}", line);
}

std::string MavlinkProcess::situation(Time now) const {
  const StateIn& autopilot = bridge_.autopilot();
  if (!line_.is_open()) return line_.fault();
  if (!autopilot.refusal().empty()) return autopilot.refusal();
  if (!autopilot.connected(now)) return fmt::format("hears no autopilot on {}", config_.line);
  if (!bridge_.cause().empty()) return bridge_.cause();
  return fmt::format("{} is system {}, {}", to_string(config_.bridge.autopilot), autopilot.system(),
                     autopilot.state().armed ? "armed" : "not armed");
}

}  // namespace saker::flight::mavlink
