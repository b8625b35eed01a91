#include "saker/detection/dbscan.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

namespace saker::detection {
namespace {

bool near(const WeightedSample& a, const WeightedSample& b, double reach) {
  return (a.position - b.position).norm() <= reach;
}

/// Ester's definitions, literally: clusters are what core samples reach.
std::vector<int> brute_force(const std::vector<WeightedSample>& s, double reach, double least) {
  const int n = static_cast<int>(s.size());
  std::vector<bool> core(n);
  for (int i = 0; i < n; ++i) {
    double weight = 0;
    for (int j = 0; j < n; ++j) weight += near(s[i], s[j], reach) ? s[j].weight : 0;
    core[i] = weight >= least;
  }
  std::vector<int> cluster(n, kNoise);
  int count = 0;
  for (int seed = 0; seed < n; ++seed) {
    if (!core[seed] || cluster[seed] != kNoise) continue;
    std::vector<int> open = {seed};
    cluster[seed] = count;
    while (!open.empty()) {
      const int i = open.back();
      open.pop_back();
      for (int j = 0; core[i] && j < n; ++j) {
        if (cluster[j] != kNoise || !near(s[i], s[j], reach)) continue;
        cluster[j] = count;
        open.push_back(j);
      }
    }
    ++count;
  }
  return cluster;
}

TEST(Dbscan, AgreesWithTheDefinitions) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    core::Rng rng(seed);
    std::vector<WeightedSample> samples;
    for (int i = 0; i < 300; ++i) {
      samples.push_back(
          {{static_cast<float>(rng.uniform(-6, 6)), static_cast<float>(rng.uniform(-6, 6))},
           static_cast<float>(1 + rng.index(3))});
    }
    EXPECT_EQ(dbscan(samples, 0.7, 7), brute_force(samples, 0.7, 7)) << seed;
  }
}

TEST(Dbscan, OfNothingIsNothing) { EXPECT_TRUE(dbscan({}, 1, 1).empty()); }

TEST(Dbscan, ALoneSampleIsNoise) {
  const std::vector<WeightedSample> samples = {{{0, 0}, 1}, {{10, 0}, 1}};
  EXPECT_EQ(dbscan(samples, 1, 2), (std::vector<int>{kNoise, kNoise}));
}

}  // namespace
}  // namespace saker::detection
