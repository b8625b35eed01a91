#pragma once

#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include "saker/loop_health_t.hpp"

namespace saker::flight {

/// Times one loop of a process for `_HEALTH`. Used by the loop's own thread.
class LoopMeter {
 public:
  using Steady = std::chrono::steady_clock;

  /// \param miss_ms  a run that begins later than this after its deadline is a miss
  /// \param sampled  the processor's time is taken of one run in so many, times as many: asking the
  ///     kernel for it twice a run took a twentieth of what the bridge costs
  explicit LoopMeter(std::string name, double miss_ms = 5, int sampled = 1)
      : name_(std::move(name)), miss_ms_(miss_ms), sampled_(sampled) {
    took_ms_ = Period().took_ms;
  }

  /// Since the start.
  struct Totals {
    long runs = 0;
    int misses = 0;
    double worst_lateness_ms = std::numeric_limits<double>::quiet_NaN();
    double cpu_s = 0;
  };

  /// One run of the loop; it ends with this object.
  class Run {
   public:
    explicit Run(LoopMeter& meter) : meter_(meter) {}
    Run(const Run&) = delete;
    ~Run() {
      meter_.ran(Steady::now() - begin_,
                 asks_ ? meter_.sampled_ * (thread_seconds() - begin_cpu_s_) : 0);
    }

   private:
    LoopMeter& meter_;
    const Steady::time_point begin_ = Steady::now();
    const bool asks_ = meter_.totals_.runs % meter_.sampled_ == 0;
    const double begin_cpu_s_ = asks_ ? thread_seconds() : 0;
  };

  /// How long after its deadline a run began, where the loop has deadlines.
  void began_late(Steady::duration lateness);

  /// What happened in a period; counts are since the start.
  struct Period {
    Period();  ///< with room for its runs
    double seconds = 0, cpu_s = 0;
    double age_ms = std::numeric_limits<double>::quiet_NaN();
    long drops = 0;
    Totals totals;
    std::vector<double> took_ms;
  };

  /// Ends a period, for a loop that must not wait for memory: `into` gets it, and its memory is
  /// used again.
  void end_period(Steady::duration period, double age_ms, long drops, Period& into);
  /// A period as `_HEALTH` has it; in any thread.
  [[nodiscard]] static loop_health_t health(const std::string& name, const Period& period);

  /// Both in one: what happened since the last call.
  /// \param age_ms of the newest input; NaN: nothing yet
  [[nodiscard]] loop_health_t take_period(Steady::duration period, double age_ms, long drops);

  [[nodiscard]] const Totals& totals() const { return totals_; }

 private:
  [[nodiscard]] static double thread_seconds();
  void ran(Steady::duration took, double cpu_s);

  std::string name_;
  double miss_ms_;
  int sampled_;
  Totals totals_;
  double cpu_s_ = 0;  // of this period, like what follows
  std::vector<double> took_ms_;
};

}  // namespace saker::flight
