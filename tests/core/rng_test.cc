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

}  // namespace
}  // namespace saker::core
