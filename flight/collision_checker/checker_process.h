#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/bus/scan_messages.h"
#include "flight/process/configuration.h"
#include "flight/process/loop_report.h"
#include "flight/process/sensor_clock.h"
#include "saker/motion/collision_checker.h"

namespace saker::flight {

/// The collision checker on the bus: hears `_SCAN`, `_TRAJECTORY` and `_ODOMETRY` (for the time),
/// says `_VERDICT` (10 Hz, and at once after a scan or a trajectory), `_OCCUPANCY` (2 Hz, while
/// scans come) and `_HEALTH` (1 Hz).
///
/// One thread: handlers keep the newest scan and trajectory, `step` works on them. Of scans that
/// come faster than they can be integrated, the newest counts. Scans whose sequence goes back are
/// of an executive that began anew, in an `odom` of its own: the map begins anew too.
class CheckerProcess {
 public:
  using Steady = std::chrono::steady_clock;

  /// Subscribes to `bus`, which has to outlive this. Throws Error on an invalid value.
  CheckerProcess(const ProcessConfig& config, Bus& bus);

  /// Works on what was heard and says what is due.
  void step(Steady::time_point now);

  /// Until when there is nothing to do, unless something is heard.
  [[nodiscard]] Steady::time_point next_due() const;

  /// What its loops took since the start.
  [[nodiscard]] std::vector<LoopRow> loops() const;

 private:
  /// What is due again and again, never made up for.
  struct Timer {
    Steady::duration period;
    Steady::time_point next = {};

    /// Whether it is due; sets the next time then.
    bool due(Steady::time_point now, LoopMeter* meter = nullptr);
  };

  struct Counters {
    long scans = 0;
    long scans_replaced = 0;  ///< by a newer one before they were integrated
    long scans_refused = 0;
    long trajectories_refused = 0;
    long nodes_dropped = 0;
    long restarts = 0;
    long not_sent = 0;
  };

  void subscribe();
  bool hear(const scan_t& chunk);
  bool hear(const trajectory_t& message);
  void integrate();
  void begin_anew();
  void say_verdict(Time now);
  void say_occupancy();
  void say_health(Steady::time_point now);
  template <class Message>
  void publish(const Message& message) {
    counters_.not_sent += !bus_.publish(message);
  }

  motion::CollisionCheckerConfig config_;
  motion::ClearanceConfig clearance_;
  Bus& bus_;
  std::optional<motion::CollisionChecker> checker_;
  SensorClock clock_;
  ScanJoiner joiner_;
  std::optional<autonomy::RegisteredScan> scan_;
  std::optional<motion::Trajectory> heard_trajectory_;
  std::optional<scan_t> newest_chunk_;  // without its points
  std::int32_t sequence_ = 0;           // of blocks
  Time said_stamp_ = 0;                 // of the last block
  bool urgent_ = false;                 // a verdict is
  Timer verdict_timer_, occupancy_timer_, health_timer_;
  LoopMeter scan_meter_{"scan"}, verdict_meter_{"verdict"}, occupancy_meter_{"occupancy"};
  Counters counters_;
};

}  // namespace saker::flight
