#include "saker/detection/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saker/core/rng.h"

namespace saker::detection {
namespace {

using Points = std::vector<Eigen::Vector2f>;
using Indices = std::vector<std::vector<int>>;

const ClusterConfig kConfig{0.1, 0.5, 6};

Indices found(const Points& points) { return Clusters().find(points, kConfig); }

/// Points at every 5 cm of a line along x.
void add_row(float from, float to, float y, Points& points) {
  const int count = static_cast<int>((to - from) / 0.05f);
  for (int i = 0; i <= count; ++i) points.emplace_back(from + 0.05f * static_cast<float>(i), y);
}

/// Three clumps, 4 m and more from each other, in the order of a coin.
Points three_clumps(std::uint64_t seed) {
  core::Rng rng(seed);
  const std::array<Eigen::Vector2f, 3> middles = {{{0, 0}, {4, 1}, {-2, 5}}};
  Points points;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d off(rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5));
    points.push_back(middles[static_cast<std::size_t>(rng.index(3))] + off.cast<float>());
  }
  return points;
}

/// Which points are together, whatever the order of the clusters.
std::vector<std::vector<int>> sorted(Indices clusters) {
  std::ranges::sort(clusters);
  return clusters;
}

TEST(Clusters, APartNearerThanTheReachBelongsToItOneFartherDoesNot) {
  for (const auto& [gap, expected] : {std::pair{0.3f, 1u}, {0.8f, 2u}}) {
    Points points;
    add_row(0, 2, 0, points);
    add_row(2 + gap, 4 + gap, 0, points);
    EXPECT_EQ(found(points).size(), expected) << gap;
  }
}

TEST(Clusters, HoldEachPointOnceInAscendingOrder) {
  const Points points = three_clumps(1);
  std::vector<int> all;
  for (const std::vector<int>& cluster : found(points)) {
    EXPECT_TRUE(std::ranges::is_sorted(cluster));
    all.insert(all.end(), cluster.begin(), cluster.end());
  }
  std::ranges::sort(all);
  ASSERT_EQ(all.size(), points.size());
  for (int i = 0; i < std::ssize(all); ++i) EXPECT_EQ(all[i], i);
}

TEST(Clusters, ASquareWeighsAsManyPointsAsItHolds) {
  EXPECT_EQ(found(Points(6, Eigen::Vector2f(3, 2))).size(), 1u);
  EXPECT_TRUE(found(Points(5, Eigen::Vector2f(3, 2))).empty());
}

TEST(Clusters, NoiseBelongsToNone) {
  Points points = three_clumps(2);
  const int noise = static_cast<int>(points.size());
  points.emplace_back(10, 10);
  for (const std::vector<int>& cluster : found(points)) {
    EXPECT_FALSE(std::ranges::binary_search(cluster, noise));
  }
}

TEST(Clusters, AreTheSameWhereverTheSceneLies) {
  Points points = three_clumps(3);
  const Indices before = sorted(found(points));
  for (Eigen::Vector2f& p : points) p += Eigen::Vector2f(31.7f, -12.3f);
  EXPECT_EQ(sorted(found(points)), before);
  EXPECT_EQ(before.size(), 3u);
}

TEST(Clusters, AreTheSameInWhicheverOrderThePointsCome) {
  Points points = three_clumps(4);
  const Indices before = sorted(found(points));
  std::ranges::reverse(points);
  Indices after = found(points);
  for (std::vector<int>& cluster : after) {
    for (int& i : cluster) i = static_cast<int>(points.size()) - 1 - i;
    std::ranges::reverse(cluster);
  }
  EXPECT_EQ(sorted(after), before);
}

TEST(Clusters, AStrayPointAKilometreOffBreaksNone) {
  Points points = three_clumps(5);
  const Indices before = found(points);
  points.emplace_back(1000, 1000);
  EXPECT_EQ(found(points), before);
}

TEST(Clusters, RememberNothingOfTheCallBefore) {
  Clusters clusters;
  const Points points = three_clumps(6);
  const Indices first = clusters.find(points, kConfig);
  EXPECT_TRUE(clusters.find({}, kConfig).empty());
  EXPECT_EQ(clusters.find(points, kConfig), first);
}

}  // namespace
}  // namespace saker::detection
