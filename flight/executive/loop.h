#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <thread>

#include "flight/bus/mailbox.h"
#include "flight/process/loop_meter.h"

namespace saker::flight {

/// What a loop says of itself after a run.
struct LoopStatus {
  double age_ms = std::numeric_limits<double>::quiet_NaN();  ///< of its newest input
  long drops = 0;                                            ///< of the queues that it reads
};

/// A thread that runs at absolute deadlines (clock_nanosleep, TIMER_ABSTIME). A deadline that was
/// missed is counted, never made up for.
class Loop {
 public:
  using Body = std::function<LoopStatus()>;
  using Steady = std::chrono::steady_clock;

  /// \param priority  of SCHED_FIFO, 1 … 99; 0: an ordinary thread
  Loop(std::string name, double rate_hz, int priority, Body body);
  ~Loop();  ///< stops
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void start();
  void stop();  ///< after the run under way

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Of the last second.
  [[nodiscard]] std::shared_ptr<const loop_health_t> health() const { return health_.latest(); }
  /// Since the start; to be called when it has stopped.
  [[nodiscard]] const LoopMeter::Totals& totals() const { return meter_.totals(); }
  /// Whether no run ended for ten periods, and for a second at least. To be called by who starts
  /// it.
  [[nodiscard]] bool hangs(Steady::time_point now) const;
  /// Whether its priority was granted; true where it asked for none.
  [[nodiscard]] bool priority_granted() const { return granted_; }

 private:
  void work();
  void report(const LoopStatus& status);

  const std::string name_;
  const Steady::duration period_;
  const int priority_;
  const Body body_;
  LoopMeter meter_;
  Mailbox<loop_health_t> health_;
  Steady::time_point reported_;
  std::atomic<Steady::time_point> ended_ = Steady::time_point{};  // the last run
  std::atomic<bool> stopping_ = false;
  std::atomic<bool> granted_ = true;
  std::thread thread_;
};

/// Keeps the process's memory from being swapped out; empty, or why it cannot.
[[nodiscard]] std::string lock_memory();

}  // namespace saker::flight
