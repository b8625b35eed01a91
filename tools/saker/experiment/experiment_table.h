#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace saker::tools {

/// NEES a degree of freedom, summed over the objects of one class, so that runs can be put
/// together.
struct ConsistencySum {
  int objects = 0;
  double size = 0, place = 0;

  [[nodiscard]] double mean_size() const { return objects > 0 ? size / objects : NAN; }
  [[nodiscard]] double mean_place() const { return objects > 0 ? place / objects : NAN; }
};

/// Objects of one class in the maps.
struct ClassSum {
  int mapped = 0, invented = 0, duplicates = 0;
};

/// Runs of one scenario with one policy, or of all scenarios, put together: errors of length and
/// width over all objects of all runs, as the paper's first table.
struct TableRow {
  std::string scenario, policy;
  int runs = 0;
  int succeeded = 0;
  int targets = 0;
  int reachable = 0;  ///< of them, by world and geofence: reachable_targets.h
  int found = 0;
  int reachable_found = 0;  ///< of those that can be reached
  int collisions = 0;
  std::vector<double> lengths, widths;                ///< m, errors: mapped − true
  std::vector<double> errors;                         ///< m, of both
  std::vector<double> size_nees, place_nees;          ///< a degree of freedom, one an object
  std::map<std::string, ConsistencySum> consistency;  ///< by class, of all mapped objects
  std::map<std::string, ClassSum> classes;            ///< the same: how many there are
  std::vector<double> trajectory_errors;              ///< m, one a run
  std::vector<double> flight_times, paths;            ///< s, m; one a run
  double min_clearance_m = std::numeric_limits<double>::infinity();  ///< of all runs

  [[nodiscard]] double mapped_share() const;  ///< of the targets that can be reached, found ones
};

/// Adds a run to the figures of a row.
void add(const nlohmann::ordered_json& run, TableRow& row);
/// Adds a row's runs to another's.
void add(const TableRow& runs, TableRow& row);

/// A row for each scenario and policy in the order of the results, then one "all" for each policy
/// that flew several scenarios. \param results what each run's results.json holds.
[[nodiscard]] std::vector<TableRow> pool(const std::vector<nlohmann::ordered_json>& results);

/// The same keys as a run's results.json, means over the runs where a figure is the run's; figures
/// of `length` and `width` alone; and `quantiles_m`, the distribution behind bias and sd.
[[nodiscard]] nlohmann::ordered_json row_json(const TableRow& row);

[[nodiscard]] std::string table_text(const std::vector<TableRow>& rows);
/// A line a class of each row; empty where no run says it.
[[nodiscard]] std::string consistency_text(const std::vector<TableRow>& rows);

}  // namespace saker::tools
