#include "flight/process/loop_meter.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "saker/core/statistics.h"

namespace saker::flight {
namespace {

constexpr std::size_t kMostRuns = 4096;  // of a period; those after it are not in the median

double milliseconds(LoopMeter::Steady::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

double LoopMeter::thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void LoopMeter::ran(Steady::duration took, double cpu_s) {
  cpu_s_ += cpu_s;
  totals_.cpu_s += cpu_s;
  ++totals_.runs;
  if (took_ms_.size() < kMostRuns) took_ms_.push_back(milliseconds(took));
}

void LoopMeter::began_late(Steady::duration lateness) {
  const double late_ms = milliseconds(lateness);
  totals_.worst_lateness_ms = std::fmax(totals_.worst_lateness_ms, late_ms);
  totals_.misses += late_ms > miss_ms_;
}

loop_health_t LoopMeter::take_period(Steady::duration period, double age_ms, long drops) {
  const double seconds = std::max(1e-3, milliseconds(period) * 1e-3);
  loop_health_t health{};
  health.name = name_;
  health.rate_hz = static_cast<float>(static_cast<double>(took_ms_.size()) / seconds);
  health.misses = totals_.misses;
  health.worst_lateness_ms = static_cast<float>(totals_.worst_lateness_ms);
  health.age_ms = static_cast<float>(age_ms);
  health.median_ms = static_cast<float>(core::median(took_ms_));
  health.p95_ms = static_cast<float>(core::percentile(took_ms_, 0.95));
  health.cpu = static_cast<float>(cpu_s_ / seconds);
  health.drops = static_cast<std::int32_t>(drops);
  took_ms_.clear();
  cpu_s_ = 0;
  return health;
}

}  // namespace saker::flight
