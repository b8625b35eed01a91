#include "saker/active/views/path_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "saker/core/rng.h"

namespace saker::active {
namespace {

using Eigen::Matrix4d;

Covariance noise(double variance) { return variance * Matrix4d::Identity(); }

/// Stops at places in the plane, a second a metre; each tells of object 0, from a cell of its own.
PathProblem problem_at(const std::vector<Eigen::Vector2d>& places,
                       const std::vector<double>& variances, int horizon) {
  const int count = static_cast<int>(places.size());
  PathProblem problem;
  problem.objects = {Belief(noise(0.25), noise(0))};
  problem.drifted_m = {0};
  problem.to_m = problem.on_s = Eigen::VectorXd::Zero(count);
  problem.between_m = Eigen::MatrixXd::Zero(count, count);
  for (int i = 0; i < count; ++i) {
    problem.stops.push_back({{0, i, {noise(variances[i])}}});
    problem.to_m[i] = places[i].norm();
    for (int j = 0; j < count; ++j) problem.between_m(i, j) = (places[i] - places[j]).norm();
  }
  problem.to_s = problem.to_m;
  problem.between_s = problem.between_m;
  problem.horizon = horizon;
  problem.most_paths = 1e6;
  problem.beam = 10;
  return problem;
}

/// Full covariances, shared cells, two objects.
PathProblem random_problem(core::Rng& rng, int stops, int horizon) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < stops; ++i) places.emplace_back(10 * rng.normal(), 10 * rng.normal());
  PathProblem problem = problem_at(places, std::vector<double>(stops, 1.0), horizon);
  problem.objects.assign(2, Belief(noise(0.25), noise(0.003)));
  problem.drifted_m = {0, 0};
  for (auto& measurements : problem.stops) {
    measurements.clear();
    for (int object = 0; object < 2; ++object) {
      Matrix4d root;
      for (double& x : root.reshaped()) x = 0.15 * rng.normal();
      const Covariance covariance = root * root.transpose() + 0.005 * Matrix4d::Identity();
      const int cell = static_cast<int>(8 * rng.uniform());
      if (object == 0 || rng.uniform() < 0.3) measurements.push_back({object, cell, {covariance}});
    }
  }
  return problem;
}

std::vector<Eigen::Vector2d> on_a_line(int count) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < count; ++i) places.emplace_back(i + 1.0, 0.0);
  return places;
}

TEST(Paths, AreAsManyAsTheVariations) {
  for (const int a : {1, 4, 7, 12}) {
    for (const int T : {1, 2, 3}) {
      const PathProblem problem = problem_at(on_a_line(a), std::vector<double>(a, 0.04), T);
      const PathChoice choice = choose_path(problem);
      const int length = std::min(a, T);
      double expected = 1;
      for (int i = 0; i < length; ++i) expected *= a - i;
      EXPECT_TRUE(choice.exhaustive);
      EXPECT_EQ(choice.paths, static_cast<long>(expected));
      EXPECT_EQ(variations(a, length), expected);
    }
  }
}

TEST(Paths, GainOfASetIsThatOfItsSumWhateverTheOrder) {
  const std::vector<double> variances = {0.01, 0.09, 0.04};
  const PathProblem problem = problem_at(on_a_line(3), variances, 3);
  double information = 1 / 0.25;
  for (const double variance : variances) information += 1 / variance;
  const double expected = 2 * std::log(0.25 * information);  // 4 × ½ ln of the variances' ratio
  std::vector<int> order = {0, 1, 2};
  do {
    EXPECT_NEAR(path_through(problem, order).gain, expected, 1e-12);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Paths, AmongEqualGainsTheShortestInTimeIsTaken) {
  const PathProblem problem = problem_at({{5, 0}, {1, 0}, {3, 0}}, {0.04, 0.04, 0.04}, 3);
  const PathChoice choice = choose_path(problem);
  EXPECT_EQ(choice.best.stops, (std::vector<int>{1, 2, 0}));
  EXPECT_NEAR(choice.best.detour_s, 5, 1e-12);
}

TEST(Paths, OfThePaperTakeTheHighestGainHoweverFarItIs) {
  const PathProblem problem = problem_at({{1, 0}, {2, 0}, {90, 0}}, {0.05, 0.05, 0.04}, 1);
  EXPECT_EQ(choose_path(problem).best.stops, std::vector<int>{2});
}

TEST(Paths, CellCountsOnce) {
  PathProblem problem = problem_at(on_a_line(2), {0.04, 0.04}, 2);
  problem.stops[1][0].cell = problem.stops[0][0].cell;
  EXPECT_EQ(path_through(problem, {0, 1}).gain, path_through(problem, {0}).gain);
  EXPECT_EQ(choose_path(problem).best.stops, std::vector<int>{0});  // the second tells no more
}

TEST(Paths, ThroughAViewOfTwoObjectsGainTwice) {
  PathProblem problem = problem_at({{1, 0}, {2, 0}}, {0.04, 0.04}, 1);
  problem.objects.push_back(problem.objects[0]);
  problem.drifted_m.push_back(0);
  problem.stops[1].push_back({1, 7, noise(0.04)});
  const double one = path_through(problem, {0}).gain;
  EXPECT_NEAR(path_through(problem, {1}).gain, 2 * one, 1e-12);
  EXPECT_EQ(choose_path(problem).best.stops, std::vector<int>{1});
}

TEST(Paths, AreFlownOnlyWhileEachSecondBringsItsPrice) {
  PathProblem problem = problem_at({{2, 0}, {30, 0}}, {0.04, 0.04}, 2);
  const double near = path_through(problem, {0}).gain;
  problem.price_per_s = 0.9 * near / 2;  // of the 2 s to the near one
  EXPECT_EQ(choose_path(problem).best.stops, std::vector<int>{0});
  problem.price_per_s = 1.1 * near / 2;
  EXPECT_TRUE(choose_path(problem).best.stops.empty());
}

TEST(Paths, OnTheWayToTheNextTargetCostTheirDwellOnly) {
  PathProblem problem = problem_at({{5, 0}, {-5, 0}}, {0.04, 0.04}, 1);
  problem.direct_s = 10;  // the next one is at (10, 0)
  problem.on_s << 5, 15;
  problem.dwell_s = 2;
  EXPECT_NEAR(path_through(problem, {0}).detour_s, 2, 1e-12);
  EXPECT_NEAR(path_through(problem, {1}).detour_s, 12, 1e-12);
  problem.price_per_s = 0.1;
  EXPECT_EQ(choose_path(problem).best.stops, std::vector<int>{0});
}

TEST(Paths, DriftMakesTheOrderCountAndNeverHelps) {
  PathProblem problem = problem_at({{1, 0}, {10, 0}}, {0.01, 0.2}, 2);
  const double without = path_through(problem, {0, 1}).gain;
  problem.drift_m = 0.05;
  const double early = path_through(problem, {0, 1}).gain;  // the good view first
  EXPECT_LT(early, without);
  EXPECT_LT(path_through(problem, {1, 0}).gain, early);
}

TEST(Paths, BeginWhereTheyMust) {
  const PathProblem problem = problem_at(on_a_line(5), {0.01, 0.02, 0.03, 0.04, 0.5}, 3);
  const PathChoice choice = choose_path(problem, 4);
  EXPECT_EQ(choice.best.stops.front(), 4);
  EXPECT_EQ(choice.best.stops.size(), 3U);
  EXPECT_EQ(choice.paths, 4 * 3);
}

TEST(Paths, WithoutStopsThereIsNone) {
  const PathChoice choice = choose_path(problem_at({}, {}, 3));
  EXPECT_TRUE(choice.best.stops.empty());
  EXPECT_EQ(choice.bound, 0);
}

TEST(Beam, IsNeverBetterThanAllPathsNorAreTheseBetterThanItsBound) {
  core::Rng rng(5);
  for (int trial = 0; trial < 40; ++trial) {
    PathProblem problem = random_problem(rng, 9, 3);
    problem.price_per_s = trial % 2 ? 0.05 : 0;
    problem.drift_m = trial % 3 ? 0.01 : 0;
    problem.dwell_s = 1;
    const PathChoice all = choose_path(problem);
    problem.most_paths = 1;
    problem.beam = 1 + trial % 5;
    const PathChoice beam = choose_path(problem);
    ASSERT_TRUE(all.exhaustive);
    ASSERT_FALSE(beam.exhaustive);
    EXPECT_LE(beam.best.value, all.best.value + 1e-9);
    EXPECT_GE(beam.bound, all.best.value - 1e-9);
  }
}

TEST(Beam, OfSixtyMissesHardlyAnything) {
  core::Rng rng(6);
  double found = 0, best = 0;
  for (int trial = 0; trial < 10; ++trial) {
    PathProblem problem = random_problem(rng, 20, 3);
    best += choose_path(problem).best.value;
    problem.most_paths = 1;
    problem.beam = 60;
    found += choose_path(problem).best.value;
  }
  EXPECT_GT(found, 0.99 * best);
}

TEST(Beam, FindsTheOnlyPathThatIsWorthIt) {
  PathProblem problem = problem_at(on_a_line(30), std::vector<double>(30, 1e6), 1);
  problem.stops[17][0].measured.covariance = noise(0.01);
  problem.most_paths = 1;
  EXPECT_EQ(choose_path(problem).best.stops, std::vector<int>{17});
}

}  // namespace
}  // namespace saker::active
