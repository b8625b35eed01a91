#include "tools/saker/experiment/experiment_report.h"

#include <algorithm>

#include "saker/core/files.h"
#include "tools/saker/experiment/experiment_table.h"
#include "tools/saker/experiment/policy_comparison.h"
#include "tools/saker/experiment/viewpoint_log.h"
#include "tools/saker/picture/experiment_pictures.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The rows of all scenarios together, one a policy.
std::vector<TableRow> totals_of(const std::vector<TableRow>& rows) {
  std::vector<TableRow> totals;
  std::ranges::copy_if(rows, std::back_inserter(totals),
                       [&](const TableRow& row) { return row.scenario == rows.back().scenario; });
  return totals;
}

/// The first seed of each scenario, its policies side by side.
std::vector<std::vector<TrajectoryPanel>> panels_of(const std::vector<FlownRun>& runs) {
  std::vector<std::string> scenarios;
  std::vector<std::vector<TrajectoryPanel>> rows;
  for (const FlownRun& run : runs) {
    if (run.results.at("seed") != runs.front().results.at("seed")) continue;
    const std::string scenario = run.results.at("scenario"), policy = run.results.at("policy");
    if (scenarios.empty() || scenarios.back() != scenario) {
      scenarios.push_back(scenario);
      rows.emplace_back();
    }
    rows.back().push_back({scenario + ", " + policy, run.folder});
  }
  return rows;
}

/// Of each policy over all its runs, in their order; none of a policy that predicts nothing.
std::vector<std::pair<std::string, std::vector<CalibrationBin>>> calibrations_of(
    const std::vector<FlownRun>& runs) {
  std::vector<std::pair<std::string, std::vector<Outcome>>> outcomes;
  for (const FlownRun& run : runs) {
    const std::string policy = run.results.at("policy");
    auto of_policy = std::ranges::find(outcomes, policy, [](const auto& o) { return o.first; });
    if (of_policy == outcomes.end()) of_policy = outcomes.insert(outcomes.end(), {policy, {}});
    const std::vector<Outcome> of_run = read_outcomes(run.folder / "viewpoints.csv");
    of_policy->second.insert(of_policy->second.end(), of_run.begin(), of_run.end());
  }
  std::vector<std::pair<std::string, std::vector<CalibrationBin>>> calibrations;
  for (const auto& [policy, list] : outcomes) {
    if (auto bins = calibration(list); !bins.empty()) {
      calibrations.emplace_back(policy, std::move(bins));
    }
  }
  return calibrations;
}

}  // namespace

std::string write_report(const std::vector<FlownRun>& runs, const fs::path& out) {
  std::vector<Json> results;
  for (const FlownRun& run : runs) results.push_back(run.results);
  const std::vector<TableRow> rows = pool(results);
  const std::vector<PolicyComparison> comparisons = compare_policies(results);
  std::string text = table_text(rows) + consistency_text(rows) + comparison_text(comparisons);
  Json calibrated = Json::object();
  for (const auto& [policy, bins] : calibrations_of(runs)) {
    text += calibration_text(policy, bins);
    calibrated[policy] = calibration_json(bins);
    write_calibration_picture(out / ("calibration-" + policy + ".png"), policy, bins);
  }
  core::write_file(out / "table.txt", text);
  if (runs.size() == 1) return text;

  Json pooled = Json::array(), compared = Json::array();
  for (const TableRow& row : rows) pooled.push_back(row_json(row));
  for (const PolicyComparison& c : comparisons) compared.push_back(comparison_json(c));
  write_error_picture(out / "errors.png", totals_of(rows));
  write_trajectory_picture(out / "trajectories.png", panels_of(runs), {});
  const Json all = {{"runs", runs.size()},
                    {"table", pooled},
                    {"comparisons", compared},
                    {"calibration", calibrated}};
  core::write_file(out / "results.json", all.dump(2) + "\n");
  return text;
}

}  // namespace saker::tools
