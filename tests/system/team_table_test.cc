#include "tools/saker/mission/team_table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saker/core/rng.h"

namespace saker::tools {
namespace {

constexpr int kTargets = 4;

Json figures(double bias, double sd, core::Rng& rng) {
  Json errors = Json::array();
  for (int id = 1; id <= kTargets; ++id) {
    errors.push_back(
        {{"id", id}, {"length_m", rng.normal(bias, sd)}, {"width_m", rng.normal(bias, sd)}});
  }
  return {{"targets", kTargets}, {"found", kTargets}, {"errors", errors}};
}

/// Two robots whose errors share what is the seed's, and all together with half of them.
Json run(int seed) {
  core::Rng rng(static_cast<std::uint64_t>(seed));
  const double worlds = rng.normal(0.3, 0.2);
  Json robots = Json::array();
  for (const char* name : {"A", "B"}) {
    Json robot = figures(worlds, 0.02, rng);
    robot.update({{"robot", name},
                  {"succeeded", true},
                  {"collisions", seed == 3},
                  {"flight_time_s", 50 + seed},
                  {"exchange_s", 2}});
    robots.push_back(robot);
  }
  Json merged = figures(worlds - 0.1, 0.02, rng);
  merged["longest_s"] = 60;
  return {{"mission", "two"}, {"seed", seed}, {"robots", robots}, {"merged", merged}};
}

std::vector<Json> ten() {
  std::vector<Json> results;
  for (int seed = 1; seed <= 10; ++seed) results.push_back(run(seed));
  return results;
}

const Json& comparison(const Json& table, const std::string& against) {
  const Json& all = table.at("comparisons");
  return *std::ranges::find(all, against,
                            [](const Json& c) { return c.at("against").get<std::string>(); });
}

TEST(TeamTable, PutsTheSeedsOfEachRobotTogether) {
  const std::vector<TeamRow> rows = team_rows(ten());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].who, "A");
  EXPECT_EQ(rows[2].who, "together");
  EXPECT_EQ(rows[0].found, 10 * kTargets);
  EXPECT_EQ(rows[0].errors.size(), 20U * kTargets);
  EXPECT_EQ(rows[0].collisions, 1);
  EXPECT_EQ(rows[2].collisions, 2);
}

TEST(TeamTable, AMinuteIsOneOfFlightAndExchange) {
  const std::vector<TeamRow> rows = team_rows(ten());
  EXPECT_DOUBLE_EQ(rows[1].busy_s, 10 * 52 + 55);
  EXPECT_DOUBLE_EQ(rows[1].per_minute(), 60 * 40 / 575.0);
  EXPECT_DOUBLE_EQ(rows[2].per_minute(), kTargets);
}

/// The worlds' errors differ by 0.2 m, all together is better by 0.1 m in each.
TEST(TeamTable, ComparesAllTogetherWithEachRobotSeedBySeed) {
  const Json table = team_runs_json(ten());
  for (const char* against : {"A", "B", "robots' mean"}) {
    const Json& bias = comparison(table, against).at("figures").at("absolute_bias_m");
    EXPECT_EQ(bias.at("verdict"), "less") << against;
    EXPECT_NEAR(bias.at("difference").at("estimate").get<double>(), -0.1, 0.02);
    EXPECT_LT(bias.at("difference").at("high").get<double>(), -0.08);
    EXPECT_GT(bias.at("difference").at("low").get<double>(), -0.12);
  }
}

TEST(TeamTable, TheMeanOfTheRobotsIsTheMeanOfTheirFigures) {
  const Json table = team_runs_json(ten());
  const auto value = [&](int row, const char* figure) {
    return table.at("table").at(row).at(figure).at("estimate").get<double>();
  };
  const Json& sd = comparison(table, "robots' mean").at("figures").at("sd_m");
  EXPECT_NEAR(sd.at("theirs").get<double>(), (value(0, "sd_m") + value(1, "sd_m")) / 2, 1e-12);
}

TEST(TeamTable, OfOneSeedHasNoInterval) {
  const Json table = team_runs_json({run(1)});
  EXPECT_TRUE(table.at("table").at(0).at("mae_m").at("low").is_null());
  EXPECT_NE(team_runs_text({run(1)}).find("together"), std::string::npos);
}

}  // namespace
}  // namespace saker::tools
