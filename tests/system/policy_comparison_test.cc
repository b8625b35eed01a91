#include "tools/saker/experiment/policy_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saker/core/rng.h"

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kTargets = 3;

/// A mission whose errors are `sd` wide about `bias`, shifted by what is the world's.
Json mission(const std::string& scenario, const std::string& policy, int seed, double bias,
             double sd, double time, core::Rng& rng) {
  Json errors = Json::array(), targets = Json::array();
  for (int id = 1; id <= kTargets; ++id) {
    errors.push_back(
        {{"id", id}, {"length_m", rng.normal(bias, sd)}, {"width_m", rng.normal(bias, sd)}});
    targets.push_back(id);
  }
  return {{"scenario", scenario}, {"policy", policy},
          {"seed", seed},         {"succeeded", true},
          {"targets", kTargets},  {"found", kTargets},
          {"errors", errors},     {"reachable_targets", targets},
          {"collisions", 0},      {"min_clearance_m", 1.0},
          {"path_m", 2 * time},   {"trajectory_error_m", 0.1},
          {"flight_time_s", time}};
}

std::vector<Json> experiment(double our_bias, double our_sd, double our_time) {
  core::Rng rng(1);
  std::vector<Json> results;
  for (const char* scenario : {"street", "garage"}) {
    for (int seed = 1; seed <= 10; ++seed) {
      results.push_back(mission(scenario, "visit", seed, 0.4, 0.3, 100 + 10 * seed, rng));
      results.push_back(
          mission(scenario, "saker", seed, our_bias, our_sd, our_time + 10 * seed, rng));
    }
  }
  return results;
}

const FigureComparison& figure(const PolicyComparison& comparison, const std::string& name) {
  return *std::ranges::find(comparison.figures, name, &FigureComparison::figure);
}

TEST(PolicyComparison, IsMadeForEachScenarioAndForAll) {
  const auto comparisons = compare_policies(experiment(0.1, 0.1, 100));
  ASSERT_EQ(comparisons.size(), 3U);
  EXPECT_EQ(comparisons[0].scenario, "street");
  EXPECT_EQ(comparisons[0].missions, 10);
  EXPECT_EQ(comparisons[2].scenario, "all");
  EXPECT_EQ(comparisons[2].missions, 20);
  EXPECT_EQ(comparisons[2].policy, "saker");
  EXPECT_EQ(comparisons[2].against, "visit");
}

TEST(PolicyComparison, SaysLessWhereTheErrorIsLessAndTheIntervalExcludesZero) {
  const PolicyComparison all = compare_policies(experiment(0.1, 0.1, 100)).back();
  EXPECT_EQ(figure(all, "mae_m").verdict(), "less");
  EXPECT_LT(figure(all, "mae_m").difference.high, 0);
  EXPECT_EQ(figure(all, "sd_m").verdict(), "less");
  EXPECT_NEAR(figure(all, "sd_m").ratio.estimate, 1.0 / 3, 0.1);
}

TEST(PolicyComparison, SaysNothingWhereBothAreAlike) {
  const PolicyComparison all = compare_policies(experiment(0.4, 0.3, 100)).back();
  EXPECT_EQ(figure(all, "mae_m").verdict(), "-");
  EXPECT_EQ(figure(all, "flight_time_s").verdict(), "-");
  EXPECT_EQ(figure(all, "mapped_share").ratio.estimate, 1);
}

/// The missions' times differ by 90 s, the policies' by 3 s in each.
TEST(PolicyComparison, IsPairedByMission) {
  const PolicyComparison all = compare_policies(experiment(0.4, 0.3, 103)).back();
  EXPECT_EQ(figure(all, "flight_time_s").verdict(), "more");
  EXPECT_NEAR(figure(all, "flight_time_s").difference.low, 3, 1e-9);
  EXPECT_NEAR(figure(all, "flight_time_s").difference.high, 3, 1e-9);
}

TEST(PolicyComparison, UsesMissionsOnlyThatBothFlew) {
  std::vector<Json> results = experiment(0.1, 0.1, 100);
  std::erase_if(results, [](const Json& run) {
    return run.at("policy") == "saker" && run.at("seed").get<int>() > 4;
  });
  EXPECT_EQ(compare_policies(results).back().missions, 8);
}

TEST(PolicyComparison, OfOnePolicyThereIsNone) {
  std::vector<Json> results = experiment(0.1, 0.1, 100);
  std::erase_if(results, [](const Json& run) { return run.at("policy") == "saker"; });
  EXPECT_TRUE(compare_policies(results).empty());
  EXPECT_EQ(comparison_text({}), "");
}

TEST(PolicyComparison, TextAndJsonNameTheVerdict) {
  const auto comparisons = compare_policies(experiment(0.1, 0.1, 100));
  EXPECT_NE(comparison_text(comparisons).find("less"), std::string::npos);
  EXPECT_EQ(comparison_json(comparisons.back())["figures"]["mae_m"]["verdict"], "less");
}

}  // namespace
}  // namespace saker::tools
