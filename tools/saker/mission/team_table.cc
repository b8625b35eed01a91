#include "tools/saker/mission/team_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "saker/core/statistics.h"
#include "tools/saker/experiment/policy_comparison.h"

namespace saker::tools {
namespace {

constexpr const char* kTogether = "together";
constexpr const char* kMean = "robots' mean";

struct Figure {
  const char* name;
  double (*of)(const TeamRow& row);
};

constexpr Figure kFigures[] = {
    {"objects_per_min", [](const TeamRow& r) { return r.per_minute(); }},
    {"absolute_bias_m", [](const TeamRow& r) { return std::abs(core::mean(r.errors)); }},
    {"sd_m", [](const TeamRow& r) { return core::standard_deviation(r.errors); }},
    {"mae_m", [](const TeamRow& r) { return core::mean_absolute(r.errors); }},
};

void add_errors(const Json& figures, std::vector<double>& to) {
  for (const Json& object : figures.at("errors")) {
    to.push_back(object.at("length_m").get<double>());
    to.push_back(object.at("width_m").get<double>());
  }
}

TeamRow row_of(const Json& figures, const std::string& who) {
  TeamRow row{.who = who,
              .runs = 1,
              .targets = figures.at("targets").get<int>(),
              .found = figures.at("found").get<int>(),
              .errors = {}};
  add_errors(figures, row.errors);
  return row;
}

/// Of one seed.
std::vector<TeamRow> rows_of(const Json& run) {
  std::vector<TeamRow> rows;
  int collisions = 0;
  for (const Json& robot : run.at("robots")) {
    TeamRow& row = rows.emplace_back(row_of(robot, robot.at("robot").get<std::string>()));
    row.succeeded = robot.at("succeeded").get<bool>();
    row.collisions = robot.at("collisions").get<int>();
    row.busy_s = robot.at("flight_time_s").get<double>() + robot.at("exchange_s").get<double>();
    collisions += row.collisions;
  }
  const Json& merged = run.at("merged");
  TeamRow& together = rows.emplace_back(row_of(merged, kTogether));
  together.succeeded = together.found == together.targets;
  together.collisions = collisions;
  together.busy_s = merged.at("longest_s").get<double>();
  return rows;
}

void add(const TeamRow& row, TeamRow& to) {
  to.who = row.who;
  to.runs += row.runs;
  to.succeeded += row.succeeded;
  to.targets += row.targets;
  to.found += row.found;
  to.collisions += row.collisions;
  to.busy_s += row.busy_s;
  to.errors.insert(to.errors.end(), row.errors.begin(), row.errors.end());
}

/// Rows of each seed.
using Runs = std::vector<std::vector<TeamRow>>;

Runs runs_of(const std::vector<Json>& results) {
  Runs runs;
  for (const Json& run : results) runs.push_back(rows_of(run));
  return runs;
}

std::vector<TeamRow> pooled(const Runs& runs, std::span<const int> seeds) {
  std::vector<TeamRow> rows(runs.front().size());
  for (const int seed : seeds) {
    const std::vector<TeamRow>& run = runs[static_cast<std::size_t>(seed)];
    for (std::size_t i = 0; i < rows.size(); ++i) add(run[i], rows[i]);
  }
  return rows;
}

double robots_mean(const std::vector<TeamRow>& rows, const Figure& figure) {
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) values.push_back(figure.of(rows[i]));
  return core::mean(values);
}

/// \param against  of the rows of some seeds
template <class Against>
PolicyComparison compare_with(const std::string& mission, const Runs& runs, const std::string& name,
                              const Against& against) {
  const auto seeds = static_cast<int>(runs.size());
  PolicyComparison comparison{mission, kTogether, name, seeds, {}};
  for (const Figure& figure : kFigures) {
    const auto both = [&](std::span<const int> drawn) {
      const std::vector<TeamRow> rows = pooled(runs, drawn);
      return std::pair(figure.of(rows.back()), against(rows, figure));
    };
    comparison.figures.push_back(compare_figure(figure.name, seeds, both));
  }
  return comparison;
}

std::vector<PolicyComparison> comparisons_of(const std::string& mission, const Runs& runs) {
  std::vector<PolicyComparison> all = {compare_with(mission, runs, kMean, robots_mean)};
  for (std::size_t i = 0; i + 1 < runs.front().size(); ++i) {
    all.push_back(compare_with(mission, runs, runs.front()[i].who,
                               [i](const std::vector<TeamRow>& rows, const Figure& figure) {
                                 return figure.of(rows[i]);
                               }));
  }
  return all;
}

core::Interval interval_of(const Runs& runs, std::size_t row, const Figure& figure) {
  return core::bootstrap(static_cast<int>(runs.size()), [&](std::span<const int> drawn) {
    return figure.of(pooled(runs, drawn)[row]);
  });
}

Json row_json(const TeamRow& row, std::size_t i, const Runs& runs) {
  Json json = {{"robot", row.who},           {"runs", row.runs},
               {"succeeded", row.succeeded}, {"targets", row.targets},
               {"found", row.found},         {"collisions", row.collisions},
               {"busy_s", row.busy_s},       {"bias_m", number(core::mean(row.errors))}};
  for (const Figure& figure : kFigures) {
    const core::Interval interval = interval_of(runs, i, figure);
    json[figure.name] = {{"estimate", number(interval.estimate)},
                         {"low", number(interval.low)},
                         {"high", number(interval.high)}};
  }
  return json;
}

std::string row_text(const Json& row) {
  std::string text = fmt::format(
      "{:<10} {:>4} {:>4} {:>10} {:>10} {:>8.1f} {:>8.3f}", row.at("robot").get<std::string>(),
      row.at("runs").get<int>(), row.at("succeeded").get<int>(),
      fmt::format("{} of {}", row.at("found").get<int>(), row.at("targets").get<int>()),
      row.at("collisions").get<int>(), row.at("busy_s").get<double>() / row.at("runs").get<int>(),
      row.at("bias_m").is_null() ? NAN : row.at("bias_m").get<double>());
  for (const Figure& figure : kFigures) {
    const auto value = [&](const char* key) {
      const Json& number = row.at(figure.name).at(key);
      return number.is_null() ? NAN : number.get<double>();
    };
    text += fmt::format(" {:>23}", fmt::format("{:.3f} ({:.3f} ... {:.3f})", value("estimate"),
                                               value("low"), value("high")));
  }
  return text + "\n";
}

std::vector<int> all_of(const Runs& runs) {
  std::vector<int> all(runs.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

double TeamRow::per_minute() const { return busy_s > 0 ? 60 * found / busy_s : NAN; }

std::vector<TeamRow> team_rows(const std::vector<Json>& results) {
  const Runs runs = runs_of(results);
  return pooled(runs, all_of(runs));
}

Json team_runs_json(const std::vector<Json>& results) {
  const Runs runs = runs_of(results);
  const std::string mission = results.front().at("mission");
  const std::vector<TeamRow> rows = pooled(runs, all_of(runs));
  Json table = Json::array(), compared = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) table.push_back(row_json(rows[i], i, runs));
  for (const PolicyComparison& c : comparisons_of(mission, runs)) {
    compared.push_back(comparison_json(c));
  }
  return {{"mission", mission}, {"runs", runs.size()}, {"table", table}, {"comparisons", compared}};
}

std::string team_runs_text(const std::vector<Json>& results) {
  const Runs runs = runs_of(results);
  std::string text = fmt::format("{:<10} {:>4} {:>4} {:>10} {:>10} {:>8} {:>8}", "robot", "runs",
                                 "ok", "found", "collisions", "time s", "bias m");
  for (const Figure& figure : kFigures) text += fmt::format(" {:>23}", figure.name);
  text += "\n";
  const std::vector<TeamRow> rows = pooled(runs, all_of(runs));
  for (std::size_t i = 0; i < rows.size(); ++i) text += row_text(row_json(rows[i], i, runs));
  return text + comparison_text(comparisons_of(results.front().at("mission"), runs));
}

}  // namespace saker::tools
