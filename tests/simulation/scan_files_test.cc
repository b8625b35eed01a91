#include "saker/simulation/sensor/scan_files.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saker/core/files.h"

namespace saker::simulation {
namespace {

CastScan two_rings() {
  CastScan scan;
  scan.rows = 2;
  scan.columns = 90;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 90; ++column) {
      const float azimuth = static_cast<float>(1 - 2 * M_PI * column / 90);
      const float range = column % 9 == 0 ? 0 : 10;
      scan.range_m.push_back(range);
      scan.points.emplace_back(range * std::cos(azimuth), range * std::sin(azimuth), 1 - row);
      scan.reflectivity.push_back(0.25F);
      scan.labels.push_back(kCar);
      scan.objects.push_back(5);
    }
  }
  return scan;
}

TEST(ScanFiles, RingsFollowEachOtherEachLeftwardsFromTheFront) {
  const CastScan scan = two_rings();
  const std::vector<std::size_t> order = ring_order(scan);
  ASSERT_EQ(order.size(), 160U);
  double last = -1;
  int rings = 1;
  for (const std::size_t i : order) {
    double azimuth = std::atan2(scan.points[i].y(), scan.points[i].x());
    if (azimuth < 0) azimuth += 2 * M_PI;
    if (azimuth < last) ++rings;
    last = azimuth;
  }
  EXPECT_EQ(rings, 2);
  EXPECT_GT(scan.points[order.front()].z(), scan.points[order.back()].z());
}

TEST(ScanFiles, WritesOneLabelAPointWithTheObjectInItsUpperHalf) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "scan_files_test";
  std::filesystem::remove_all(folder);
  LabelledScanWriter writer(folder);
  writer.write(two_rings(), placed(1, 2, 3, 0.5), 0);
  writer.write(two_rings(), placed(2, 2, 3, 0.5), from_seconds(0.1));
  writer.finish();
  EXPECT_EQ(core::read_file(folder / "velodyne/000001.bin").size(), 160U * 16);
  const std::string labels = core::read_file(folder / "labels/000001.label");
  ASSERT_EQ(labels.size(), 160U * 4);
  std::uint32_t first = 0;
  std::memcpy(&first, labels.data(), 4);
  EXPECT_EQ(first, (5U << 16) + 10U);
  EXPECT_EQ(core::read_file(folder / "times.txt"), "0.000000\n0.100000\n");
  EXPECT_EQ(core::read_file(folder / "poses.txt").find("1 0 0 0 0 1 0 0 0 0 1 0"), 0U);
}

}  // namespace
}  // namespace saker::simulation
