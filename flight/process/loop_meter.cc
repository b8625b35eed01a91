#include "flight/process/loop_meter.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "saker/core/statistics.h"

namespace saker::flight {
namespace {

constexpr std::size_t kMostRuns = 4096;  // of a period; those after it are not in the median
constexpr std::size_t kRoom = 512;       // from the start: more than a second of the fastest loop

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

LoopMeter::Period::Period() { took_ms.reserve(kRoom); }

void LoopMeter::end_period(Steady::duration period, double age_ms, long drops, Period& into) {
  into.seconds = std::max(1e-3, milliseconds(period) * 1e-3);
  into.cpu_s = std::exchange(cpu_s_, 0);
  into.age_ms = age_ms;
  into.drops = drops;
  into.totals = totals_;
  into.took_ms.swap(took_ms_);
  took_ms_.clear();
}

loop_health_t LoopMeter::health(const std::string& name, const Period& period) {
  loop_health_t health{};
  health.name = name;
  health.rate_hz = static_cast<float>(static_cast<double>(period.took_ms.size()) / period.seconds);
  health.misses = period.totals.misses;
  health.worst_lateness_ms = static_cast<float>(period.totals.worst_lateness_ms);
  health.age_ms = static_cast<float>(period.age_ms);
  health.median_ms = static_cast<float>(core::median(period.took_ms));
  health.p95_ms = static_cast<float>(core::percentile(period.took_ms, 0.95));
  health.cpu = static_cast<float>(period.cpu_s / period.seconds);
  health.drops = static_cast<std::int32_t>(period.drops);
  return health;
}

loop_health_t LoopMeter::take_period(Steady::duration period, double age_ms, long drops) {
  Period ended;
  end_period(period, age_ms, drops, ended);
  return health(name_, ended);
}

}  // namespace saker::flight
