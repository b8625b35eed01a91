#include "tools/saker/experiment/experiment_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;

Json run(const std::string& scenario, const std::string& policy,
         const std::vector<std::pair<double, double>>& errors, double clearance) {
  Json list = Json::array(), targets = Json::array();
  for (const auto& [length, width] : errors) {
    const std::size_t id = list.size() + 1;
    list.push_back({{"id", id}, {"length_m", length}, {"width_m", width}});
    targets.push_back({{"id", id}, {"status", "done"}});
  }
  return {{"scenario", scenario},
          {"policy", policy},
          {"seed", 1},
          {"target_list", targets},
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

TEST(ExperimentTable, WhatOnePolicyReachesIsReachableForAll) {
  Json came = run("garage", "visit", {{0.1, 0.1}}, 1);
  came["target_list"].push_back({{"id", 7}, {"status", "visited"}});  // but not mapped
  Json gave_up = run("garage", "paper", {}, 1);
  gave_up["target_list"] = {{{"id", 1}, {"status", "unreachable"}},
                            {{"id", 7}, {"status", "unreachable"}},
                            {{"id", 9}, {"status", "unreachable"}}};
  const auto rows = pool({came, gave_up});
  EXPECT_EQ(rows[0].reachable, 2);
  EXPECT_DOUBLE_EQ(rows[0].mapped_share(), 0.5);
  EXPECT_EQ(rows[1].reachable, 2);
  EXPECT_DOUBLE_EQ(rows[1].mapped_share(), 0);
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
