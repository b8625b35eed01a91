#include "saker/uncertainty/random_effects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saker/core/rng.h"

namespace saker::uncertainty {
namespace {

const Eigen::Vector2d kParity(1, -1);

/// Intervals that are alike as they are.
std::vector<Eigen::VectorXd> alike(std::size_t intervals) {
  return {intervals, Eigen::VectorXd::Ones(2)};
}

/// Two intervals; errors of known bias (0.5 and -0.2, 0.1, times `lean`) and spread, an addition of
/// the object in its own frame.
std::vector<Draw> leaning(int objects, std::uint64_t seed, double lean) {
  core::Rng rng(seed);
  std::vector<Draw> draws;
  for (int object = 0; object < objects; ++object) {
    const Eigen::Vector2d addition(rng.normal(0, 0.3), rng.normal(0, 0.2));
    for (int interval = 0; interval < 2; ++interval) {
      for (const bool mirrored : {false, true}) {
        const double sd = interval == 0 ? 0.1 : 0.4;
        Eigen::Vector2d error(rng.normal(lean * (interval == 0 ? 0.5 : -0.2), sd),
                              rng.normal(lean * 0.1, sd));
        error += mirrored ? Eigen::Vector2d(addition.cwiseProduct(kParity)) : addition;
        draws.push_back({object, interval, mirrored, error});
      }
    }
  }
  return draws;
}

std::vector<Draw> made(int objects, std::uint64_t seed) { return leaning(objects, seed, 1); }

TEST(RandomEffectsTest, TellsWhatIsCommonFromWhatIsNot) {
  const RandomEffects effects = random_effects(made(2000, 1), alike(2), kParity, {});
  EXPECT_NEAR(std::sqrt(effects.common(0, 0)), 0.3, 0.02);
  EXPECT_NEAR(std::sqrt(effects.common(1, 1)), 0.2, 0.02);
  EXPECT_NEAR(std::sqrt(effects.covariance[0](0, 0)), 0.1, 0.02);
  EXPECT_NEAR(std::sqrt(effects.covariance[1](1, 1)), 0.4, 0.02);
}

TEST(RandomEffectsTest, RecoversTheBiasOfEachInterval) {
  const RandomEffects effects = random_effects(made(2000, 2), alike(2), kParity, {});
  EXPECT_NEAR(effects.bias[0][0], 0.5, 0.02);
  EXPECT_NEAR(effects.bias[1][0], -0.2, 0.02);
  EXPECT_NEAR(effects.bias[0][1], 0.1, 0.02);
}

TEST(RandomEffectsTest, WithoutACommonPartNoneIsFound) {
  core::Rng rng(3);
  std::vector<Draw> draws;
  for (int i = 0; i < 4000; ++i) {
    draws.push_back({i / 8, i % 2, false, Eigen::Vector2d(rng.normal(), rng.normal())});
  }
  const RandomEffects effects = random_effects(draws, alike(2), kParity, {});
  EXPECT_LT(effects.common(0, 0), 0.02);
  EXPECT_NEAR(effects.covariance[0](0, 0), 1, 0.1);
}

TEST(RandomEffectsTest, AnOutlierMovesABiasByABoundedAmount) {
  std::vector<Draw> draws = made(1000, 4);
  const RandomEffects before = random_effects(draws, alike(2), kParity, {});
  draws[0].error[0] += 1000;
  const RandomEffects after = random_effects(draws, alike(2), kParity, {});
  EXPECT_LT((after.bias[0] - before.bias[0]).norm(), 0.05);
  EXPECT_LT(after.covariance[0](0, 0), 2 * before.covariance[0](0, 0));
}

TEST(RandomEffectsTest, AboutTheTruthABiasIsPartOfTheSpread) {
  RandomEffectsConfig config;
  config.about_truth = true;
  const std::vector<Draw> draws = leaning(2000, 2, 0.2);  // leans by a standard deviation at most
  const RandomEffects effects = random_effects(draws, alike(2), kParity, config);
  for (int interval = 0; interval < 2; ++interval) {
    double squared = 0;
    for (const Draw& draw : draws) {
      if (draw.interval == interval) squared += draw.error[0] * draw.error[0] / 4000;
    }
    const auto at = static_cast<std::size_t>(interval);
    EXPECT_EQ(effects.bias[at], Eigen::VectorXd(Eigen::Vector2d::Zero()));
    EXPECT_NEAR(effects.covariance[at](0, 0) + effects.common(0, 0), squared, 0.1 * squared);
  }
}

TEST(RandomEffectsTest, ATailOfOneInTwentyMovesABiasLittle) {
  std::vector<Draw> draws = made(1000, 4);
  const RandomEffects before = random_effects(draws, alike(2), kParity, {});
  for (std::size_t i = 0; i < draws.size(); i += 40) draws[i].error[0] -= 2;  // of interval 0
  const RandomEffects after = random_effects(draws, alike(2), kParity, {});
  EXPECT_NEAR(after.bias[0][0], before.bias[0][0], 0.03);
  EXPECT_GT(after.covariance[0](0, 0), 2 * before.covariance[0](0, 0));
}

TEST(RandomEffectsTest, AnIntervalWithFewDrawsIsDrawnTowardsTheClass) {
  std::vector<Draw> draws = made(500, 5);
  draws.push_back({0, 2, false, Eigen::Vector2d(0.3, 0.1)});
  const RandomEffects effects = random_effects(draws, alike(3), kParity, {});
  const double sd = std::sqrt(effects.covariance[2](0, 0));
  EXPECT_GT(sd, 0.2);
  EXPECT_LT(sd, 0.5);
}

/// From the front the first entry leans with the second, from behind against it: an interval with a
/// few draws is like the class the way it looks from there.
TEST(RandomEffectsTest, TheClassIsTakenAsItLooksFromTheInterval) {
  core::Rng rng(7);
  std::vector<Draw> draws;
  for (int i = 0; i < 3000; ++i) {
    const int interval = i % 100 == 0 ? 2 : i % 2;
    const double sign = interval == 0 ? 1 : -1;
    const double near = rng.normal(0, 0.02), far = rng.normal(0, 0.2);
    draws.push_back({i / 4, interval, false, Eigen::Vector2d(sign * (near + far), near - far)});
  }
  const Eigen::Vector2d front(1, 1), behind(-1, 1);
  const Eigen::Vector2d parity(1, 1);
  const std::vector<Eigen::VectorXd> by_nearer = {front, behind, behind};
  const auto near_sd = [](const RandomEffects& effects) {
    const Eigen::MatrixXd of_new = effects.covariance[2] + effects.common;
    return std::sqrt(Eigen::Vector2d(-1, 1).dot(of_new * Eigen::Vector2d(-1, 1)));
  };
  EXPECT_LT(near_sd(random_effects(draws, by_nearer, parity, {})), 0.08);
  EXPECT_GT(near_sd(random_effects(draws, alike(3), parity, {})), 0.12);
}

}  // namespace
}  // namespace saker::uncertainty
