#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/mavlink/bridge.h"
#include "flight/mavlink/latency.h"
#include "flight/mavlink/line.h"
#include "flight/process/loop_meter.h"
#include "flight/process/loop_report.h"

namespace saker::flight::mavlink {

/// The bridge on the bus and on its line: hears `_ODOMETRY`, `_SETPOINT` and `_COMMAND`, says
/// `_STATE` (50 Hz, while the autopilot speaks), `_COMMAND_ACK` and `_HEALTH` (1 Hz).
///
/// One thread: handlers pass on what they hear at once, `step` does what is due.
class MavlinkProcess {
 public:
  using Steady = std::chrono::steady_clock;

  /// Subscribes to `bus`, which has to outlive this. Throws Error on an invalid value.
  MavlinkProcess(const MavlinkConfig& config, Bus& bus);

  /// Reads the line, does and says what is due.
  void step();

  /// Waits for the bus and the line, then does what is due. Odometry that goes on is heard at once
  /// and never one that lay there, the rest of the bus after kRest: most of what the bridge costs
  /// is being woken. False: the network is gone.
  [[nodiscard]] bool serve();

  /// How long odometry took and what the process took, in one line for the log.
  [[nodiscard]] std::string cost_text() const;

  [[nodiscard]] const Bridge& bridge() const { return bridge_; }
  /// From hearing odometry to ODOMETRY on the line.
  [[nodiscard]] const LatencyHistogram& added() const { return added_; }

 private:
  static constexpr double kMiss_ms = 5;
  static constexpr int kSampled = 7;

  void subscribe();
  int drain();
  void pass_on(const VehicleOdometry& odometry);
  void read_line();
  void write_line();
  void say_state(Time now);
  void say_health(Time now);
  void log_changes(Time now);
  [[nodiscard]] std::string situation(Time now) const;

  MavlinkConfig config_;
  Bus& bus_;
  Bridge bridge_;
  Line line_;
  Time next_state_ = 0, next_health_ = 0;
  Time last_bytes_ = 0;  // when the line was not silent
  Time bus_heard_ = 0;
  bool waited_ = false;  // what is handled now came in a rest
  bool settled_ = true;
  LoopMeter line_meter_{"line", kMiss_ms, kSampled},
      odometry_meter_{"odometry", kMiss_ms, kSampled};
  const Steady::time_point begun_ = Steady::now();
  const double begun_cpu_s_ = process_seconds();  // without what was read before
  LatencyHistogram added_;
  LatencyHistogram since_stamp_;  // from the stamp of odometry to the line
  long not_sent_ = 0;
  // What `situation` is made of, when it was looked at last; and what was logged last.
  std::tuple<bool, bool, bool, int, std::string, std::string, std::string> seen_;
  std::string logged_;
};

}  // namespace saker::flight::mavlink
