#include "saker/multirobot/clique.h"

#include <gtest/gtest.h>

#include <bit>

#include "saker/core/rng.h"

namespace saker::multirobot {
namespace {

BitGraph random_graph(int nodes, double density, core::Rng& rng) {
  BitGraph graph(nodes);
  for (int i = 0; i < nodes; ++i) {
    for (int j = 0; j < i; ++j) {
      if (rng.chance(density)) graph.connect(i, j);
    }
  }
  return graph;
}

bool is_clique(const BitGraph& graph, const std::vector<int>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!graph.connected(nodes[i], nodes[j])) return false;
    }
  }
  return true;
}

/// By trying all subsets.
int largest(const BitGraph& graph) {
  int best = 0;
  for (std::uint32_t subset = 0; subset < (1U << graph.size()); ++subset) {
    if (std::popcount(subset) <= best) continue;
    std::vector<int> nodes;
    for (int i = 0; i < graph.size(); ++i) {
      if ((subset >> i & 1) != 0) nodes.push_back(i);
    }
    if (is_clique(graph, nodes)) best = std::popcount(subset);
  }
  return best;
}

TEST(Clique, IsAsLargeAsTryingEverythingSays) {
  core::Rng rng(1);
  for (int trial = 0; trial < 30; ++trial) {
    const BitGraph graph = random_graph(14, 0.3 + 0.02 * trial, rng);
    const Clique clique = maximum_clique(graph, std::vector<bool>(14, false), 100000);
    EXPECT_TRUE(clique.maximum);
    EXPECT_TRUE(is_clique(graph, clique.nodes));
    EXPECT_EQ(static_cast<int>(clique.nodes.size()), largest(graph));
  }
}

TEST(Clique, FindsTheOneThatWasHidden) {
  core::Rng rng(2);
  BitGraph graph = random_graph(400, 0.1, rng);
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < i; ++j) graph.connect(19 * i, 19 * j);
  }
  const Clique clique = maximum_clique(graph, std::vector<bool>(400, false), 100000);
  ASSERT_GE(clique.nodes.size(), 20U);
  EXPECT_TRUE(is_clique(graph, clique.nodes));
  EXPECT_EQ(clique.nodes[1], 19);
}

TEST(Clique, LeavesOutWhatIsExcluded) {
  BitGraph graph(6);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) graph.connect(i, j);
  }
  graph.connect(4, 5);
  std::vector<bool> excluded(6, false);
  excluded[0] = excluded[1] = excluded[2] = true;
  EXPECT_EQ(maximum_clique(graph, excluded, 100).nodes, (std::vector<int>{4, 5}));
}

TEST(Clique, SaysWhenItWasCutShort) {
  core::Rng rng(3);
  const BitGraph graph = random_graph(200, 0.8, rng);
  EXPECT_FALSE(maximum_clique(graph, std::vector<bool>(200, false), 100).maximum);
}

}  // namespace
}  // namespace saker::multirobot
