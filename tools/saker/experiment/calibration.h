#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace saker::tools {

/// What was predicted of a viewpoint before it was flown, and what came of it: one dimension of one
/// target.
struct Outcome {
  double predicted_sd = NAN;  ///< m
  double error = NAN;         ///< m, mapped − true, when the viewpoint was done
};

/// Outcomes whose predicted sd are next to each other.
struct CalibrationBin {
  double lowest_sd = NAN, highest_sd = NAN;  ///< m, predicted
  int outcomes = 0;
  double predicted = NAN;  ///< m, root mean square of the predicted sd
  double realised = NAN;   ///< m, root mean square of the errors

  [[nodiscard]] double ratio() const { return realised / predicted; }  ///< 1: as was said
};

/// As many bins as there are with at least `least` outcomes each, but no more than `most`, alike in
/// number, by rising sd. One of fewer outcomes where there are not even so many; none of none. What
/// is not finite is left out. Errors have tails: of 50 outcomes a ratio that should be 1 is within
/// 0.8 to 1.25 three times out of four, of 120 eleven times out of twelve (by drawing from 980
/// predictions of 232 missions), so that what is flown beyond makes bins larger, not more.
[[nodiscard]] std::vector<CalibrationBin> calibration(std::span<const Outcome> outcomes,
                                                      int least = 50, int most = 5);

[[nodiscard]] nlohmann::ordered_json calibration_json(const std::vector<CalibrationBin>& bins);
[[nodiscard]] std::string calibration_text(const std::string& policy,
                                           const std::vector<CalibrationBin>& bins);

}  // namespace saker::tools
