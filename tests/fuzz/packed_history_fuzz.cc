#include <cmath>

#include "fuzz.h"
#include "saker/exchange/packed_history.h"

/// A robot's flight as another one sent it.
namespace saker {

void lidar::fuzz::run(ByteView input) {
  const auto flight = exchange::unpacked(text_of(input));
  if (!flight) return;
  expect(flight->bytes <= input.size() && flight->classes > 0);
  Time before = 0;
  for (const slam::HistoryEntry& entry : flight->history.entries) {
    expect(entry.stamp >= before && entry.T_odom_lidar.matrix().allFinite());
    before = entry.stamp;
    for (const objects::Measurement& measurement : entry.measurements) {
      double sum = 0;
      for (const double p : measurement.class_probability) sum += p;
      expect(std::abs(sum - 1) < 1e-6 && measurement.class_id < flight->classes);
      expect(measurement.covariance.allFinite());
    }
  }
  (void)exchange::packed(flight->history, flight->classes, flight->takeoff);
}

}  // namespace saker
