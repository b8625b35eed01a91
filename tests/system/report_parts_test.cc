#include "tools/saker/report/report_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace saker::tools {
namespace {

using Rows = std::vector<HtmlPage::Row>;

/// The second cell of the row that begins so; empty where there is none.
std::string value_of(const Rows& rows, const std::string& what) {
  const auto at = std::ranges::find(rows, what, [](const auto& row) { return row.front(); });
  return at == rows.end() ? "" : at->at(1);
}

const ReportJson kMission = ReportJson::parse(R"({
  "succeeded": false, "phase": "done", "outcome": "battery", "targets": 8, "found": 7,
  "mae_m": 0.0231, "collisions": 0, "min_clearance_m": null, "flight_time_s": 61.25,
  "refusals": {"refused: no path": 3}, "errors": [{}, {}], "trajectory": {"position_rmse_m": 0.5},
  "target_list": [{"id": 4, "status": "done", "reason": "seen"},
                  {"id": 5, "status": "unreachable", "reason": "closed in"}],
  "events": [{"t_s": 1.5, "from": "preflight", "to": "takeoff", "cause": "armed", "text": "go"}]})");

TEST(ReportParts, TheSummarySaysHowItEndedAndHowWell) {
  const Rows rows = summary_rows(kMission);
  EXPECT_EQ(value_of(rows, "succeeded"), "no");
  EXPECT_EQ(value_of(rows, "ended"), "battery, phase done");
  EXPECT_EQ(value_of(rows, "targets found"), "7 of 8");
  EXPECT_EQ(value_of(rows, "length and width, mean absolute error"), "0.0231 m");
  EXPECT_EQ(value_of(rows, "least clearance"), "- m");
  EXPECT_EQ(value_of(rows, "in the air"), "61.25 s");
}

TEST(ReportParts, OfAReplayTheSummaryCountsObjectsByClass) {
  const Rows rows = summary_rows(ReportJson::parse(R"({"scans": 9, "objects": {"pole": 3}})"));
  EXPECT_EQ(value_of(rows, "scans"), "9");
  EXPECT_EQ(value_of(rows, "mapped: pole"), "3");
}

TEST(ReportParts, EveryFigureHasItsWholeKey) {
  const Rows rows = figure_rows(kMission);
  EXPECT_EQ(value_of(rows, "trajectory.position_rmse_m"), "0.5");
  EXPECT_EQ(value_of(rows, "errors"), "2 entries");
  EXPECT_EQ(value_of(rows, "min_clearance_m"), "-");
}

TEST(ReportParts, WhatWasRefusedIsSaidWithItsReason) {
  const Rows rows = refused_rows(kMission);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0], (HtmlPage::Row{"target 5: unreachable", "closed in", ""}));
  EXPECT_EQ(rows[1], (HtmlPage::Row{"plan", "refused: no path", "3"}));
}

TEST(ReportParts, OfManyScansThatWereNotRegisteredTheRestIsCounted) {
  ReportJson results = {{"shortfalls", {"too few"}}, {"scans_not_registered", ReportJson::array()}};
  for (int i = 0; i < 130; ++i)
    results["scans_not_registered"].push_back({{"name", "000001"}, {"reason", "too fast"}});
  const Rows rows = refused_rows(results);
  ASSERT_EQ(rows.size(), 102u);
  EXPECT_EQ(rows.front(), (HtmlPage::Row{"falls short", "too few", ""}));
  EXPECT_EQ(rows[1], (HtmlPage::Row{"scan 000001", "too fast", ""}));
  EXPECT_EQ(rows.back().back(), "30");
}

TEST(ReportParts, OfAMissionsScansTheNumberIsAFigureAlone) {
  EXPECT_TRUE(refused_rows(ReportJson::parse(R"({"scans_not_registered": 4})")).empty());
}

TEST(ReportParts, TransitionsAreInTheirOrderWithTimeAndCause) {
  const Rows rows = event_rows(kMission);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0], (HtmlPage::Row{"1.50 s", "preflight → takeoff", "armed", "go"}));
}

TEST(ReportParts, AnObjectIsSaidWithItsSizeAndStandardDeviation) {
  objects::MapObject object;
  object.id = 3;
  object.class_id = 1;
  object.observations = 12;
  objects::Cuboid cuboid;
  cuboid.pose.translation() << 1, 2, 0.5;
  cuboid.size << 4.5, 1.8, 1.5;
  object.model = cuboid;
  Eigen::Matrix<double, 9, 1> sd;
  sd << 0.01, 0.01, 0.01, 0.3, 0.1, 0.05, 0.04, 0.02, 0.06;
  object.covariance = sd.cwiseAbs2().asDiagonal();
  objects::ObjectMap map;
  map.objects = {object, object};
  const Rows rows = object_rows(map, {}, 1);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0], (HtmlPage::Row{"3", "vehicle", "12 times", "1.00, 2.00, 0.50 m",
                                    "4.50 ± 0.04 × 1.80 ± 0.02 × 1.50 m"}));
}

}  // namespace
}  // namespace saker::tools
