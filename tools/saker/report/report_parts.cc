#include "tools/saker/report/report_parts.h"

#include <fmt/format.h>

#include "saker/objects/object_numbers.h"

namespace saker::tools {
namespace {

constexpr std::size_t kMostScans = 100;  // not registered, by name; the rest is counted

/// A number, a word or a truth value, as a person reads it; "-": not known.
std::string words_of(const ReportJson& value) {
  if (value.is_null()) return "-";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.dump();
}

bool has(const ReportJson& json, const char* key) { return json.contains(key); }

void add_figures(const ReportJson& json, const std::string& key, std::vector<HtmlPage::Row>& rows) {
  if (json.is_object()) {
    for (const auto& [name, value] : json.items())
      add_figures(value, key.empty() ? name : fmt::format("{}.{}", key, name), rows);
  } else if (json.is_array()) {
    rows.push_back({key, fmt::format("{} entries", json.size())});
  } else {
    rows.push_back({key, words_of(json)});
  }
}

std::string with_deviation(double value, double sd) {
  return std::isfinite(sd) ? fmt::format("{:.2f} ± {:.2f}", value, sd)
                           : fmt::format("{:.2f}", value);
}

HtmlPage::Row row_of(const objects::MapObject& object, const objects::ClassTable& table) {
  const bool known = objects::has_covariance(object);
  const objects::CovarianceNumbers sd =
      known ? objects::covariance_numbers(object) : objects::CovarianceNumbers{};
  const Eigen::Vector3d at = objects::place(object.model);
  std::string size;
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&object.model)) {
    size = fmt::format("{} × {} × {:.2f} m", with_deviation(cuboid->size.x(), known ? sd[6] : NAN),
                       with_deviation(cuboid->size.y(), known ? sd[7] : NAN), cuboid->size.z());
  } else {
    const auto& cylinder = std::get<objects::Cylinder>(object.model);
    size = fmt::format("radius {:.3f} m, height {:.2f} m", cylinder.radius, cylinder.height);
  }
  return {fmt::format("{}", object.id), table[object.class_id].name,
          fmt::format("{} times", object.observations),
          fmt::format("{:.2f}, {:.2f}, {:.2f} m", at.x(), at.y(), at.z()), size};
}

void add_targets(const ReportJson& results, std::vector<HtmlPage::Row>& rows) {
  for (const ReportJson& target : results.value("target_list", ReportJson::array())) {
    const std::string status = target.value("status", "");
    if (status == "done" || status == "visited") continue;
    rows.push_back({fmt::format("target {}: {}", target.value("id", -1), status),
                    target.value("reason", ""), ""});
  }
}

void add_scans(const ReportJson& results, std::vector<HtmlPage::Row>& rows) {
  const ReportJson scans = results.value("scans_not_registered", ReportJson());
  if (!scans.is_array()) return;
  std::size_t named = 0;
  for (const ReportJson& scan : scans) {
    if (++named > kMostScans) break;
    rows.push_back({fmt::format("scan {}", scan.value("name", "")), scan.value("reason", ""), ""});
  }
  if (scans.size() > kMostScans)
    rows.push_back(
        {"more scans", "results.json has all", fmt::format("{}", scans.size() - kMostScans)});
}

}  // namespace

std::vector<HtmlPage::Row> summary_rows(const ReportJson& results) {
  std::vector<HtmlPage::Row> rows;
  const auto add = [&](const char* key, const std::string& what, const std::string& unit) {
    if (has(results, key) && !results.at(key).is_structured())
      rows.push_back({what, words_of(results.at(key)) + (unit.empty() ? "" : " " + unit)});
  };
  add("succeeded", "succeeded", "");
  if (has(results, "outcome"))
    rows.push_back({"ended", fmt::format("{}, phase {}", words_of(results.at("outcome")),
                                         results.value("phase", "-"))});
  if (has(results, "found") && has(results, "targets"))
    rows.push_back({"targets found", fmt::format("{} of {}", words_of(results.at("found")),
                                                 words_of(results.at("targets")))});
  add("mae_m", "length and width, mean absolute error", "m");
  add("collisions", "collisions", "");
  add("min_clearance_m", "least clearance", "m");
  add("flight_time_s", "in the air", "s");
  add("path_m", "path", "m");
  add("scans", "scans", "");
  add("duration_s", "recording", "s");
  if (has(results, "objects") && results.at("objects").is_object()) {
    for (const auto& [name, count] : results.at("objects").items())
      rows.push_back({fmt::format("mapped: {}", name), words_of(count)});
  }
  return rows;
}

std::vector<HtmlPage::Row> figure_rows(const ReportJson& results) {
  std::vector<HtmlPage::Row> rows;
  add_figures(results, "", rows);
  return rows;
}

std::vector<HtmlPage::Row> refused_rows(const ReportJson& results) {
  std::vector<HtmlPage::Row> rows;
  for (const ReportJson& line : results.value("shortfalls", ReportJson::array()))
    rows.push_back({"falls short", words_of(line), ""});
  add_targets(results, rows);
  const ReportJson refusals = results.value("refusals", ReportJson::object());
  for (const auto& [cause, count] : refusals.items())
    rows.push_back({"plan", cause, words_of(count)});
  add_scans(results, rows);
  return rows;
}

std::vector<HtmlPage::Row> event_rows(const ReportJson& results) {
  std::vector<HtmlPage::Row> rows;
  for (const ReportJson& event : results.value("events", ReportJson::array()))
    rows.push_back({fmt::format("{:.2f} s", event.value("t_s", 0.0)),
                    fmt::format("{} → {}", event.value("from", ""), event.value("to", "")),
                    event.value("cause", ""), event.value("text", "")});
  return rows;
}

std::vector<HtmlPage::Row> object_rows(const objects::ObjectMap& map,
                                       const objects::ClassTable& table, std::size_t most) {
  std::vector<HtmlPage::Row> rows;
  for (const objects::MapObject& object : map.objects) {
    if (rows.size() == most) break;
    rows.push_back(row_of(object, table));
  }
  return rows;
}

}  // namespace saker::tools
