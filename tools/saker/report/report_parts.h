#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"
#include "tools/saker/report/html_page.h"

/// Rows of a report from what a run left. Keys of results.json that are not there give no row.
namespace saker::tools {

using ReportJson = nlohmann::ordered_json;

/// What a person asks first: what it came to, found, how well, how far, how long.
[[nodiscard]] std::vector<HtmlPage::Row> summary_rows(const ReportJson& results);

/// All numbers, words and truth values, by their keys; of lists how many they hold.
[[nodiscard]] std::vector<HtmlPage::Row> figure_rows(const ReportJson& results);

/// What was refused, left out or fell short, with its reason: {what, why, how often}.
[[nodiscard]] std::vector<HtmlPage::Row> refused_rows(const ReportJson& results);

/// {time, from and to, cause, text} of a mission's transitions.
[[nodiscard]] std::vector<HtmlPage::Row> event_rows(const ReportJson& results);

/// An object each, at most `most`: {id, class, seen, place, size ± standard deviation}.
[[nodiscard]] std::vector<HtmlPage::Row> object_rows(const objects::ObjectMap& map,
                                                     const objects::ClassTable& table,
                                                     std::size_t most);

}  // namespace saker::tools
