#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "saker/core/time.h"

namespace saker::autonomy {

/// What the battery is good for — reads the charge that the flight controller says (50 Hz), makes
/// the charge that is left and what the way home takes of it (for the safety ladder).
///
/// Charge is a share, 0 … 1; a value that is not finite or out of it is not known. The drain is
/// measured in flight, over the last two minutes, about a nominal one that counts as a minute: an
/// autopilot says whole percents. Twice the nominal is the most that is believed: a charge that
/// falls from one moment to the next is a worse battery, no faster drain. A charge that is no
/// longer said falls by the drain. No clock; allocates nothing.
class BatteryWatch {
 public:
  /// \param flight_s  that a full battery lasts
  explicit BatteryWatch(double flight_s) : nominal_per_s_(1 / flight_s) {}

  [[nodiscard]] static bool is_known(double share) { return share >= 0 && share <= 1; }

  /// Time order. On the ground it forgets the drain, and a charge that is not known.
  void update(Time now, double said_share, bool flying);

  /// 0 … 1; NaN where it was never known in this flight.
  [[nodiscard]] double share(Time now) const;
  /// s that the charge has not been known for; 0 on the ground.
  [[nodiscard]] double unknown_s(Time now) const;
  /// Share a second.
  [[nodiscard]] double drain_per_s() const;

 private:
  static constexpr double kEvery_s = 5;        // between two samples
  static constexpr std::size_t kSamples = 24;  // two minutes
  static constexpr double kNominal_s = 60;     // weight of the nominal drain
  static constexpr double kMostTimes = 2;      // the nominal drain
  struct Sample {
    Time stamp = 0;
    double share = NAN;
  };

  void keep(const Sample& sample);

  double nominal_per_s_;
  std::array<Sample, kSamples> samples_;  // a ring, of this flight
  std::size_t count_ = 0;                 // that were ever kept
  Sample known_;                          // the last one
  Time flying_since_ = 0;                 // 0: on the ground
};

}  // namespace saker::autonomy
