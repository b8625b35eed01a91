#pragma once

#include <cstdint>
#include <string>

#include "saker/odometry/odometry.h"

/// Flights in which something goes wrong half way, and what odometry said of its poses.
namespace saker::odometry::testing {

enum class Trouble {
  none,
  gap,          ///< no scan comes for 0.2 to 5 s
  covered,      ///< scans without a return, for 0.2 to 2.5 s
  half,         ///< half of the view without a return, for 2 s
  kidnapped,    ///< one scan of another place
  late,         ///< the stamps of scans and inertial samples step forward by 0.3 to 20 s
  featureless,  ///< nothing but two smooth walls and the ground in sight, for 20 m
};

struct Trial {
  Trouble trouble = Trouble::none;
  std::uint64_t seed = 0;
  bool with_imu = true;
};

struct Outcome {
  int scans = 0;
  /// Scans from 2 s after the start on, before trouble and from 3 s after it on; status ok.
  int clean = 0, clean_good = 0;
  double worst_good_m = 0;        ///< error of a pose with status ok
  double worst_deviation_sd = 0;  ///< its Mahalanobis distance per root of dimension
  double unsaid_s = 0;     ///< longest from the first pose that is off by 0.3 m to a status not ok
  double recovered_s = 0;  ///< from the end of trouble to the first status ok that stays
  double end_m = 0;        ///< error of the last pose
  double nees_sum = 0;     ///< of the drift over 1 s, in clean stretches, a degree of freedom
  int nees_count = 0;
};

/// Ten seconds of scans at 10 Hz in a street of the seed's; trouble begins after about four.
[[nodiscard]] Outcome fly(const Trial& trial, const OdometryConfig& config);

[[nodiscard]] const char* to_string(Trouble trouble);

}  // namespace saker::odometry::testing
