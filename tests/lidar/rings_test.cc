#include "segmentation/rings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/rng.h"
#include "made_scan.h"

namespace saker::segmentation {
namespace {

using testing::MadeScan;
using testing::ring_by_ring;

TEST(Rings, AreFoundAgainInAFileThatGoesRingByRing) {
  const auto file = ring_by_ring(MadeScan{.wall_m = 8}.organised());
  const Rings rings = recover_rings(file.scan.points);
  ASSERT_TRUE(rings.from_order);
  const int first = file.row.front();  // rows above the wall's top have no points
  for (std::size_t i = 0; i < file.row.size(); ++i) {
    ASSERT_EQ(rings.of_point[i], file.row[i] - first) << "point " << i;
  }
}

TEST(Rings, AreFoundAgainWhereTheFileGoesUpwards) {
  auto file = ring_by_ring(MadeScan{.wall_m = 8}.organised());
  std::reverse(file.scan.points.begin(), file.scan.points.end());
  std::reverse(file.row.begin(), file.row.end());
  const Rings rings = recover_rings(file.scan.points);
  ASSERT_TRUE(rings.from_order);
  const int first = file.row.back();
  for (std::size_t i = 0; i < file.row.size(); ++i) {
    ASSERT_EQ(rings.of_point[i], file.row[i] - first) << "point " << i;
  }
}

TEST(Rings, AreFoundAgainThoughAThirdOfThePointsIsMissing) {
  const auto whole = ring_by_ring(MadeScan{.wall_m = 8}.organised());
  core::Rng rng(7);
  std::vector<Eigen::Vector3f> points;
  std::vector<int> row;
  for (std::size_t i = 0; i < whole.row.size(); ++i) {
    if (rng.uniform() < 0.33) continue;
    points.push_back(whole.scan.points[i]);
    row.push_back(whole.row[i] - whole.row.front());
  }
  const Rings rings = recover_rings(points);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < row.size(); ++i) wrong += rings.of_point[i] != row[i];
  EXPECT_LE(wrong, row.size() / 100);
}

TEST(Rings, AreBinsOfElevationWhereTheOrderSaysNothing) {
  auto file = ring_by_ring(MadeScan{.wall_m = 8}.organised());
  core::Rng rng(3);
  for (std::size_t i = file.scan.size() - 1; i > 0; --i) {
    std::swap(file.scan.points[i], file.scan.points[rng.index(static_cast<int>(i))]);
  }
  const Rings rings = recover_rings(file.scan.points);
  EXPECT_FALSE(rings.from_order);
  ASSERT_EQ(rings.count, 64);
  for (std::size_t i = 1; i < file.scan.size(); ++i) {
    const auto& a = file.scan.points[i - 1];
    const auto& b = file.scan.points[i];
    const bool higher = a.normalized().z() > b.normalized().z() + 1e-4F;
    if (higher) {
      ASSERT_LE(rings.of_point[i - 1], rings.of_point[i]);
    }
  }
}

TEST(Rings, OfNoFinitePointsAreNone) {
  const std::vector<Eigen::Vector3f> points(5, Eigen::Vector3f::Constant(NAN));
  const Rings rings = recover_rings(points);
  for (const int ring : rings.of_point) EXPECT_EQ(ring, -1);
}

}  // namespace
}  // namespace saker::segmentation
