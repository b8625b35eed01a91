#include "flight/bus/machine.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/timex.h>
#include <time.h>

#include <algorithm>
#include <cstdint>
#include <fstream>

#include "flight/bus/multicast.h"
#include "saker/core/error.h"
#include "saker/core/time.h"
#include "saker/lidar/udp_receiver.h"

namespace saker::flight {
namespace {

// 64×1024 at 10 Hz: 640 packets a second of 12,608 bytes; a quarter of a second may wait.
constexpr int kLidarBytesPerSecond = 640 * 12608;
constexpr int kLidarNeed = kLidarBytesPerSecond / 4;
constexpr rlim_t kLockedNeed = rlim_t{1} << 30;  // the executive with its network's weights: 0.4 GB
constexpr rlim_t kPriorityNeed = 70;             // the executive's safety loop, its highest
constexpr double kMostDrift_ppm = 100;  // of a healthy crystal; a scan's tenth of a second: 10 ns
constexpr Time kWakeUpPeriod = 5'000'000;
constexpr int kWakeUps = 40;
constexpr Time kLatest = 5'000'000;  // a deadline of the guidance may be missed by this much

constexpr int kCapIpcLock = 14;  // linux/capability.h
constexpr int kCapSysNice = 23;

bool has_capability(int bit) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "CapEff:") continue;
    std::uint64_t mask = 0;
    status >> std::hex >> mask;
    return mask >> bit & 1;
  }
  return false;
}

rlim_t limit_of(__rlimit_resource resource) {
  rlimit limit{};
  return ::getrlimit(resource, &limit) == 0 ? limit.rlim_cur : 0;
}

Finding check_locked_memory() {
  const rlim_t limit = limit_of(RLIMIT_MEMLOCK);
  if (has_capability(kCapIpcLock) || limit == RLIM_INFINITY || limit >= kLockedNeed) {
    return {"locked memory", Weight::fine, "enough", ""};
  }
  return {"locked memory", Weight::drawback,
          fmt::format("limit {} MB, {} MB needed to keep pages from being swapped out", limit >> 20,
                      kLockedNeed >> 20),
          "echo '* - memlock unlimited' >> /etc/security/limits.d/saker.conf; log in again"};
}

Finding check_priority() {
  const rlim_t limit = limit_of(RLIMIT_RTPRIO);
  if (has_capability(kCapSysNice) || limit >= kPriorityNeed) {
    return {"real-time priority", Weight::fine, "allowed", ""};
  }
  return {"real-time priority", Weight::drawback,
          fmt::format("limit {}, {} needed for guidance and safety", limit, kPriorityNeed),
          fmt::format("echo '* - rtprio {}' >> /etc/security/limits.d/saker.conf; log in again",
                      kPriorityNeed)};
}

Finding check_system_clock() {
  timex state{};
  const int status = ::adjtimex(&state);
  const double drift_ppm = static_cast<double>(state.freq) / 65536;  // man adjtimex: 2^-16 ppm
  const std::string drift = fmt::format("drift {:+.1f} ppm", drift_ppm);
  if (status < 0 || status == TIME_ERROR || (state.status & STA_UNSYNC)) {
    return {"system clock", Weight::drawback,
            "not synchronised, " + drift + ": stamps of two machines do not compare",
            "apt-get install -y chrony; chronyc waitsync 30 0.01"};
  }
  if (std::abs(drift_ppm) > kMostDrift_ppm) {
    return {"system clock", Weight::drawback,
            fmt::format("{}, at most {:.0f} of a healthy crystal", drift, kMostDrift_ppm),
            "chronyc tracking"};
  }
  return {"system clock", Weight::fine, "synchronised, " + drift, ""};
}

Time monotonic_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kNanosecondsPerSecond + now.tv_nsec;
}

/// Lateness of the worst of some absolute deadlines.
Time worst_lateness() {
  Time worst = 0;
  Time deadline = monotonic_now();
  for (int i = 0; i < kWakeUps; ++i) {
    deadline += kWakeUpPeriod;
    const timespec at{deadline / kNanosecondsPerSecond, deadline % kNanosecondsPerSecond};
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
    worst = std::max(worst, monotonic_now() - deadline);
  }
  return worst;
}

Finding check_monotonic_clock() {
  timespec step{};
  ::clock_getres(CLOCK_MONOTONIC, &step);
  const Time late = worst_lateness();
  const std::string found = fmt::format("step {} ns, worst of {} wake-ups {:.2f} ms late",
                                        step.tv_nsec, kWakeUps, to_seconds(late) * 1e3);
  if (step.tv_sec > 0 || step.tv_nsec > 1000) {
    return {"monotonic clock", Weight::grounding, found + ", expected a step of at most 1 us",
            "echo tsc > /sys/devices/system/clocksource/clocksource0/current_clocksource"};
  }
  if (late > kLatest) {
    return {"monotonic clock", Weight::drawback, found + ": the machine is busy",
            "ps -eo pcpu,pid,comm --sort=-pcpu | head"};
  }
  return {"monotonic clock", Weight::fine, found, ""};
}

}  // namespace

Finding check_multicast(const std::string& subject, const std::string& url) {
  const MulticastGroup group = multicast_group(url);
  const std::string fault = multicast_fault(group);
  if (fault.empty()) return {subject, Weight::fine, group.address + " comes back", ""};
  return {subject, Weight::grounding, group.address + ": " + fault, multicast_remedy(group)};
}

Finding check_receive_buffer(int needed_bytes) {
  const int granted = granted_receive_buffer(needed_bytes);
  const std::string found =
      fmt::format("{} kB granted, {} kB needed", granted / 1024, (needed_bytes + 1023) / 1024);
  if (granted >= needed_bytes) return {"receive buffer", Weight::fine, found, ""};
  return {"receive buffer", Weight::grounding, found,
          fmt::format("sysctl -w net.core.rmem_max={}", needed_bytes)};
}

Finding check_port(int port) {
  const std::string subject = fmt::format("UDP port {}", port);
  try {
    const lidar::UdpReceiver receiver(port);
  } catch (const Error& error) {
    return {subject, Weight::grounding, error.what(), fmt::format("ss -ulpn sport = :{}", port)};
  }
  return {subject, Weight::fine, "free", ""};
}

std::vector<Finding> check_machine(const MachineNeeds& needs) {
  const BusConfig bus = core::checked(needs.bus, "bus");
  std::vector<Finding> findings = {
      check_multicast("multicast route", bus.control_url),
      check_multicast("multicast route of bulk", bus.bulk_url),
      check_receive_buffer(std::max(kLidarNeed, bus.receive_buffer_kb * 1024)),
      check_monotonic_clock(),
      check_system_clock(),
      check_locked_memory(),
      check_priority(),
  };
  for (const int port : needs.lidar_ports) findings.push_back(check_port(port));
  return findings;
}

void require_fit(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    if (finding.weight != Weight::grounding) continue;
    throw Error(finding.subject + ": " + finding.found + ", mend with: " + finding.remedy);
  }
}

}  // namespace saker::flight
