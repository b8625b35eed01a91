#include "saker/motion/search.h"

#include <gtest/gtest.h>

#include <thread>

#include "made_world.h"
#include "saker/motion/destination.h"

namespace saker::motion {
namespace {

const Geofence kFence{GeofenceConfig{}};
const Eigen::Vector3d kStart(-17, -17, 3), kGoal(17, 17, 4);

/// A forest with what a search in it needs.
struct Forest {
  explicit Forest(std::uint64_t seed)
      : world(made::forest(seed, 120)),
        space(*world.grid(), {}, kFence, {.vehicle = kStart}),
        reached(reachable_cells(space, kStart, made::ample())) {}
  made::World world;
  FreeSpace space;
  std::vector<int> reached;
};

SearchResult search(const Forest& forest, std::uint64_t seed, const SearchConfig& config = {},
                    int iterations = 20'000) {
  return search_path(forest.space, forest.reached, kStart, kGoal, config, seed,
                     core::Budget::iterations(iterations));
}

/// Exact, over all legs.
double least_distance_m(const Forest& forest, const Waypoints& path) {
  double least = INFINITY;
  for (std::size_t i = 1; i < path.size(); ++i)
    for (double u = 0; u <= 1; u += 0.001)
      least = std::min(least, forest.world.distance_m(path[i - 1] + u * (path[i] - path[i - 1])));
  return least;
}

TEST(Search, FindsAPathWhoseEveryLegIsFree) {
  const Forest forest(1);
  const SearchResult found = search(forest, 1);
  ASSERT_GE(found.path.size(), 3U);
  EXPECT_EQ(found.path.front(), kStart);
  EXPECT_EQ(found.path.back(), kGoal);
  EXPECT_GE(least_distance_m(forest, found.path), ClearanceConfig{}.least_m());
}

TEST(Search, SeveralAttemptsAreNeverWorseThanTheFirst) {
  const Forest forest(2);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const double one = length_m(search(forest, seed, {.attempts = 1}).path);
    EXPECT_LE(length_m(search(forest, seed).path), one);
  }
}

TEST(Search, GivesTheSamePathInEveryThreadAndAfterOtherSearches) {
  const Forest forest(3);
  const SearchResult first = search(forest, 7);
  std::vector<SearchResult> again(4);
  std::vector<std::thread> threads;
  for (SearchResult& result : again)
    threads.emplace_back([&forest, &result] {
      static_cast<void>(search(forest, 1));
      result = search(forest, 7);
    });
  for (std::thread& thread : threads) thread.join();
  for (const SearchResult& result : again) {
    EXPECT_EQ(result.path, first.path);
    EXPECT_EQ(result.iterations, first.iterations);
  }
}

TEST(Search, DependsOnItsSeed) {
  const Forest forest(3);
  EXPECT_NE(search(forest, 1, {.attempts = 1}).path, search(forest, 2, {.attempts = 1}).path);
}

TEST(Search, StopsAtItsIterations) {
  const SearchResult found = search(Forest(4), 1, {}, 3);
  EXPECT_TRUE(found.path.empty());
  EXPECT_LE(found.iterations, 3 + SearchConfig{}.attempts);
}

TEST(Search, StopsAtItsDeadline) {
  const Forest forest(4);
  const auto past = core::Budget::until(core::Budget::Clock::now(), 1'000'000);
  const SearchResult found = search_path(forest.space, forest.reached, kStart, kGoal, {}, 1, past);
  EXPECT_TRUE(found.path.empty());
  EXPECT_LE(found.iterations, SearchConfig{}.attempts);
}

TEST(Shortened, KeepsTheEndsAndIsNeverLonger) {
  const Forest forest(5);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Waypoints raw = search(forest, seed, {.attempts = 1, .shortcuts = 0}).path;
    const Waypoints cut = shortened(raw, forest.space, 200, core::Rng(seed));
    EXPECT_EQ(cut.front(), kStart);
    EXPECT_EQ(cut.back(), kGoal);
    EXPECT_LE(length_m(cut), length_m(raw) + 1e-9);
    EXPECT_GE(least_distance_m(forest, cut), ClearanceConfig{}.least_m());
  }
}

TEST(Shortened, PullsADetourStraight) {
  const made::World world({-20, -20, 0}, {20, 20, 10});
  const FreeSpace space(*world.grid(), {}, kFence, {.vehicle = kStart});
  const Waypoints detour{{-5, 0, 3}, {0, 8, 5}, {2, -6, 3}, {5, 0, 3}};
  EXPECT_EQ(shortened(detour, space, 0, core::Rng(1)), (Waypoints{{-5, 0, 3}, {5, 0, 3}}));
}

}  // namespace
}  // namespace saker::motion
