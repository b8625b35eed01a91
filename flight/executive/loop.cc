#include "flight/executive/loop.h"

#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

namespace saker::flight {
namespace {

using Steady = std::chrono::steady_clock;

constexpr int kMostSilentPeriods = 10;  // as many runs that a busy machine may swallow
constexpr Steady::duration kLeastSilence = std::chrono::seconds(1);

/// steady_clock is CLOCK_MONOTONIC.
void sleep_until(Steady::time_point time) {
  constexpr long kSecond_ns = 1'000'000'000;
  const long ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
  const timespec deadline{ns / kSecond_ns, ns % kSecond_ns};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace

Loop::Loop(std::string name, double rate_hz, int priority, Body body)
    : name_(std::move(name)),
      period_(
          std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(1 / rate_hz))),
      priority_(priority),
      body_(std::move(body)),
      meter_(name_) {}

Loop::~Loop() { stop(); }

void Loop::start() {
  ended_ = Steady::now();
  thread_ = std::thread([this] { work(); });
  pthread_setname_np(thread_.native_handle(), name_.substr(0, 15).c_str());
  if (priority_ == 0) return;
  sched_param parameters{};
  parameters.sched_priority = priority_;
  granted_ = pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &parameters) == 0;
}

void Loop::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

bool Loop::hangs(Steady::time_point now) const {
  return thread_.joinable() &&
         now - ended_.load() > std::max(kLeastSilence, kMostSilentPeriods * period_);
}

void Loop::work() {
  Steady::time_point next = reported_ = Steady::now();
  while (!stopping_) {
    sleep_until(next);
    meter_.began_late(Steady::now() - next);
    LoopStatus status;
    {
      const LoopMeter::Run run(meter_);
      status = body_();
    }
    ended_ = Steady::now();
    report(status);
    next += period_;
    const Steady::duration behind = Steady::now() - next;
    if (behind <= period_) continue;
    meter_.began_late(behind);  // the deadline that the run swallowed
    next += behind / period_ * period_;
  }
}

void Loop::report(const LoopStatus& status) {
  const Steady::time_point now = Steady::now();
  if (now - reported_ < std::chrono::seconds(1)) return;
  health_.put(meter_.take_period(now - reported_, status.age_ms, status.drops));
  reported_ = now;
}

std::string lock_memory() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) return "";
  return std::strerror(errno);
}

}  // namespace saker::flight
