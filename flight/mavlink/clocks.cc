#include "flight/mavlink/clocks.h"

#include <algorithm>
#include <cmath>

namespace saker::flight::mavlink {
namespace {

constexpr Time kMostTime =
    4'000'000'000 * kNanosecondsPerSecond;  // 126 years, since whatever began

Time drifted(Time span, double rate) { return static_cast<Time>(static_cast<double>(span) * rate); }

bool in_range(Time time) { return time > 0 && time < kMostTime; }

}  // namespace

void SensorToHost::hear(Time sensor_stamp, Time host_now) {
  if (!in_range(sensor_stamp) || !in_range(host_now)) return;
  const Time offset = host_now - sensor_stamp;
  const bool anew = !offset_ || offset > *offset_ + kAnew;
  const Time forgotten = anew ? 0 : drifted(host_now - heard_, kForget);
  offset_ = anew ? offset : std::min(offset, *offset_ + forgotten);
  heard_ = host_now;
  recent_ = recent_ && !anew ? std::min(*recent_, offset) : offset;
  if (!anew && host_now - window_began_ < kWindow) return;
  if (*recent_ > *offset_ + kLate) offset_ = recent_;
  recent_.reset();
  window_began_ = host_now;
}

std::optional<Time> SensorToHost::host(Time sensor_stamp) const {
  if (!offset_ || !in_range(sensor_stamp)) return std::nullopt;
  return sensor_stamp + *offset_;
}

std::optional<Time> SensorToHost::sensor(Time host_time) const {
  if (!offset_ || !in_range(host_time)) return std::nullopt;
  return host_time - *offset_;
}

std::optional<Timesync> TimeSync::question(Time host_now) {
  if (asked_ && host_now - *asked_ < kPeriod) return std::nullopt;
  asked_ = host_now;
  Timesync message;
  message.ts1 = host_now;
  return message;
}

std::optional<Timesync> TimeSync::answer(const Timesync& question, Time host_now) {
  if (question.tc1 != 0 || host_now <= 0) return std::nullopt;
  Timesync message = question;
  message.tc1 = host_now;
  message.target_system = 0;
  message.target_component = 0;
  return message;
}

bool TimeSync::hear(const Timesync& answer, Time host_now) {
  if (!asked_ || answer.ts1 != *asked_ || !in_range(answer.tc1)) return false;
  const Time round_trip = host_now - answer.ts1;
  if (round_trip < 0 || round_trip > kMostRoundTrip) return false;
  const Offset fresh{answer.ts1 + round_trip / 2 - answer.tc1, round_trip / 2};
  const std::optional<Offset> known = offset(host_now);
  const bool anew = answer.tc1 + kNanosecondsPerSecond < autopilot_time_;
  restarts_ += anew;
  autopilot_time_ = answer.tc1;
  const bool apart = known && std::abs(known->host_minus_autopilot - fresh.host_minus_autopilot) >
                                  known->bound + fresh.bound;
  if (!known || anew || apart || fresh.bound <= known->bound) {
    best_ = fresh;
    measured_ = host_now;
  }
  return true;
}

std::optional<TimeSync::Offset> TimeSync::offset(Time host_now) const {
  if (!best_) return std::nullopt;
  return Offset{best_->host_minus_autopilot,
                best_->bound + drifted(std::max<Time>(host_now - measured_, 0), kDrift)};
}

}  // namespace saker::flight::mavlink
