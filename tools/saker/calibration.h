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

/// As many bins as there are with at least `least` outcomes each, alike in number, by rising sd.
/// One of fewer outcomes where there are not even so many; none of none. What is not finite is left
/// out.
[[nodiscard]] std::vector<CalibrationBin> calibration(std::span<const Outcome> outcomes,
                                                      int least = 50);

[[nodiscard]] nlohmann::ordered_json calibration_json(const std::vector<CalibrationBin>& bins);
[[nodiscard]] std::string calibration_text(const std::string& policy,
                                           const std::vector<CalibrationBin>& bins);

}  // namespace saker::tools
