#include "flight/executive/loop.h"

#include <pthread.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <exception>
#include <mutex>
#include <utility>

namespace saker::flight {
namespace {

using Steady = std::chrono::steady_clock;

constexpr int kMostSilentPeriods = 10;  // as many runs that a busy machine may swallow
constexpr Steady::duration kLeastSilence = std::chrono::seconds(1);
constexpr Steady::duration kEndLook = std::chrono::milliseconds(2);  // whether it ended

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

Loop::Loop(std::string name, double rate_hz, int priority, Body body, int most_throws)
    : name_(std::move(name)),
      period_(
          std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(1 / rate_hz))),
      priority_(priority),
      body_(std::move(body)),
      most_throws_(most_throws),
      meter_(name_) {}

Loop::~Loop() { stop(); }

void Loop::start() {
  ended_ = Steady::now();
  running_ = true;
  thread_ = std::thread([this] { work(); });
  pthread_setname_np(thread_.native_handle(), name_.substr(0, 15).c_str());
  if (priority_ == 0) return;
  sched_param parameters{};
  parameters.sched_priority = priority_;
  granted_ = pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &parameters) == 0;
}

bool Loop::stop(Steady::duration longest) {
  stopping_ = true;
  if (!thread_.joinable()) return true;
  if (longest != Steady::duration::max()) {
    for (const auto end = Steady::now() + longest; running_;) {
      if (Steady::now() > end) return false;
      std::this_thread::sleep_for(kEndLook);
    }
  }
  thread_.join();
  return true;
}

bool Loop::hangs(Steady::time_point now) const {
  return running_ && now - ended_.load() > std::max(kLeastSilence, kMostSilentPeriods * period_);
}

void Loop::work() {
  Steady::time_point next = reported_ = Steady::now();
  while (!stopping_) {
    sleep_until(next);
    meter_.began_late(Steady::now() - next);
    const LoopStatus status = run();
    ended_ = Steady::now();
    report(status);
    next += period_;
    const Steady::duration behind = Steady::now() - next;
    if (behind <= period_) continue;
    meter_.began_late(behind);  // the deadline that the run swallowed
    next += behind / period_ * period_;
  }
  running_ = false;
}

LoopStatus Loop::run() {
  if (off_) return {};
  try {
    const LoopMeter::Run run(meter_);
    const LoopStatus status = body_();
    throws_in_row_ = 0;
    return status;
  } catch (const std::exception& error) {
    threw(error.what());
  } catch (...) {
    threw("no std::exception");
  }
  return {};
}

void Loop::threw(const char* what) {
  last_throw_.put(what);
  ++throws_;
  off_ = ++throws_in_row_ == most_throws_;
}

LoopFaults Loop::faults() const {
  return {throws_, off_, last_throw_.latest().value_or(core::Text())};
}

void Loop::report(const LoopStatus& status) {
  const Steady::time_point now = Steady::now();
  if (now - reported_ < std::chrono::seconds(1)) return;
  meter_.end_period(now - reported_, status.age_ms, status.drops, ended_period_);
  reported_ = now;
  const std::lock_guard lock(newest_mutex_);
  std::swap(ended_period_, newest_period_);
  fresh_ = true;
}

std::shared_ptr<const loop_health_t> Loop::health() {
  {
    const std::lock_guard lock(newest_mutex_);
    if (!std::exchange(fresh_, false)) return health_;
    std::swap(newest_period_, read_period_);
  }
  health_ = std::make_shared<const loop_health_t>(LoopMeter::health(name_, read_period_));
  return health_;
}

std::string lock_memory() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) return "";
  return std::strerror(errno);
}

}  // namespace saker::flight
