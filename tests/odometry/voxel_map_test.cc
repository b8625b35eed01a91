#include "saker/odometry/voxel_map.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"

namespace saker::odometry {
namespace {

/// Points of the plane through `centre` with this normal, spread over a disc, `thickness` off it.
std::vector<Eigen::Vector3d> disc(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal,
                                  double radius, double thickness, int count) {
  core::Rng rng(3);
  const Eigen::Matrix3d R =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal).toRotationMatrix();
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.push_back(centre + R * Eigen::Vector3d(rng.uniform(-radius, radius),
                                                  rng.uniform(-radius, radius),
                                                  rng.normal(0, thickness)));
  return points;
}

TEST(VoxelMap, FindsThePlaneThatPointsLieOn) {
  VoxelMap map(VoxelMapConfig{});
  const Eigen::Vector3d centre(100.3, -50.3, 2.7);
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, -0.5).normalized();
  map.insert(disc(centre, normal, 0.2, 0.0, 300), 0);
  const auto plane = map.nearest_plane(centre, false);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(std::abs(plane->normal.dot(normal)), 1, 1e-4);
  EXPECT_NEAR((plane->point - centre).dot(normal), 0, 1e-4);
  EXPECT_LT(plane->variance, 1e-5);
}

TEST(VoxelMap, APlaneKnowsSinceWhenItIsThere) {
  VoxelMap map(VoxelMapConfig{});
  const auto points = disc({0.3, 0.3, 0.3}, {0, 0, 1}, 0.2, 0, 50);
  for (const Time stamp : {5, 7, 9}) map.insert(points, stamp);
  EXPECT_EQ(map.nearest_plane({0.3, 0.3, 0.3}, false)->first_seen, 5);
}

TEST(VoxelMap, VarianceOfAPlaneIsThatOfItsNoise) {
  VoxelMapConfig config;
  config.voxel_m = 2;
  VoxelMap map(config);
  map.insert(disc({1, 1, 1}, {0, 0, 1}, 0.9, 0.03, 400), 0);
  const auto plane = map.nearest_plane({1, 1, 1}, false);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(std::sqrt(plane->variance), 0.03, 0.003);
}

TEST(VoxelMap, LinesAndBlobsAreNoPlanes) {
  VoxelMap map(VoxelMapConfig{});
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 50; ++i) line.emplace_back(0.1 + 0.008 * i, 0.3, 0.3);
  map.insert(line, 0);
  EXPECT_FALSE(map.nearest_plane({0.3, 0.3, 0.3}, true));
  core::Rng rng(5);
  std::vector<Eigen::Vector3d> blob;
  for (int i = 0; i < 300; ++i)
    blob.emplace_back(rng.uniform(12.05, 12.55), rng.uniform(0.05, 0.55), rng.uniform(0.05, 0.55));
  map.insert(blob, 0);
  EXPECT_FALSE(map.nearest_plane({12.3, 0.3, 0.3}, true));
}

TEST(VoxelMap, OnlyAWideSearchReachesBeyondThePointsOwnVoxel) {
  VoxelMap map(VoxelMapConfig{});  // voxels of 0.6 m
  map.insert(disc({0.9, 0.3, 0.3}, {1, 0, 0}, 0.2, 0, 200), 0);
  EXPECT_FALSE(map.nearest_plane({0.5, 0.3, 0.3}, false));
  EXPECT_TRUE(map.nearest_plane({0.5, 0.3, 0.3}, true));
  EXPECT_TRUE(map.nearest_plane({0.7, 0.3, 0.3}, false));
}

TEST(VoxelMap, ANormalIsKnownAsWellAsItsFitSays) {
  constexpr double kNoise = 0.005;
  double sum = 0;
  constexpr int kTimes = 200;
  for (int i = 0; i < kTimes; ++i) {
    VoxelMap map(VoxelMapConfig{});
    core::Rng rng(static_cast<std::uint64_t>(i));
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < 100; ++k)
      points.emplace_back(rng.uniform(0.05, 0.55), rng.uniform(0.1, 0.5),
                          0.3 + rng.normal(0, kNoise));
    map.insert(points, 0);
    const auto plane = map.nearest_plane({0.3, 0.3, 0.3}, false);
    ASSERT_TRUE(plane);
    const Eigen::Vector3d off = plane->normal / plane->normal.z() - Eigen::Vector3d::UnitZ();
    const Eigen::Matrix3d covariance = plane->variance * plane->tilt * plane->tilt.transpose();
    sum += off.head<2>().dot(covariance.topLeftCorner<2, 2>().inverse() * off.head<2>()) / 2;
  }
  EXPECT_NEAR(sum / kTimes, 1, 0.25);
}

TEST(VoxelMap, DropsWhatIsFarOrOld) {
  VoxelMapConfig config;
  config.max_distance_m = 50;
  config.max_age_s = 10;
  VoxelMap map(config);
  map.insert(disc({0.3, 0.3, 0.3}, {1, 0, 0}, 0.2, 0, 50), 0);
  map.insert(disc({90.3, 0.3, 0.3}, {1, 0, 0}, 0.2, 0, 50), from_seconds(5));
  map.prune({80, 0, 0}, from_seconds(6));
  EXPECT_FALSE(map.nearest_plane({0.3, 0.3, 0.3}, false));
  EXPECT_TRUE(map.nearest_plane({90.3, 0.3, 0.3}, false));
  map.prune({80, 0, 0}, from_seconds(16));
  EXPECT_EQ(map.size(), 0u);
}

TEST(VoxelMap, StaysUnderItsCeilingAndKeepsTheNewest) {
  VoxelMapConfig config;
  config.max_voxels = 1000;
  config.max_distance_m = 500;
  VoxelMap map(config);
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Eigen::Vector3d> point{{0.1 * i, 0.3, 0.3}};
    map.insert(point, from_seconds(i * 0.01));
    ASSERT_LE(map.size(), 1000u);
    if (i % 50 == 0) map.prune(Eigen::Vector3d::Zero(), from_seconds(i * 0.01));
  }
  EXPECT_GE(map.size(), 450u);
  map.insert(disc({299.7, 0.3, 0.3}, {0, 0, 1}, 0.2, 0, 50), from_seconds(30));
  EXPECT_TRUE(map.nearest_plane({299.7, 0.3, 0.3}, false));
}

TEST(VoxelIndex, FindsWhatWasStoredUntilItIsCleared) {
  VoxelIndex index(100);
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(index.find_or_insert(VoxelKey{i} << 20, i), i);
  EXPECT_EQ(index.find_or_insert(7u << 20, 999), 7u);
  EXPECT_EQ(index.find_or_insert(12345, 1), VoxelIndex::kNone);  // full
  index.clear();
  EXPECT_EQ(index.find(7u << 20), VoxelIndex::kNone);
  EXPECT_EQ(index.size(), 0u);
}

TEST(VoxelIndex, CellsOnBothSidesOfTheOriginDiffer) {
  EXPECT_EQ(voxel_cell({-0.1, 0.1, -1.1}, 1), Eigen::Vector3i(-1, 0, -2));
  EXPECT_NE(voxel_key({-1, 0, 0}), voxel_key({1, 0, 0}));
  EXPECT_NE(voxel_key({0, -1, 0}), voxel_key({-1, 0, 0}));
}

}  // namespace
}  // namespace saker::odometry
