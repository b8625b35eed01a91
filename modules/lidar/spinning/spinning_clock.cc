#include "saker/lidar/spinning/spinning_clock.h"

#include <cmath>
#include <limits>

namespace saker::lidar {
namespace {

constexpr double kSynchronous = 1;   // s between the sensor's clock and the recording's
constexpr double kStep = 0.5;        // s of the one against the other
constexpr double kNextPacket = 0.2;  // s; packets come some milliseconds apart
constexpr Time kFarthest = std::numeric_limits<Time>::max() / 4;

/// Times are whatever bytes say: sums and differences stay inside the type.
Time bounded(Time time) { return time < -kFarthest || time > kFarthest ? 0 : time; }

/// The one of a, a ± period … that is nearest to 0.
Time nearest(Time a, Time period) {
  if (period == 0) return a;
  return a - period * static_cast<Time>(
                          std::llround(static_cast<double>(a) / static_cast<double>(period)));
}

}  // namespace

Time SpinningClock::first(Time sensor, Time period, Time received) const {
  if (received == 0) return sensor;
  const Time own = received + nearest(sensor - received, period);
  return std::abs(to_seconds(own - received)) < kSynchronous ? own : received;
}

Time SpinningClock::time(Time sensor, Time period, Time received) {
  sensor = bounded(sensor);
  received = bounded(received);
  if (!begun_) {
    now_ = first(sensor, period, received);
  } else {
    Time passed = nearest(sensor - sensor_, period);
    const Time waited = received - received_;
    const bool timed = received != 0 && received_ != 0;
    const bool plausible = passed >= 0 && to_seconds(passed) < kNextPacket;
    if (timed && !plausible && std::abs(to_seconds(passed) - to_seconds(waited)) > kStep) {
      passed = waited;
      ++steps_;
    }
    now_ = bounded(now_ + passed);
  }
  begun_ = true;
  sensor_ = sensor;
  received_ = received;
  return now_;
}

}  // namespace saker::lidar
