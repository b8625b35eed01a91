#include "saker/experiment_report.h"

#include <algorithm>

#include "core/files.h"
#include "saker/experiment_pictures.h"
#include "saker/experiment_table.h"
#include "saker/policy_comparison.h"
#include "saker/target_figures.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

std::string write_report(const std::vector<FlownRun>& runs, const fs::path& out) {
  std::vector<Json> results;
  for (const FlownRun& run : runs) results.push_back(run.results);
  const std::vector<TableRow> rows = pool(results);
  const std::vector<PolicyComparison> comparisons = compare_policies(results);
  std::string text = table_text(rows) + comparison_text(comparisons);
  core::write_file(out / "table.txt", text);
  if (runs.size() == 1) return text;

  Json table = Json::array(), compared = Json::array();
  for (const TableRow& row : rows) table.push_back(row_json(row));
  for (const PolicyComparison& c : comparisons) compared.push_back(comparison_json(c));
  write_error_picture(out / "errors.png", totals_of(rows));
  write_trajectory_picture(out / "trajectories.png", panels_of(runs), {});
  const Json all = {{"runs", runs.size()}, {"table", table}, {"comparisons", compared}};
  core::write_file(out / "results.json", all.dump(2) + "\n");
  return text;
}

}  // namespace saker::tools
