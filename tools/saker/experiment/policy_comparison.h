#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "saker/core/bootstrap.h"

namespace saker::tools {

/// One figure of two policies that flew the same missions.
struct FigureComparison {
  std::string figure;  ///< "mae_m", …, as in the table
  double ours = NAN;   ///< of all missions that both flew
  double theirs = NAN;
  core::Interval difference;  ///< ours − theirs
  core::Interval ratio;       ///< ours / theirs

  /// "less" or "more" only where the interval of the difference excludes 0, else "-".
  [[nodiscard]] std::string verdict() const;
};

/// A figure of some missions, by their numbers: ours and theirs.
using PairedStatistic = std::function<std::pair<double, double>(std::span<const int> missions)>;

/// With 95 % intervals by paired bootstrap over the missions.
[[nodiscard]] FigureComparison compare_figure(const std::string& figure, int missions,
                                              const PairedStatistic& of);

struct PolicyComparison {
  std::string scenario;  ///< or "all"
  std::string policy, against;
  int missions = 0;  ///< scenario and seed, flown with both
  std::vector<FigureComparison> figures;
};

/// Every policy against those that come before it in the results, for each scenario and, where
/// there are several, for all: 95 % intervals by paired bootstrap over missions.
/// \param results what each run's results.json holds
[[nodiscard]] std::vector<PolicyComparison> compare_policies(
    const std::vector<nlohmann::ordered_json>& results);

[[nodiscard]] nlohmann::ordered_json comparison_json(const PolicyComparison& comparison);
[[nodiscard]] std::string comparison_text(const std::vector<PolicyComparison>& comparisons);

}  // namespace saker::tools
