#include "tools/saker/experiment/policy_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "saker/core/statistics.h"
#include "tools/saker/experiment/experiment_table.h"
#include "tools/saker/experiment/target_figures.h"

namespace saker::tools {
namespace {

constexpr const char* kAll = "all";

struct Figure {
  const char* name;
  double (*of)(const TableRow& runs);
};

constexpr Figure kFigures[] = {
    {"mae_m", [](const TableRow& r) { return core::mean_absolute(r.errors); }},
    {"absolute_bias_m", [](const TableRow& r) { return std::abs(core::mean(r.errors)); }},
    {"sd_m", [](const TableRow& r) { return core::standard_deviation(r.errors); }},
    {"mapped_share", [](const TableRow& r) { return r.mapped_share(); }},
    {"flight_time_s", [](const TableRow& r) { return core::mean(r.flight_times); }},
    {"path_m", [](const TableRow& r) { return core::mean(r.paths); }},
};

/// One mission as both policies flew it.
struct Pair {
  TableRow ours, theirs;
};

using Mission = std::pair<std::string, int>;  // scenario and seed

struct Flown {
  std::vector<std::string> scenarios, policies;  ///< in their order
  std::vector<Mission> missions;
  std::map<std::pair<Mission, std::string>, TableRow> rows;  ///< by mission and policy
};

template <class T>
void add_new(std::vector<T>& list, const T& value) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

Flown flown_of(const std::vector<Json>& results) {
  Flown flown;
  for (const Json& run : results) {
    const Mission mission{run.at("scenario").get<std::string>(), run.at("seed").get<int>()};
    const std::string policy = run.at("policy");
    add_new(flown.scenarios, mission.first);
    add_new(flown.policies, policy);
    add_new(flown.missions, mission);
    add(run, flown.rows[{mission, policy}]);
  }
  return flown;
}

std::vector<Pair> pairs_of(const Flown& flown, const std::string& scenario,
                           const std::string& policy, const std::string& against) {
  std::vector<Pair> pairs;
  for (const Mission& mission : flown.missions) {
    if (scenario != kAll && mission.first != scenario) continue;
    const auto ours = flown.rows.find({mission, policy});
    const auto theirs = flown.rows.find({mission, against});
    if (ours == flown.rows.end() || theirs == flown.rows.end()) continue;
    pairs.push_back({ours->second, theirs->second});
  }
  return pairs;
}

/// What some of the missions, some more than once, have as one.
Pair pooled(const std::vector<Pair>& pairs, std::span<const int> missions) {
  Pair sum;
  for (const int i : missions) {
    add(pairs[static_cast<std::size_t>(i)].ours, sum.ours);
    add(pairs[static_cast<std::size_t>(i)].theirs, sum.theirs);
  }
  return sum;
}

FigureComparison compare(const Figure& figure, const std::vector<Pair>& pairs) {
  const auto of = [&](std::span<const int> missions) {
    const Pair sum = pooled(pairs, missions);
    return std::pair(figure.of(sum.ours), figure.of(sum.theirs));
  };
  return compare_figure(figure.name, static_cast<int>(pairs.size()), of);
}

Json interval_json(const core::Interval& interval) {
  return {{"estimate", number(interval.estimate)},
          {"low", number(interval.low)},
          {"high", number(interval.high)}};
}

}  // namespace

std::string FigureComparison::verdict() const {
  if (!difference.excludes(0)) return "-";
  return difference.estimate < 0 ? "less" : "more";
}

FigureComparison compare_figure(const std::string& figure, int missions,
                                const PairedStatistic& of) {
  FigureComparison result;
  result.figure = figure;
  result.difference = core::bootstrap(missions, [&](std::span<const int> drawn) {
    const auto [ours, theirs] = of(drawn);
    return ours - theirs;
  });
  result.ratio = core::bootstrap(missions, [&](std::span<const int> drawn) {
    const auto [ours, theirs] = of(drawn);
    return ours / theirs;
  });
  std::vector<int> all(static_cast<std::size_t>(missions));
  std::iota(all.begin(), all.end(), 0);
  std::tie(result.ours, result.theirs) = of(all);
  return result;
}

std::vector<PolicyComparison> compare_policies(const std::vector<Json>& results) {
  const Flown flown = flown_of(results);
  std::vector<std::string> scenarios = flown.scenarios;
  if (scenarios.size() > 1) scenarios.emplace_back(kAll);
  std::vector<PolicyComparison> comparisons;
  for (const std::string& scenario : scenarios) {
    for (std::size_t i = 1; i < flown.policies.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        const auto pairs = pairs_of(flown, scenario, flown.policies[i], flown.policies[k]);
        PolicyComparison& comparison = comparisons.emplace_back();
        comparison = {
            scenario, flown.policies[i], flown.policies[k], static_cast<int>(pairs.size()), {}};
        for (const Figure& figure : kFigures) comparison.figures.push_back(compare(figure, pairs));
      }
    }
  }
  return comparisons;
}

Json comparison_json(const PolicyComparison& comparison) {
  Json figures = Json::object();
  for (const FigureComparison& figure : comparison.figures) {
    figures[figure.figure] = {{"ours", number(figure.ours)},
                              {"theirs", number(figure.theirs)},
                              {"difference", interval_json(figure.difference)},
                              {"ratio", interval_json(figure.ratio)},
                              {"verdict", figure.verdict()}};
  }
  return {{"scenario", comparison.scenario},
          {"policy", comparison.policy},
          {"against", comparison.against},
          {"missions", comparison.missions},
          {"figures", figures}};
}

std::string comparison_text(const std::vector<PolicyComparison>& comparisons) {
  if (comparisons.empty()) return "";
  std::string text = fmt::format(
      "\n{:<12} {:<17} {:>8} {:<16} {:>8} {:>8} {:>9} {:>20} {:>20} {}\n", "scenario", "policies",
      "missions", "figure", "first", "second", "differ by", "95 % interval", "ratio", "first is");
  for (const PolicyComparison& c : comparisons) {
    for (const FigureComparison& f : c.figures) {
      text += fmt::format(
          "{:<12} {:<17} {:>8} {:<16} {:>8.3f} {:>8.3f} {:>+9.3f} {:>20} {:>20} {}\n", c.scenario,
          c.policy + " - " + c.against, c.missions, f.figure, f.ours, f.theirs,
          f.difference.estimate,
          fmt::format("{:+.3f} ... {:+.3f}", f.difference.low, f.difference.high),
          fmt::format("{:.2f} ({:.2f} ... {:.2f})", f.ratio.estimate, f.ratio.low, f.ratio.high),
          f.verdict());
    }
  }
  return text;
}

}  // namespace saker::tools
