#include "saker/core/bootstrap.h"

#include <gtest/gtest.h>

#include <vector>

#include "saker/core/rng.h"
#include "saker/core/statistics.h"

namespace saker::core {
namespace {

std::vector<double> drawn(int count, double mean, double sd, Rng& rng) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(rng.normal(mean, sd));
  return values;
}

Statistic mean_of(const std::vector<double>& values) {
  return [&values](std::span<const int> units) {
    double sum = 0;
    for (const int i : units) sum += values[static_cast<std::size_t>(i)];
    return sum / static_cast<double>(units.size());
  };
}

TEST(Bootstrap, CoversTheTruthAboutAsOftenAsItSays) {
  constexpr int kTrials = 400;
  Rng rng(1);
  int covered = 0;
  for (int i = 0; i < kTrials; ++i) {
    const std::vector<double> values = drawn(60, 0.3, 1, rng);
    const auto seed = static_cast<std::uint64_t>(i);
    covered += !bootstrap(60, mean_of(values), {.resamples = 500, .seed = seed}).excludes(0.3);
  }
  EXPECT_GT(covered, 0.91 * kTrials);  // 0.94 ± 0.012 for means of 60
  EXPECT_LT(covered, 0.975 * kTrials);
}

TEST(Bootstrap, IsAsWideAsTheMeanScatters) {
  Rng rng(2);
  const std::vector<double> values = drawn(400, 0, 2, rng);
  const Interval interval = bootstrap(400, mean_of(values));
  EXPECT_NEAR(interval.high - interval.low, 2 * 1.96 * 2 / 20, 0.05);
  EXPECT_DOUBLE_EQ(interval.estimate, mean(values));
}

TEST(Bootstrap, ExcludesZeroWhereTheDifferenceIsLargeAndNotWhereThereIsNone) {
  Rng rng(3);
  const std::vector<double> large = drawn(30, 1, 1, rng);
  EXPECT_TRUE(bootstrap(30, mean_of(large)).excludes(0));
  std::vector<double> none = drawn(30, 0, 1, rng);
  for (std::size_t i = 0; i < 15; ++i) none[i + 15] = -none[i];
  EXPECT_FALSE(bootstrap(30, mean_of(none)).excludes(0));
}

TEST(Bootstrap, PairsTakeAwayWhatBothSidesHaveInCommon) {
  Rng rng(4);
  const std::vector<double> world = drawn(30, 0, 5, rng), noise = drawn(30, -0.5, 0.3, rng);
  std::vector<double> other(30);
  for (std::size_t i = 0; i < 30; ++i) other[i] = world[i] + noise[i];
  const Interval paired = bootstrap(30, [&](std::span<const int> units) {
    return mean_of(other)(units) - mean_of(world)(units);
  });
  EXPECT_LT(paired.high, 0);
  EXPECT_GT(paired.low, -0.7);
}

TEST(Bootstrap, TheSameSeedGivesTheSameIntervalAndAnotherSeedAnother) {
  Rng rng(5);
  const std::vector<double> values = drawn(20, 0, 1, rng);
  const auto low = [&](std::uint64_t seed) {
    return bootstrap(20, mean_of(values), {.seed = seed}).low;
  };
  EXPECT_EQ(low(7), low(7));
  EXPECT_NE(low(7), low(8));
}

TEST(Bootstrap, OfOneUnitOrWithoutAFigureSaysNothing) {
  const std::vector<double> one = {2.0};
  EXPECT_EQ(bootstrap(1, mean_of(one)).estimate, 2);
  EXPECT_TRUE(std::isnan(bootstrap(1, mean_of(one)).low));
  const Interval none = bootstrap(5, [](std::span<const int>) { return NAN; });
  EXPECT_TRUE(std::isnan(none.high));
  EXPECT_FALSE(none.excludes(0));
}

}  // namespace
}  // namespace saker::core
