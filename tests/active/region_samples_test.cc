#include "saker/active/views/region_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace saker::active {
namespace {

constexpr int kDirections = 24, kRings = 3;

/// Rings of 9, 10 and 11 m around the origin.
std::vector<ViewpointCandidate> lattice() {
  std::vector<ViewpointCandidate> candidates(kDirections * kRings);
  for (int i = 0; i < kDirections * kRings; ++i) {
    const double bearing = 2 * std::numbers::pi * (i / kRings) / kDirections;
    const double range = 9 + i % kRings;
    candidates[i].viewpoint.position =
        Eigen::Vector3d(range * std::cos(bearing), range * std::sin(bearing), 3);
  }
  return candidates;
}

/// Directions from … to (both in it), at all rings.
void add_sector(std::vector<bool>& region, int from, int to) {
  for (int d = from; d <= to; ++d) {
    const int direction = (d + kDirections) % kDirections;
    for (int ring = 0; ring < kRings; ++ring) region[direction * kRings + ring] = true;
  }
}

std::vector<int> samples_of(const std::vector<bool>& region, Sampling sampling) {
  return region_samples(lattice(), region, sampling, kRings);
}

TEST(RegionSamples, UniformAreAllOfTheRegion) {
  std::vector<bool> region(kDirections * kRings, false);
  add_sector(region, 2, 5);
  EXPECT_EQ(samples_of(region, Sampling::uniform).size(), 4U * kRings);
}

TEST(RegionSamples, OfAnEmptyRegionAreNone) {
  const std::vector<bool> region(kDirections * kRings, false);
  EXPECT_TRUE(samples_of(region, Sampling::uniform).empty());
  EXPECT_TRUE(samples_of(region, Sampling::centroids).empty());
}

TEST(RegionSamples, CentroidsAreOneAPartInItsMiddle) {
  std::vector<bool> region(kDirections * kRings, false);
  add_sector(region, 2, 4);
  add_sector(region, 15, 17);
  EXPECT_EQ(samples_of(region, Sampling::centroids),
            (std::vector<int>{3 * kRings + 1, 16 * kRings + 1}));
}

TEST(RegionSamples, PartThatCrossesTheFirstDirectionIsOne) {
  std::vector<bool> region(kDirections * kRings, false);
  add_sector(region, -1, 1);
  EXPECT_EQ(samples_of(region, Sampling::centroids), std::vector<int>{1});
}

TEST(RegionSamples, CentroidOfARingLiesOnIt) {
  const std::vector<bool> region(kDirections * kRings, true);
  const std::vector<int> samples = samples_of(region, Sampling::centroids);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0] % kRings, 0);  // the ring that is nearest to the middle
}

}  // namespace
}  // namespace saker::active
