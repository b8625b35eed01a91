#include "tools/saker/experiment/experiment_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "saker/core/statistics.h"
#include "tools/saker/experiment/target_figures.h"

namespace saker::tools {
namespace {

constexpr const char* kAll = "all";

void add_number(const Json& value, std::vector<double>& to) {
  if (value.is_number()) to.push_back(value.get<double>());
}

void append(const std::vector<double>& values, std::vector<double>& to) {
  to.insert(to.end(), values.begin(), values.end());
}

void add(const ConsistencySum& more, ConsistencySum& to) {
  to.objects += more.objects;
  to.size += more.size;
  to.place += more.place;
}

/// \param figures one class of a run's `consistency`: means are null where there is no object.
void add(const Json& figures, ConsistencySum& to) {
  const int objects = figures.at("objects");
  if (objects == 0) return;
  add(ConsistencySum{objects, objects * figures.at("size_nees").get<double>(),
                     objects * figures.at("place_nees").get<double>()},
      to);
}

ClassSum class_sum(const Json& counts) {
  return {counts.at("mapped"), counts.at("invented"), counts.at("duplicates")};
}

void add(const ClassSum& more, ClassSum& to) {
  to.mapped += more.mapped;
  to.invented += more.invented;
  to.duplicates += more.duplicates;
}

Json consistency_json(const TableRow& row) {
  Json classes = Json::object();
  for (const auto& [name, c] : row.consistency) {
    classes[name] = {{"objects", c.objects},
                     {"size_nees", number(c.mean_size())},
                     {"place_nees", number(c.mean_place())}};
  }
  return classes;
}

Json classes_json(const TableRow& row) {
  Json classes = Json::object();
  for (const auto& [name, c] : row.classes) {
    classes[name] = {{"mapped", c.mapped}, {"invented", c.invented}, {"duplicates", c.duplicates}};
  }
  return classes;
}

Json errors_json(const std::vector<double>& errors) {
  return {{"bias_m", number(core::mean(errors))},
          {"sd_m", number(core::standard_deviation(errors))},
          {"mae_m", number(core::mean_absolute(errors))}};
}

Json quantiles(const std::vector<double>& errors) {
  Json values = Json::object();
  for (const int percent : {5, 25, 50, 75, 95}) {
    values[std::to_string(percent)] = number(core::percentile(errors, percent / 100.0));
  }
  return values;
}

TableRow& row_of(std::vector<TableRow>& rows, const std::string& scenario,
                 const std::string& policy) {
  const auto found = std::ranges::find_if(
      rows, [&](const TableRow& row) { return row.scenario == scenario && row.policy == policy; });
  if (found != rows.end()) return *found;
  TableRow& row = rows.emplace_back();
  row.scenario = scenario;
  row.policy = policy;
  return row;
}

}  // namespace

double TableRow::mapped_share() const {
  return reachable > 0 ? static_cast<double>(reachable_found) / reachable : NAN;
}

void add(const TableRow& runs, TableRow& row) {
  row.runs += runs.runs;
  row.succeeded += runs.succeeded;
  row.targets += runs.targets;
  row.reachable += runs.reachable;
  row.found += runs.found;
  row.reachable_found += runs.reachable_found;
  row.collisions += runs.collisions;
  append(runs.lengths, row.lengths);
  append(runs.widths, row.widths);
  append(runs.errors, row.errors);
  append(runs.size_nees, row.size_nees);
  append(runs.place_nees, row.place_nees);
  for (const auto& [name, c] : runs.consistency) add(c, row.consistency[name]);
  for (const auto& [name, c] : runs.classes) add(c, row.classes[name]);
  append(runs.trajectory_errors, row.trajectory_errors);
  append(runs.flight_times, row.flight_times);
  append(runs.paths, row.paths);
  row.min_clearance_m = std::min(row.min_clearance_m, runs.min_clearance_m);
}

void add(const Json& run, TableRow& row) {
  ++row.runs;
  const auto reachable = run.at("reachable_targets").get<std::set<int>>();
  row.reachable += static_cast<int>(reachable.size());
  row.succeeded += run.at("succeeded").get<bool>();
  row.targets += run.at("targets").get<int>();
  row.found += run.at("found").get<int>();
  row.collisions += run.at("collisions").get<int>();
  for (const Json& object : run.at("errors")) {
    row.reachable_found += reachable.contains(object.at("id").get<int>());
    add_number(object.at("length_m"), row.lengths);
    add_number(object.at("width_m"), row.widths);
    add_number(object.at("length_m"), row.errors);
    add_number(object.at("width_m"), row.errors);
    add_number(object.value("size_nees", Json()), row.size_nees);
    add_number(object.value("place_nees", Json()), row.place_nees);
  }
  const Json consistency = run.value("consistency", Json::object());
  for (const auto& [name, figures] : consistency.items()) add(figures, row.consistency[name]);
  const Json classes = run.value("classes", Json::object());
  for (const auto& [name, counts] : classes.items()) add(class_sum(counts), row.classes[name]);
  add_number(run.at("trajectory_error_m"), row.trajectory_errors);
  add_number(run.at("flight_time_s"), row.flight_times);
  add_number(run.at("path_m"), row.paths);
  const Json& clearance = run.at("min_clearance_m");
  if (clearance.is_number()) {
    row.min_clearance_m = std::min(row.min_clearance_m, clearance.get<double>());
  }
}

std::vector<TableRow> pool(const std::vector<Json>& results) {
  std::vector<TableRow> rows, totals;
  std::set<std::string> scenarios;
  for (const Json& run : results) {
    const std::string scenario = run.at("scenario"), policy = run.at("policy");
    scenarios.insert(scenario);
    add(run, row_of(rows, scenario, policy));
    add(run, row_of(totals, kAll, policy));
  }
  if (scenarios.size() > 1) rows.insert(rows.end(), totals.begin(), totals.end());
  return rows;
}

Json row_json(const TableRow& row) {
  return {{"scenario", row.scenario},
          {"policy", row.policy},
          {"runs", row.runs},
          {"succeeded", row.succeeded},
          {"targets", row.targets},
          {"reachable", row.reachable},
          {"found", row.found},
          {"reachable_found", row.reachable_found},
          {"bias_m", number(core::mean(row.errors))},
          {"sd_m", number(core::standard_deviation(row.errors))},
          {"mae_m", number(core::mean_absolute(row.errors))},
          {"length", errors_json(row.lengths)},
          {"width", errors_json(row.widths)},
          {"size_nees", number(core::mean(row.size_nees))},
          {"place_nees", number(core::mean(row.place_nees))},
          {"quantiles_m", quantiles(row.errors)},
          {"consistency", consistency_json(row)},
          {"classes", classes_json(row)},
          {"mapped_share", number(row.mapped_share())},
          {"trajectory_error_m", number(core::mean(row.trajectory_errors))},
          {"collisions", row.collisions},
          {"min_clearance_m", number(row.min_clearance_m)},
          {"flight_time_s", number(core::mean(row.flight_times))},
          {"path_m", number(core::mean(row.paths))}};
}

std::string table_text(const std::vector<TableRow>& rows) {
  std::string text = fmt::format(
      "{:<12} {:<8} {:>4} {:>4} {:>9} {:>8} {:>7} {:>6} {:>6} {:>9} {:>10} {:>10} {:>10} {:>8} "
      "{:>7} {:>7}\n",
      "scenario", "policy", "runs", "ok", "found", "mapped %", "bias m", "sd m", "MAE m",
      "size NEES", "place NEES", "traject. m", "collisions", "clear. m", "time s", "path m");
  for (const TableRow& row : rows) {
    text += fmt::format(
        "{:<12} {:<8} {:>4} {:>4} {:>9} {:>8.1f} {:>7.3f} {:>6.3f} {:>6.3f} {:>9.2f} {:>10.2f} "
        "{:>10.3f} {:>10} {:>8.2f} {:>7.1f} {:>7.1f}\n",
        row.scenario, row.policy, row.runs, row.succeeded,
        fmt::format("{} of {}", row.found, row.targets), 100 * row.mapped_share(),
        core::mean(row.errors), core::standard_deviation(row.errors),
        core::mean_absolute(row.errors), core::mean(row.size_nees), core::mean(row.place_nees),
        core::mean(row.trajectory_errors), row.collisions, row.min_clearance_m,
        core::mean(row.flight_times), core::mean(row.paths));
  }
  return text;
}

std::string consistency_text(const std::vector<TableRow>& rows) {
  std::string text;
  for (const TableRow& row : rows) {
    for (const auto& [name, c] : row.consistency) {
      text += fmt::format("{:<12} {:<8} {:<8} {:>9.2f} {:>10.2f} {:>7}\n", row.scenario, row.policy,
                          name, c.mean_size(), c.mean_place(), c.objects);
    }
  }
  if (text.empty()) return text;
  return fmt::format("\nall mapped objects\n{:<12} {:<8} {:<8} {:>9} {:>10} {:>7}\n", "scenario",
                     "policy", "class", "size NEES", "place NEES", "objects") +
         text;
}

}  // namespace saker::tools
