#include "saker/core/rng.h"

#include <gtest/gtest.h>

#include <vector>

#include "saker/core/statistics.h"

namespace saker::core {
namespace {

std::vector<double> draw(Rng rng, int n, double (Rng::*f)()) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back((rng.*f)());
  return values;
}

TEST(Rng, TheSameSeedGivesTheSameNumbers) {
  EXPECT_EQ(draw(Rng(3), 100, &Rng::uniform), draw(Rng(3), 100, &Rng::uniform));
  EXPECT_NE(draw(Rng(3), 100, &Rng::uniform), draw(Rng(4), 100, &Rng::uniform));
}

TEST(Rng, AForkDoesNotDependOnWhatWasDrawn) {
  Rng drawn(5);
  (void)drawn.uniform();
  EXPECT_EQ(draw(drawn.fork(2), 10, &Rng::uniform), draw(Rng(5).fork(2), 10, &Rng::uniform));
  EXPECT_NE(draw(Rng(5).fork(2), 10, &Rng::uniform), draw(Rng(5).fork(3), 10, &Rng::uniform));
}

TEST(Rng, MomentsOfTheDistributions) {
  const int n = 100'000;
  const auto uniform = draw(Rng(1), n, &Rng::uniform);
  EXPECT_NEAR(mean(uniform), 0.5, 0.005);
  EXPECT_NEAR(standard_deviation(uniform), std::sqrt(1.0 / 12), 0.005);
  const auto normal = draw(Rng(2), n, &Rng::normal);
  EXPECT_NEAR(mean(normal), 0, 0.015);
  EXPECT_NEAR(standard_deviation(normal), 1, 0.01);
  EXPECT_NEAR(percentile(normal, 0.975), 1.96, 0.03);
}

TEST(Rng, IndexCoversItsRange) {
  Rng rng(9);
  std::vector<int> counts(7, 0);
  for (int i = 0; i < 7000; ++i) ++counts.at(rng.index(7));
  for (const int c : counts) EXPECT_NEAR(c, 1000, 150);
}

/// By another program: SplitMix64 (Steele et al., OOPSLA 2014) of the seed, then MT19937-64
/// (Nishimura, ACM TOMACS 2000), its upper 53 bits.
TEST(Rng, GivesTheNumbersOfItsPublishedGenerators) {
  EXPECT_EQ(draw(Rng(1), 3, &Rng::uniform),
            (std::vector{0.5324652433825516, 0.8926985632057755, 0.8904958874189624}));
  EXPECT_EQ(draw(Rng(2026), 2, &Rng::uniform),
            (std::vector{0.4674006024001115, 0.4522310101660524}));
  EXPECT_EQ(draw(Rng(1).fork(2), 1, &Rng::uniform), (std::vector{0.8261705379050209}));
}

TEST(Rng, UniformStaysWithinItsEnds) {
  Rng rng(4);
  for (int i = 0; i < 10000; ++i) {
    const double value = rng.uniform(-3, 5);
    EXPECT_GE(value, -3);
    EXPECT_LT(value, 5);
  }
}

TEST(Rng, ChanceIsAsOftenAsItsProbability) {
  Rng rng(5);
  int often = 0;
  for (int i = 0; i < 20000; ++i) {
    often += rng.chance(0.3);
    EXPECT_FALSE(rng.chance(0));
    EXPECT_TRUE(rng.chance(1));
  }
  EXPECT_NEAR(often, 6000, 300);
}

TEST(Rng, NormalHasTheMeanAndDeviationAsked) {
  Rng rng(6);
  std::vector<double> values;
  for (int i = 0; i < 50000; ++i) values.push_back(rng.normal(7, 0.5));
  EXPECT_NEAR(mean(values), 7, 0.01);
  EXPECT_NEAR(standard_deviation(values), 0.5, 0.01);
}

TEST(Rng, StreamsOfNeighbouringSeedsAndForksAreIndependent) {
  const int n = 20000;
  const auto correlation = [&](Rng a, Rng b) {
    const auto x = draw(a, n, &Rng::normal), y = draw(b, n, &Rng::normal);
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += x[i] * y[i] / n;
    return sum;
  };
  EXPECT_NEAR(correlation(Rng(1), Rng(2)), 0, 0.03);
  EXPECT_NEAR(correlation(Rng(1).fork(0), Rng(1).fork(1)), 0, 0.03);
  EXPECT_NEAR(correlation(Rng(1), Rng(1).fork(0)), 0, 0.03);
}

}  // namespace
}  // namespace saker::core
