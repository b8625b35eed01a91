#pragma once

#include <string>
#include <vector>

#include "tools/saker/experiment/target_figures.h"

namespace saker::tools {

/// One robot of a team, or all together, over several seeds: errors of length and width over all
/// targets found, as the paper's multi-robot tables.
struct TeamRow {
  std::string who;
  int runs = 0;
  int succeeded = 0;  ///< flights; together: missions that found every target
  int targets = 0;
  int found = 0;
  int collisions = 0;
  double busy_s = 0;           ///< flight and exchange; together: of the longest in each mission
  std::vector<double> errors;  ///< m, length and width, mapped − true

  [[nodiscard]] double per_minute() const;
};

/// The robots in their order, then "together". \param results what each seed's results.json holds
[[nodiscard]] std::vector<TeamRow> team_rows(const std::vector<Json>& results);

/// {"mission", "runs", "table": [{…}], "comparisons": [{…}]}: see docs/contract.md.
[[nodiscard]] Json team_runs_json(const std::vector<Json>& results);

/// A row each with 95 % intervals by bootstrap over seeds, then all together against the robots'
/// mean and against each, paired by seed.
[[nodiscard]] std::string team_runs_text(const std::vector<Json>& results);

}  // namespace saker::tools
