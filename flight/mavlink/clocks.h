#pragma once

#include <cstdint>
#include <optional>

#include "mavlink/messages.h"
#include "saker/core/time.h"

/// Three clocks: the sensor's (all stamps of ours), the host's (monotonic, in which the bridge
/// lives and which is the time of what it sends) and the autopilot's (since its boot).
///
/// Reads stamps with the host's time at which they came; reads no clock. Nanoseconds.
namespace saker::flight::mavlink {

/// Sensor's clock → host's: of stamps that come late by different times the least late one counts;
/// it is forgotten slowly, so that a drift of the two clocks is followed, and at once where all
/// stamps of `kWindow` came later by `kLate`: the sensor's clock was set back, or stood still.
///
/// The mapped time is late by what the least late stamp was late by: what the odometry took at its
/// fastest. That is part of the latency that the autopilot is told (EK3's VISO_DELAY_MS,
/// EKF2_EV_DELAY).
class SensorToHost {
 public:
  static constexpr Time kAnew = kNanosecondsPerSecond;  ///< back by more: a clock that began anew
  static constexpr Time kWindow = 2 * kNanosecondsPerSecond;
  static constexpr Time kLate = kNanosecondsPerSecond / 50;
  static constexpr double kForget = 50e-6;  ///< s/s; quartz drifts less

  void hear(Time sensor_stamp, Time host_now);

  /// Nothing before the first stamp.
  [[nodiscard]] std::optional<Time> host(Time sensor_stamp) const;
  [[nodiscard]] std::optional<Time> sensor(Time host_time) const;

 private:
  std::optional<Time> offset_;  // host − sensor
  Time heard_ = 0;              // host's, last
  std::optional<Time> recent_;  // the least of the window …
  Time window_began_ = 0;       // … that began then
};

/// Autopilot's clock → host's by TIMESYNC: we ask, it answers with its time.
///
/// Its time lies between our question and our hearing the answer; halfway is off by half of the
/// round trip at most. The exchange with the smallest bound counts, which grows by the drift.
class TimeSync {
 public:
  struct Offset {
    Time host_minus_autopilot = 0;
    Time bound = 0;  ///< the error is smaller
  };

  static constexpr Time kPeriod = kNanosecondsPerSecond;             ///< between questions
  static constexpr Time kMostRoundTrip = kNanosecondsPerSecond / 4;  ///< longer ones are ignored
  static constexpr double kDrift = 50e-6;                            ///< s/s, of the bound

  /// The next question, when it is due.
  [[nodiscard]] std::optional<Timesync> question(Time host_now);

  /// The answer to the autopilot's question, in the host's clock; nothing where it is no question.
  [[nodiscard]] static std::optional<Timesync> answer(const Timesync& question, Time host_now);

  /// An answer to a question of ours. False where it is none: not asked, too late, of the future.
  bool hear(const Timesync& answer, Time host_now);

  /// Nothing before the first answer.
  [[nodiscard]] std::optional<Offset> offset(Time host_now) const;

  /// How often the autopilot's clock began anew: it rebooted.
  [[nodiscard]] int restarts() const { return restarts_; }
  /// Questions of the autopilot that were answered: PX4 trusts stamps after 500.
  [[nodiscard]] long answered() const { return answered_; }
  void count_answered() { ++answered_; }

 private:
  std::optional<Time> asked_;
  std::optional<Offset> best_;
  Time measured_ = 0;        // host's time of the best
  Time autopilot_time_ = 0;  // newest
  int restarts_ = 0;
  long answered_ = 0;
};

}  // namespace saker::flight::mavlink
