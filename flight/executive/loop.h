#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>

#include "flight/bus/mailbox.h"
#include "flight/process/loop_meter.h"
#include "saker/core/text.h"

namespace saker::flight {

/// What a loop says of itself after a run.
struct LoopStatus {
  double age_ms = std::numeric_limits<double>::quiet_NaN();  ///< of its newest input
  long drops = 0;                                            ///< of the queues that it reads
};

/// What went wrong in a loop.
struct LoopFaults {
  long throws = 0;  ///< runs that ended by an exception
  bool off = false;
  core::Text last{};  ///< what the last exception said
};

/// A thread that runs at absolute deadlines (clock_nanosleep, TIMER_ABSTIME). A deadline that was
/// missed is counted, never made up for.
///
/// A run that throws is abandoned and counted; the next one begins at its deadline from what is on
/// the blackboard then. After `most_throws` in a row the body is not called again: a stage whose
/// state is broken costs time and memory and makes nothing, and safety sees by the age of what it
/// made that it is gone. The loop itself allocates nothing after its constructor.
class Loop {
 public:
  using Body = std::function<LoopStatus()>;
  using Steady = std::chrono::steady_clock;

  /// \param priority  of SCHED_FIFO, 1 … 99; 0: an ordinary thread
  /// \param most_throws  in a row, then it is switched off; 0: it is tried as long as it runs
  Loop(std::string name, double rate_hz, int priority, Body body, int most_throws = 0);
  ~Loop();  ///< stops, after the run under way
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  void start();
  /// After the run under way, which is waited for so long; without a limit as long as it takes.
  /// \return whether the thread ended; where it did not, what it uses must not be destroyed
  bool stop(Steady::duration longest = Steady::duration::max());
  /// Does not wait.
  void ask_to_stop() { stopping_ = true; }

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Of the last second; null before the first one. One thread may call it.
  [[nodiscard]] std::shared_ptr<const loop_health_t> health();
  /// Since the start; to be called when it has stopped.
  [[nodiscard]] const LoopMeter::Totals& totals() const { return meter_.totals(); }
  /// Whether no run ended for ten periods, and for a second at least. Any thread.
  [[nodiscard]] bool hangs(Steady::time_point now) const;
  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] LoopFaults faults() const;
  /// Whether its priority was granted; true where it asked for none.
  [[nodiscard]] bool priority_granted() const { return granted_; }

 private:
  void work();
  [[nodiscard]] LoopStatus run();
  void threw(const char* what);
  void report(const LoopStatus& status);

  const std::string name_;
  const Steady::duration period_;
  const int priority_;
  const Body body_;
  const int most_throws_;
  LoopMeter meter_;
  Steady::time_point reported_;

  // Three periods go around: the one that just ended, the newest one, and the one that is read.
  LoopMeter::Period ended_period_, newest_period_, read_period_;
  mutable PriorityMutex newest_mutex_;
  bool fresh_ = false;
  std::shared_ptr<const loop_health_t> health_;

  int throws_in_row_ = 0;
  std::atomic<long> throws_ = 0;
  std::atomic<bool> off_ = false;
  ValueBox<core::Text> last_throw_;

  std::atomic<Steady::time_point> ended_ = Steady::time_point{};  // the last run
  std::atomic<bool> running_ = false, stopping_ = false;
  std::atomic<bool> granted_ = true;
  std::thread thread_;
};

/// Keeps the process's memory from being swapped out; empty, or why it cannot.
[[nodiscard]] std::string lock_memory();

}  // namespace saker::flight
