#include "tools/saker/experiment/calibration.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

namespace saker::tools {
namespace {

/// Predicted between 0.05 and 0.3 m; the errors are `factor` times as large.
std::vector<Outcome> outcomes(int count, double factor) {
  core::Rng rng(1);
  std::vector<Outcome> list;
  for (int i = 0; i < count; ++i) {
    const double sd = rng.uniform(0.05, 0.3);
    list.push_back({sd, rng.normal(0, factor * sd)});
  }
  return list;
}

TEST(Calibration, OfAnHonestPredictionHasARatioOfOneInEveryBin) {
  const auto bins = calibration(outcomes(4000, 1), 400, 10);
  ASSERT_EQ(bins.size(), 10U);
  for (const CalibrationBin& bin : bins) EXPECT_NEAR(bin.ratio(), 1, 0.12);
}

TEST(Calibration, OfAPredictionTwiceTooGoodIsTwo) {
  for (const CalibrationBin& bin : calibration(outcomes(4000, 2), 400)) {
    EXPECT_NEAR(bin.ratio(), 2, 0.25);
  }
}

TEST(Calibration, HasAtLeastFiftyOutcomesInEachBinAndLosesNone) {
  const auto bins = calibration(outcomes(239, 1));
  ASSERT_EQ(bins.size(), 4U);
  int sum = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    EXPECT_GE(bins[i].outcomes, 50);
    if (i > 0) {
      EXPECT_GE(bins[i].lowest_sd, bins[i - 1].highest_sd);
    }
    sum += bins[i].outcomes;
  }
  EXPECT_EQ(sum, 239);
}

TEST(Calibration, HasFiveBinsHoweverManyOutcomesThereAre) {
  const auto bins = calibration(outcomes(700, 1));
  ASSERT_EQ(bins.size(), 5U);
  for (const CalibrationBin& bin : bins) EXPECT_EQ(bin.outcomes, 140);
}

TEST(Calibration, OfTooFewIsOneBinAndOfNoneNone) {
  ASSERT_EQ(calibration(outcomes(7, 1)).size(), 1U);
  EXPECT_EQ(calibration(outcomes(7, 1))[0].outcomes, 7);
  EXPECT_TRUE(calibration({}).empty());
  EXPECT_TRUE(calibration(std::vector<Outcome>{{NAN, 0.1}, {0.1, NAN}}).empty());
}

}  // namespace
}  // namespace saker::tools
