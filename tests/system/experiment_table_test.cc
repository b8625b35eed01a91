#include "tools/saker/experiment/experiment_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;

Json run(const std::string& scenario, const std::string& policy,
         const std::vector<std::pair<double, double>>& errors, double clearance) {
  Json list = Json::array();
  for (const auto& [length, width] : errors) {
    list.push_back({{"id", list.size() + 1}, {"length_m", length}, {"width_m", width}});
  }
  return {{"scenario", scenario},
          {"policy", policy},
          {"seed", 1},
          {"reachable_targets", {1, 2}},
          {"succeeded", true},
          {"targets", 2},
          {"found", list.size()},
          {"errors", list},
          {"collisions", 1},
          {"min_clearance_m", clearance},
          {"trajectory_error_m", 0.1},
          {"flight_time_s", 100.0},
          {"path_m", 50.0}};
}

TEST(ExperimentTable, PoolsTheErrorsOfAllObjectsNotTheMeansOfRuns) {
  const auto rows = pool({run("street", "visit", {{0.4, 0.4}, {0.4, 0.4}}, 1),
                          run("street", "visit", {{-0.2, -0.2}}, 0.7)});
  ASSERT_EQ(rows.size(), 1U);
  const Json row = row_json(rows[0]);
  EXPECT_NEAR(row["bias_m"].get<double>(), (4 * 0.4 - 2 * 0.2) / 6, 1e-12);
  EXPECT_NEAR(row["mae_m"].get<double>(), (4 * 0.4 + 2 * 0.2) / 6, 1e-12);
  EXPECT_NEAR(row["sd_m"].get<double>(), std::sqrt((4 * 0.04 + 2 * 0.16) / 5), 1e-12);
  EXPECT_EQ(row["targets"], 4);
  EXPECT_EQ(row["found"], 3);
  EXPECT_EQ(row["collisions"], 2);
  EXPECT_EQ(row["min_clearance_m"], 0.7);
  EXPECT_EQ(row["flight_time_s"], 100.0);
}

TEST(ExperimentTable, HasARowForEachScenarioAndPolicyAndOneForAll) {
  const auto rows = pool({run("street", "a", {}, 1), run("street", "b", {}, 1),
                          run("garage", "a", {}, 1), run("garage", "b", {}, 1)});
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[2].scenario, "garage");
  EXPECT_EQ(rows[4].scenario, "all");
  EXPECT_EQ(rows[4].policy, "a");
  EXPECT_EQ(rows[4].runs, 2);
}

TEST(ExperimentTable, OfRunsThatFoundNothingHasNoErrors) {
  Json nothing = run("street", "visit", {}, 1);
  nothing["min_clearance_m"] = nullptr;
  nothing["trajectory_error_m"] = nullptr;
  const auto rows = pool({nothing});
  const Json row = row_json(rows[0]);
  EXPECT_TRUE(row["bias_m"].is_null());
  EXPECT_TRUE(row["min_clearance_m"].is_null());
  EXPECT_TRUE(row["trajectory_error_m"].is_null());
  EXPECT_EQ(row["found"], 0);
}

TEST(ExperimentTable, MappedIsTheShareOfTheTargetsThatCanBeReached) {
  Json one_of_two = run("garage", "visit", {{0.1, 0.1}}, 1);
  Json all = run("garage", "visit", {{0.1, 0.1}, {0.1, 0.1}}, 1);
  Json none = run("garage", "visit", {}, 1);
  none["reachable_targets"] = {2};
  const auto rows = pool({one_of_two, all, none});
  EXPECT_EQ(rows[0].reachable, 2 + 2 + 1);
  EXPECT_EQ(rows[0].reachable_found, 1 + 2);
  EXPECT_DOUBLE_EQ(rows[0].mapped_share(), 0.6);
}

TEST(ExperimentTable, WhatIsDiscoveredBesideTheTargetsDoesNotMakeMappedLess) {
  Json run_of_all = run("garage", "visit", {{0.1, 0.1}, {0.1, 0.1}}, 1);
  run_of_all["target_list"] = {{{"id", 1}, {"status", "done"}},
                               {{"id", 2}, {"status", "done"}},
                               {{"id", 1000}, {"status", "visited"}}};
  EXPECT_DOUBLE_EQ(pool({run_of_all})[0].mapped_share(), 1);
}

TEST(ExperimentTable, WhatIsFoundThoughNoViewpointHasItDoesNotMakeMappedMore) {
  Json from_afar = run("garage", "visit", {{0.1, 0.1}}, 1);
  from_afar["reachable_targets"] = {2};
  EXPECT_EQ(pool({from_afar})[0].found, 1);
  EXPECT_DOUBLE_EQ(pool({from_afar})[0].mapped_share(), 0);
}

TEST(ExperimentTable, HasTheErrorsOfLengthAndOfWidthAlone) {
  const Json row = row_json(pool({run("street", "visit", {{0.4, -0.1}, {0.2, -0.3}}, 1)})[0]);
  EXPECT_NEAR(row["length"]["bias_m"].get<double>(), 0.3, 1e-12);
  EXPECT_NEAR(row["width"]["bias_m"].get<double>(), -0.2, 1e-12);
  EXPECT_NEAR(row["width"]["mae_m"].get<double>(), 0.2, 1e-12);
  EXPECT_NEAR(row["length"]["sd_m"].get<double>(), std::sqrt(0.02), 1e-12);
}

TEST(ExperimentTable, AddsTheObjectsOfEachClass) {
  Json first = run("street", "visit", {}, 1), second = first;
  first["classes"] = {{"trunk", {{"mapped", 9}, {"invented", 2}, {"duplicates", 1}}}};
  second["classes"] = {{"trunk", {{"mapped", 4}, {"invented", 1}, {"duplicates", 0}}}};
  const Json trunks = row_json(pool({first, second})[0])["classes"]["trunk"];
  EXPECT_EQ(trunks, Json({{"mapped", 13}, {"invented", 3}, {"duplicates", 1}}));
}

TEST(ExperimentTable, ShowsTheDistributionBesideMeanAndSpread) {
  const auto rows = pool({run("street", "visit", {{0, 0.1}, {0.2, 0.3}, {0.4, 0.4}}, 1)});
  const Json quantiles = row_json(rows[0])["quantiles_m"];
  EXPECT_NEAR(quantiles["50"].get<double>(), 0.25, 1e-12);
  EXPECT_LT(quantiles["5"].get<double>(), 0.05);
  EXPECT_GT(quantiles["95"].get<double>(), 0.35);
}

TEST(ExperimentTable, PoolsConsistencyByObjectsNotByRuns) {
  const auto with = [](int objects, double nees) {
    Json flown = run("street", "visit", {}, 1);
    const auto mean = [&](double value) { return objects > 0 ? Json(value) : Json(); };
    flown["consistency"] = {
        {"trunk", {{"objects", objects}, {"size_nees", mean(nees)}, {"place_nees", mean(1)}}}};
    return flown;
  };
  const auto rows = pool({with(3, 1.0), with(0, NAN), with(1, 5.0), run("street", "visit", {}, 1)});
  ASSERT_EQ(rows.size(), 1U);
  const Json trunks = row_json(rows[0])["consistency"]["trunk"];
  EXPECT_EQ(trunks["objects"], 4);
  EXPECT_DOUBLE_EQ(trunks["size_nees"].get<double>(), 2.0);
  EXPECT_DOUBLE_EQ(trunks["place_nees"].get<double>(), 1.0);
  const std::string text = consistency_text(rows);
  EXPECT_NE(text.find("trunk"), std::string::npos);
  EXPECT_NE(text.find("2.00"), std::string::npos);
  EXPECT_EQ(consistency_text(pool({run("street", "visit", {}, 1)})), "");
}

TEST(ExperimentTable, TextHasALineForEachRowUnderItsHeads) {
  const std::string text = table_text(pool({run("street", "visit", {{0.4, 0.4}}, 1)}));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_NE(text.find("1 of 2"), std::string::npos);
}

}  // namespace
}  // namespace saker::tools
