#include "tools/saker/experiment/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace saker::tools {
namespace {

CalibrationBin bin_of(std::span<const Outcome> outcomes) {
  CalibrationBin bin;
  bin.lowest_sd = outcomes.front().predicted_sd;
  bin.highest_sd = outcomes.back().predicted_sd;
  bin.outcomes = static_cast<int>(outcomes.size());
  double predicted = 0, realised = 0;
  for (const Outcome& o : outcomes) {
    predicted += o.predicted_sd * o.predicted_sd;
    realised += o.error * o.error;
  }
  bin.predicted = std::sqrt(predicted / bin.outcomes);
  bin.realised = std::sqrt(realised / bin.outcomes);
  return bin;
}

}  // namespace

std::vector<CalibrationBin> calibration(std::span<const Outcome> outcomes, int least, int most) {
  std::vector<Outcome> sorted;
  std::ranges::copy_if(outcomes, std::back_inserter(sorted), [](const Outcome& o) {
    return std::isfinite(o.predicted_sd) && std::isfinite(o.error);
  });
  std::ranges::stable_sort(sorted, {}, &Outcome::predicted_sd);
  if (sorted.empty()) return {};
  const auto count =
      static_cast<std::size_t>(std::clamp(static_cast<int>(sorted.size()) / least, 1, most));
  std::vector<CalibrationBin> bins;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = i * sorted.size() / count, to = (i + 1) * sorted.size() / count;
    bins.push_back(bin_of(std::span(sorted).subspan(from, to - from)));
  }
  return bins;
}

nlohmann::ordered_json calibration_json(const std::vector<CalibrationBin>& bins) {
  auto list = nlohmann::ordered_json::array();
  for (const CalibrationBin& bin : bins) {
    list.push_back({{"lowest_sd_m", bin.lowest_sd},
                    {"highest_sd_m", bin.highest_sd},
                    {"outcomes", bin.outcomes},
                    {"predicted_m", bin.predicted},
                    {"realised_m", bin.realised},
                    {"ratio", bin.ratio()}});
  }
  return list;
}

std::string calibration_text(const std::string& policy, const std::vector<CalibrationBin>& bins) {
  if (bins.empty()) return "";
  std::string text =
      fmt::format("\npredicted before it was flown, {}\n{:>17} {:>8} {:>11} {:>10} {:>6}\n", policy,
                  "sd m", "outcomes", "predicted m", "realised m", "ratio");
  for (const CalibrationBin& bin : bins) {
    text += fmt::format("{:>17} {:>8} {:>11.3f} {:>10.3f} {:>6.2f}\n",
                        fmt::format("{:.3f} ... {:.3f}", bin.lowest_sd, bin.highest_sd),
                        bin.outcomes, bin.predicted, bin.realised, bin.ratio());
  }
  return text;
}

}  // namespace saker::tools
