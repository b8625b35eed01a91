#pragma once

#include "saker/core/time.h"

namespace saker::lidar {

/// Times of a spinning sensor's packets on the recording's clock.
///
/// A Velodyne counts from the full hour, of an unknown hour; a Hesai from 1970, where somebody set
/// its clock. Where the sensor's clock is within a second of the recording's its own times count;
/// else the first packet gets its time of reception and the sensor's clock counts on from there. A
/// sensor's clock that steps against the reception by half a second is taken back, and counted;
/// where the reception alone steps, the sensor's goes on.
class SpinningClock {
 public:
  /// \param sensor    ns, by the packet
  /// \param period    ns after which `sensor` begins anew; 0: never
  /// \param received  by the recording; 0: not known
  [[nodiscard]] Time time(Time sensor, Time period, Time received);

  [[nodiscard]] int steps() const { return steps_; }

 private:
  [[nodiscard]] Time first(Time sensor, Time period, Time received) const;

  bool begun_ = false;
  Time sensor_ = 0, received_ = 0;  // of the last packet
  Time now_ = 0;
  int steps_ = 0;
};

}  // namespace saker::lidar
