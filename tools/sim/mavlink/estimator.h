#pragma once

#include <optional>

#include "flight/mavlink/clocks.h"
#include "saker/core/vehicle.h"
#include "tools/sim/mavlink/quirks.h"

/// The autopilot's estimator as the line sees it: origin, odometry taken or not, and what it says
/// of itself. The estimate itself is the inner loops'.
///
/// Reads ODOMETRY, TIMESYNC and the origin, with the autopilot's time since boot at which they
/// came. Makes odometry of the inner loops in our frames and the autopilot's clock.
namespace saker::tools {

class EstimatorModel {
 public:
  /// \param quirks  have to outlive this
  explicit EstimatorModel(const Quirks& quirks) : quirks_(quirks) {}

  /// False where it is forgotten: too early, or there is one.
  bool set_origin(Time now);
  /// Nothing where it is not taken.
  [[nodiscard]] std::optional<VehicleOdometry> hear(const flight::mavlink::Odometry& odometry,
                                                    Time now);
  /// Its own question to the other end, when it is due; and the answer to it.
  [[nodiscard]] std::optional<flight::mavlink::Timesync> question(Time now);
  void hear(const flight::mavlink::Timesync& answer, Time now);

  [[nodiscard]] bool runs(Time now) const { return to_seconds(now) > quirks_.estimator_s; }
  [[nodiscard]] bool origin_set() const { return origin_at_.has_value(); }
  /// There is a place by the origin.
  [[nodiscard]] bool has_origin(Time now) const;
  /// Odometry is used.
  [[nodiscard]] bool aided(Time now) const { return seconds_without(now) < 1; }
  /// It was, and is not any more for so long that the autopilot lands.
  [[nodiscard]] bool lost(Time now) const;
  [[nodiscard]] std::uint16_t flags(Time now) const;
  /// A field of ODOMETRY was no number.
  [[nodiscard]] bool saw_nan() const { return saw_nan_; }

 private:
  [[nodiscard]] double seconds_without(Time now) const;
  [[nodiscard]] bool acceptable(const flight::mavlink::Odometry& odometry, Time now);
  [[nodiscard]] Time own_time(std::uint64_t microseconds, Time now);

  const Quirks& quirks_;
  flight::mavlink::SensorToHost stamps_;  // the other end's clock → ours, by the least late
  std::optional<Time> origin_at_;
  std::optional<Time> heard_at_;  // any odometry that is acceptable
  std::optional<Time> taken_at_;
  Time asked_at_ = 0;
  Time their_offset_ = 0;  // ours − theirs, by TIMESYNC
  int exchanges_ = 0;
  bool saw_nan_ = false;
};

}  // namespace saker::tools
