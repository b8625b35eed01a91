#include <gtest/gtest.h>

#include <algorithm>

#include "flight/bus/scan_messages.h"
#include "saker/core/rng.h"

namespace saker::flight {
namespace {

autonomy::RegisteredScan made_scan(int points) {
  core::Rng rng(1);
  auto cloud = std::make_shared<std::vector<Eigen::Vector3f>>();
  for (int i = 0; i < points; ++i) {
    cloud->emplace_back(static_cast<float>(rng.uniform(-120, 120)),
                        static_cast<float>(rng.uniform(-120, 120)),
                        static_cast<float>(rng.uniform(-5, 30)));
  }
  auto reflectivity = std::make_shared<std::vector<float>>();
  for (int i = 0; i < points; ++i) reflectivity->push_back(static_cast<float>(i % 256) / 255);
  autonomy::RegisteredScan scan{
      .stamp = 5'000'000'000, .points = cloud, .reflectivity = reflectivity};
  scan.T_odom_lidar.translation() << 1, 2, 3;
  return scan;
}

std::optional<autonomy::RegisteredScan> joined(ScanJoiner& joiner,
                                               const std::vector<scan_t>& chunks) {
  std::optional<autonomy::RegisteredScan> whole;
  for (const scan_t& chunk : chunks) {
    if (auto scan = joiner.add(chunk)) whole = scan;
  }
  return whole;
}

TEST(ScanMessages, AScanComesBackToTheCentimetre) {
  const autonomy::RegisteredScan scan = made_scan(65536);
  ScanJoiner joiner;
  const auto back = joined(joiner, to_lcm(scan, 3));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, scan.stamp);
  EXPECT_TRUE(back->T_odom_lidar.isApprox(scan.T_odom_lidar));
  ASSERT_EQ(back->points->size(), scan.points->size());
  float worst = 0;
  for (std::size_t i = 0; i < scan.points->size(); ++i) {
    worst = std::max(worst, ((*back->points)[i] - (*scan.points)[i]).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(worst, 0.00502f);  // half a centimetre and the rounding of floats
  EXPECT_EQ(*back->reflectivity, *scan.reflectivity);
}

TEST(ScanMessages, ChunksFitIntoSixtyKilobytes) {
  const auto chunks = to_lcm(made_scan(65536), 0);
  EXPECT_EQ(chunks.size(), 8u);
  for (const scan_t& chunk : chunks) EXPECT_LE(chunk.getEncodedSize(), 60 * 1024);
}

TEST(ScanMessages, AnEmptyScanIsOneChunk) {
  ScanJoiner joiner;
  const auto back = joined(joiner, to_lcm(made_scan(0), 0));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->points->empty());
}

TEST(ScanMessages, PointsThatAreNoneOrTooFarAreLeftOut) {
  const auto cloud = std::make_shared<std::vector<Eigen::Vector3f>>(std::vector<Eigen::Vector3f>{
      {NAN, 0, 0}, {1, 2, 3}, {0, INFINITY, 0}, {0, 0, -328}, {327, -327, 0}});
  ScanJoiner joiner;
  const auto back = joined(joiner, to_lcm({.stamp = 0, .points = cloud}, 0));
  ASSERT_TRUE(back);
  ASSERT_EQ(back->points->size(), 2u);
  EXPECT_EQ((*back->points)[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ((*back->points)[1], Eigen::Vector3f(327, -327, 0));
}

TEST(ScanMessages, ReflectivityThatIsNoneIsZeroAndTooMuchIsAll) {
  autonomy::RegisteredScan scan = made_scan(4);
  scan.reflectivity = std::make_shared<std::vector<float>>(std::vector<float>{NAN, -1, 2, 0.5f});
  ScanJoiner joiner;
  const auto back = joined(joiner, to_lcm(scan, 0));
  ASSERT_TRUE(back);
  EXPECT_EQ(*back->reflectivity, (std::vector<float>{0, 0, 1, 128.0f / 255}));
  scan.reflectivity = nullptr;
  EXPECT_EQ(to_lcm(scan, 0).front().reflectivity, (std::vector<std::uint8_t>(4, 0)));
}

TEST(ScanMessages, NoScanIsLargerThanItsCeiling) {
  const int most = int{scan_t::MAX_POINTS} * int{scan_t::MAX_CHUNKS};
  const auto chunks = to_lcm(made_scan(most + 1), 0);
  EXPECT_EQ(chunks.size(), static_cast<std::size_t>(scan_t::MAX_CHUNKS));
}

TEST(ScanJoiner, TheOrderOfTheChunksDoesNotMatter) {
  auto chunks = to_lcm(made_scan(35000), 0);
  ScanJoiner in_order, reversed;
  const auto a = joined(in_order, chunks);
  std::reverse(chunks.begin(), chunks.end());
  const auto b = joined(reversed, chunks);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(*a->points, *b->points);
}

TEST(ScanJoiner, ALostChunkCostsOneScan) {
  ScanJoiner joiner;
  autonomy::RegisteredScan scan = made_scan(35000);
  auto chunks = to_lcm(scan, 0);
  chunks.erase(chunks.begin() + 1);
  EXPECT_FALSE(joined(joiner, chunks));
  scan.stamp += 100'000'000;
  EXPECT_TRUE(joined(joiner, to_lcm(scan, 1)));
  EXPECT_EQ(joiner.counters().incomplete, 1);
}

TEST(ScanJoiner, AChunkWhoseSizesDisagreeIsRefused) {
  for (const int change : {0, 1, 2, 3, 4}) {
    scan_t chunk = to_lcm(made_scan(100), 0).front();
    if (change == 0) chunk.num_points = -1;
    if (change == 1) chunk.num_points = 101;
    if (change == 2) chunk.z_cm.pop_back();
    if (change == 3) chunk.orientation[0] = 5;
    if (change == 4) chunk.reflectivity.pop_back();
    ScanJoiner joiner;
    EXPECT_FALSE(joiner.add(chunk));
    EXPECT_FALSE(joiner.accepted());
  }
}

TEST(ScanJoiner, AGoodChunkIsAcceptedBeforeTheScanIsWhole) {
  ScanJoiner joiner;
  EXPECT_FALSE(joiner.add(to_lcm(made_scan(20000), 0).front()));
  EXPECT_TRUE(joiner.accepted());
}

}  // namespace
}  // namespace saker::flight
