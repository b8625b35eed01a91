#include "saker/lidar/rings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_scan.h"
#include "saker/core/rng.h"

namespace saker::lidar {
namespace {

using testing::MadeScan;
using testing::ring_by_ring;
using testing::RingFile;
using testing::uneven_elevations;

TEST(Rings, AreFoundAgainInAFileThatGoesRingByRing) {
  const auto file = ring_by_ring(MadeScan{.wall_m = 8}.organised());
  const Rings rings = recover_rings(file.scan.points);
  ASSERT_EQ(rings.source, RingSource::order);
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
  ASSERT_EQ(rings.source, RingSource::order);
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

TEST(Rings, AreBandsOfElevationWhereTheOrderSaysNothing) {
  const MadeScan sensor{.wall_m = 8, .elevation_deg = uneven_elevations()};
  const RingFile file = shuffled(ring_by_ring(sensor.organised()), 3);
  const Rings rings = recover_rings(file.scan.points);
  EXPECT_EQ(rings.source, RingSource::bands);
  const int first = *std::min_element(file.row.begin(), file.row.end());
  for (std::size_t i = 0; i < file.row.size(); ++i) {
    ASSERT_EQ(rings.of_point[i], file.row[i] - first) << "point " << i;
  }
}

TEST(Rings, AreTheGivenOnesFromTheHighestDown) {
  const RingFile file = shuffled(ring_by_ring(MadeScan{.rows = 32, .wall_m = 8}.organised()), 5);
  std::vector<std::uint16_t> given;
  for (const int row : file.row) given.push_back(static_cast<std::uint16_t>((row * 7) % 32));
  const Rings rings = recover_rings(file.scan.points, given);
  ASSERT_EQ(rings.source, RingSource::given);
  const int first = *std::min_element(file.row.begin(), file.row.end());
  for (std::size_t i = 0; i < file.row.size(); ++i) {
    ASSERT_EQ(rings.of_point[i], file.row[i] - first) << "point " << i;
  }
}

TEST(Rings, GivenOnesThatNameNoConesDoNotCount) {
  const RingFile file = shuffled(ring_by_ring(MadeScan{.wall_m = 8}.organised()), 5);
  std::vector<std::uint16_t> given;
  for (std::size_t i = 0; i < file.row.size(); ++i) given.push_back(i % 32);
  EXPECT_EQ(recover_rings(file.scan.points, given).source, RingSource::bands);
}

TEST(Rings, OfNoFinitePointsAreNone) {
  const std::vector<Eigen::Vector3f> points(5, Eigen::Vector3f::Constant(NAN));
  const Rings rings = recover_rings(points);
  for (const int ring : rings.of_point) EXPECT_EQ(ring, -1);
}

}  // namespace
}  // namespace saker::lidar
