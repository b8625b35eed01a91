#include "saker/active/tour/tour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "saker/core/rng.h"
#include "tsplib.h"

namespace saker::active {
namespace {

const core::Budget kPlenty = core::Budget::iterations(1'000'000);

TourConfig searching() {
  TourConfig config;
  config.exact_up_to = 0;
  return config;
}

std::vector<Eigen::Vector3d> random_places(int count, std::uint64_t seed) {
  core::Rng rng(seed);
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < count; ++i) {
    places.emplace_back(rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(0, 5));
  }
  return places;
}

/// With an end for odd seeds, free at its end for even ones.
TourProblem random_problem(int stops, std::uint64_t seed) {
  const auto places = random_places(stops + 2, seed);
  const std::span<const Eigen::Vector3d> inner(places.data(), stops);
  if (seed % 2) return straight_lines(inner, places[stops], places[stops + 1]);
  return straight_lines(inner, places[stops], std::nullopt);
}

double brute_force(const TourProblem& problem) {
  std::vector<int> order(problem.from_start.size());
  std::iota(order.begin(), order.end(), 0);
  double shortest = std::numeric_limits<double>::infinity();
  do {
    shortest = std::min(shortest, length_of(problem, order));
  } while (std::next_permutation(order.begin(), order.end()));
  return shortest;
}

void expect_each_stop_once(const Tour& tour, int stops) {
  std::vector<int> sorted = tour.order, expected(stops);
  std::sort(sorted.begin(), sorted.end());
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(sorted, expected);
}

TEST(Tour, LengthGoesFromTheStartThroughAllStopsToTheEnd) {
  const std::vector<Eigen::Vector3d> stops = {{3, 0, 0}, {3, 4, 0}};
  const Eigen::Vector3d start(0, 0, 0);
  const std::vector<int> order = {0, 1};
  EXPECT_DOUBLE_EQ(length_of(straight_lines(stops, start, std::nullopt), order), 7);
  EXPECT_DOUBLE_EQ(length_of(straight_lines(stops, start, start), order), 12);
}

TEST(Tour, OfNoStopAndOfOneIsThereToo) {
  const Eigen::Vector3d start(0, 0, 0);
  EXPECT_TRUE(solve_tour(straight_lines({}, start, start), {}, kPlenty).order.empty());
  const std::vector<Eigen::Vector3d> one = {{3, 4, 0}};
  for (const TourConfig& config : {TourConfig{}, searching()}) {
    const Tour tour = solve_tour(straight_lines(one, start, start), config, kPlenty);
    EXPECT_EQ(tour.order, std::vector<int>{0});
    EXPECT_DOUBLE_EQ(tour.length, 10);
  }
}

TEST(Tour, OfFewStopsIsTheShortestOfAllOrders) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const int stops = 2 + static_cast<int>(seed % 7);
    const TourProblem problem = random_problem(stops, seed);
    const Tour tour = solve_tour(problem, {}, kPlenty);
    expect_each_stop_once(tour, stops);
    EXPECT_TRUE(tour.exact);
    EXPECT_NEAR(tour.length, brute_force(problem), 1e-9);
    EXPECT_NEAR(tour.length, length_of(problem, tour.order), 1e-9);
  }
}

TEST(Tour, OfTwelveStopsIsExactAndOfThirteenIsSearched) {
  EXPECT_TRUE(solve_tour(random_problem(12, 1), {}, kPlenty).exact);
  EXPECT_FALSE(solve_tour(random_problem(13, 1), {}, kPlenty).exact);
}

TEST(Tour, SearchFindsTheShortestOfFewStopsToo) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const int stops = 2 + static_cast<int>(seed % 11);
    const TourProblem problem = random_problem(stops, seed);
    const Tour found = solve_tour(problem, searching(), kPlenty);
    expect_each_stop_once(found, stops);
    EXPECT_NEAR(found.length, solve_tour(problem, {}, kPlenty).length, 1e-9) << "seed " << seed;
  }
}

TEST(Tour, OfStopsThatAreAllTheSameHasNoLength) {
  const std::vector<Eigen::Vector3d> stops(20, {1, 2, 3});
  const Tour tour = solve_tour(straight_lines(stops, stops[0], stops[0]), {}, kPlenty);
  expect_each_stop_once(tour, 20);
  EXPECT_EQ(tour.length, 0);
}

TEST(Tour, AlongALineGoesOnce) {
  std::vector<Eigen::Vector3d> stops;
  for (int i = 0; i < 40; ++i) stops.emplace_back(5.0 * (i * 7 % 40), 0, 0);
  const Tour tour = solve_tour(straight_lines(stops, {-5, 0, 0}, std::nullopt), {}, kPlenty);
  EXPECT_DOUBLE_EQ(tour.length, 200);
}

TEST(Tour, OfAGridIsAsLongAsItHasPoints) {
  std::vector<Eigen::Vector3d> stops;
  for (int i = 1; i < 20 * 20; ++i) stops.emplace_back(i % 20, i / 20, 0);
  const Eigen::Vector3d corner(0, 0, 0);
  const Tour tour = solve_tour(straight_lines(stops, corner, corner), {}, kPlenty);
  EXPECT_GE(tour.length, 400 - 1e-9);
  EXPECT_LE(tour.length, 1.03 * 400);
}

TEST(Tour, IsTheSameForTheSameSeedAndBudget) {
  const TourProblem problem = random_problem(80, 3);
  const Tour once = solve_tour(problem, {}, core::Budget::iterations(500));
  const Tour twice = solve_tour(problem, {}, core::Budget::iterations(500));
  EXPECT_EQ(once.order, twice.order);
  EXPECT_EQ(once.kicks, 500);
}

TEST(Tour, GetsNoLongerWithMoreBudget) {
  const TourProblem problem = random_problem(150, 4);
  double last = std::numeric_limits<double>::infinity();
  for (const int kicks : {0, 10, 100, 1000}) {
    const Tour tour = solve_tour(problem, {}, core::Budget::iterations(kicks));
    expect_each_stop_once(tour, 150);
    EXPECT_LE(tour.length, last + 1e-6);
    last = tour.length;
  }
}

TEST(Tour, ReportsTheLengthOfItsOrder) {
  const TourProblem problem = random_problem(60, 5);
  const Tour tour = solve_tour(problem, {}, kPlenty);
  EXPECT_NEAR(tour.length, length_of(problem, tour.order), 1e-9);
}

TEST(Tour, IsAtMostThreePercentLongerThanTheShortestOfPublicInstances) {
  for (const tsplib::Instance& instance :
       {tsplib::berlin52(), tsplib::kroA100(), tsplib::pr1002()}) {
    SCOPED_TRACE(instance.name);
    const Tour tour = solve_tour(tsplib::problem(instance.points), {}, kPlenty);
    expect_each_stop_once(tour, static_cast<int>(instance.points.size()) - 1);
    EXPECT_GE(tour.length, instance.optimum);
    EXPECT_LE(tour.length, 1.03 * instance.optimum);
    RecordProperty(instance.name, std::to_string(tour.length / instance.optimum));
  }
}

TEST(Tsplib, HasAsManyPointsAsItsNamesSay) {
  EXPECT_EQ(tsplib::berlin52().points.size(), 52U);
  EXPECT_EQ(tsplib::kroA100().points.size(), 100U);
  EXPECT_EQ(tsplib::pr1002().points.size(), 1002U);
}

}  // namespace
}  // namespace saker::active
