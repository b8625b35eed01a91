#include "saker/uncertainty/held_out.h"

#include <algorithm>
#include <cmath>

#include "saker/core/statistics.h"

namespace saker::uncertainty {

HeldOut held_out(
    std::vector<std::string> recordings, int folds,
    const std::function<HeldOut(const std::function<bool(const std::string&)>& is_held_out)>&
        score) {
  std::sort(recordings.begin(), recordings.end());
  recordings.erase(std::unique(recordings.begin(), recordings.end()), recordings.end());
  HeldOut all;
  for (int fold = 0; fold < folds; ++fold) {
    const auto is_held_out = [&](const std::string& recording) {
      const auto found = std::lower_bound(recordings.begin(), recordings.end(), recording);
      return (found - recordings.begin()) % folds == fold;
    };
    all.merge(score(is_held_out));
  }
  return all;
}

Trial trial(const std::string& what, const HeldOut& better, const HeldOut& worse,
            double standard_errors) {
  std::vector<double> gains;
  for (const auto& [recording, score] : better) {
    const auto other = worse.find(recording);
    if (other != worse.end()) gains.push_back(score - other->second);
  }
  Trial trial{what, core::mean(gains)};
  trial.standard_error =
      core::standard_deviation(gains) / std::sqrt(static_cast<double>(gains.size()));
  trial.kept = trial.gain > standard_errors * trial.standard_error;
  return trial;
}

}  // namespace saker::uncertainty
