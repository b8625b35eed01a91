#pragma once

#include <cmath>
#include <string>

#include "saker/core/progress.h"

/// What a person at a terminal sees of a flight.
namespace saker::flight {

/// NaN: not known yet.
struct FlightStatus {
  std::string phase{};
  int target = 0, targets = 0;  ///< the how many-th of how many; 0 targets: none is known
  double height_m = NAN;        ///< above where it was armed
  double battery_share = NAN;   ///< 0 … 1
  double clearance_m = NAN;     ///< of the trajectory that is flown
  std::string worst_loop{};  ///< that of all began the farthest after a deadline; empty: none did
  double lateness_ms = NAN;
};

/// `tour  target 3 of 8  height 3.4 m  battery 87 %  clearance 1.2 m  worst loop mapping 4.1 ms
/// late`.
[[nodiscard]] std::string flight_line(const FlightStatus& status);

/// The line while it flies, on stderr where that is a terminal: until its end the log's lines below
/// a warning go to the log's file alone, those of a process started with -v go above the line.
class FlightLine {
 public:
  FlightLine();
  ~FlightLine();  ///< leaves the line as it is
  FlightLine(const FlightLine&) = delete;
  FlightLine& operator=(const FlightLine&) = delete;

  void show(const FlightStatus& status);

 private:
  core::StatusLine line_;
};

}  // namespace saker::flight
