#include "saker/odometry/voxel_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "saker/core/rng.h"

namespace saker::odometry {
namespace {

using Kept = std::vector<std::uint32_t>;

std::vector<Eigen::Vector3f> cloud(int count) {
  core::Rng rng(2);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(
        Eigen::Vector3d(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-2, 2)).cast<float>());
  }
  return points;
}

Kept thinned(const std::vector<Eigen::Vector3f>& points, double voxel_m,
             std::size_t most = 100000) {
  VoxelFilter filter(most);
  Kept kept;
  filter.thin(points, voxel_m, 1, 50, kept);
  return kept;
}

VoxelKey key_of(const Eigen::Vector3f& point, double voxel_m) {
  return voxel_key(voxel_cell(point.cast<double>(), 1 / voxel_m));
}

TEST(VoxelFilter, KeepsTheFirstPointOfEachVoxel) {
  const auto points = cloud(3000);
  std::map<VoxelKey, std::uint32_t> first;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (points[i].norm() >= 1) first.try_emplace(key_of(points[i], 0.8), i);
  }
  Kept expected;
  for (const auto& [key, i] : first) expected.push_back(i);
  std::ranges::sort(expected);
  EXPECT_EQ(thinned(points, 0.8), expected);
}

TEST(VoxelFilter, LeavesOutWhatIsNearFarOrNotFinite) {
  const std::vector<Eigen::Vector3f> points = {{0.5f, 0, 0}, {NAN, 5, 0},      {5, 0, 0},
                                               {0, 51, 0},   {INFINITY, 0, 0}, {0, 49, 0}};
  EXPECT_EQ(thinned(points, 0.5), (Kept{2, 5}));
}

TEST(VoxelFilter, LargerVoxelsKeepFewerPoints) {
  const auto points = cloud(3000);
  std::size_t last = points.size();
  for (const double voxel : {0.2, 0.5, 1.0, 3.0}) {
    const std::size_t kept = thinned(points, voxel).size();
    EXPECT_LT(kept, last) << voxel;
    last = kept;
  }
}

TEST(VoxelFilter, KeepsAtMostAsManyAsAsked) {
  const auto points = cloud(3000);
  const Kept all = thinned(points, 0.3), some = thinned(points, 0.3, 100);
  EXPECT_EQ(some, Kept(all.begin(), all.begin() + 100));
}

TEST(VoxelFilter, ThinsWhatIsThinAlreadyNoFurther) {
  const auto points = cloud(3000);
  const Kept once = thinned(points, 0.6);
  VoxelFilter filter(100000);
  Kept twice, coarser;
  filter.thin(points, once, 0.6, twice);
  EXPECT_EQ(twice, once);
  filter.thin(points, once, 1.8, coarser);
  EXPECT_LT(coarser.size(), once.size());
  EXPECT_TRUE(std::ranges::includes(once, coarser));
}

TEST(VoxelFilter, OfNothingKeepsNothing) { EXPECT_TRUE(thinned({}, 0.5).empty()); }

TEST(VoxelIndex, AgreesWithAMapOverRandomVoxels) {
  core::Rng rng(8);
  VoxelIndex index(4000);
  for (int round = 0; round < 3; ++round) {
    std::map<VoxelKey, std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 6000; ++i) {
      const Eigen::Vector3i cell(rng.index(24) - 12, rng.index(24) - 12, rng.index(6) - 3);
      const auto [at, fresh] = expected.try_emplace(voxel_key(cell), i);
      ASSERT_EQ(index.find_or_insert(voxel_key(cell), i), at->second);
    }
    EXPECT_EQ(index.size(), expected.size());
    for (const auto& [key, value] : expected) ASSERT_EQ(index.find(key), value);
    index.clear();
  }
}

TEST(VoxelIndex, KeysOfNeighboursAndOfTheGridsEndsDiffer) {
  std::set<VoxelKey> keys;
  constexpr int kEnd = 1 << 20;
  for (const int x : {-kEnd, -2, -1, 0, 1, kEnd - 1}) {
    for (const int y : {-kEnd, -1, 0, 1, kEnd - 1}) {
      for (const int z : {-kEnd, -1, 0, 1, kEnd - 1}) keys.insert(voxel_key({x, y, z}));
    }
  }
  EXPECT_EQ(keys.size(), 6u * 5 * 5);
}

TEST(VoxelIndex, ThatIsFullStillFindsAndStillEnds) {
  VoxelIndex index(8);
  for (std::uint32_t i = 0; i < 8; ++i) (void)index.find_or_insert(i, i);
  EXPECT_EQ(index.size(), index.most());
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(index.find(i), i);
  EXPECT_EQ(index.find(99), VoxelIndex::kNone);
}

}  // namespace
}  // namespace saker::odometry
