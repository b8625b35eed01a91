#include "saker/lidar/sensor_info.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

TEST(SensorInfo, Os1LooksUpAndDownByHalfOf45Degrees) {
  const auto info = SensorInfo::make_os1(64, 1024, PacketProfile::kLegacy);
  EXPECT_DOUBLE_EQ(info.beam_altitude_deg.front(), 22.5);
  EXPECT_DOUBLE_EQ(info.beam_altitude_deg.back(), -22.5);
  EXPECT_DOUBLE_EQ(info.beam_origin_m, 0.015806);
}

TEST(SensorInfo, Os1ShiftsRowsAsTheVendorsMetadataDoes) {
  const auto info = SensorInfo::make_os1(128, 1024, PacketProfile::kRng15Rfl8Nir8);
  const std::vector<int> first(info.pixel_shift_by_row.begin(),
                               info.pixel_shift_by_row.begin() + 4);
  EXPECT_EQ(first, (std::vector<int>{24, 16, 8, 0}));
}

TEST(SensorInfo, DestaggeredNeighboursLookInTheSameDirection) {
  const auto info = SensorInfo::make_os1(64, 2048, PacketProfile::kLegacy);
  const double column_deg = 360.0 / info.columns;
  for (int row = 0; row < info.rows; ++row) {
    // The beam of raw column c looks at c · column_deg + azimuth clockwise and lands in column c +
    // shift.
    const double deg = info.beam_azimuth_deg[row] - info.pixel_shift_by_row[row] * column_deg;
    EXPECT_NEAR(deg, -4.22, 0.6 * column_deg);
  }
}

TEST(SensorInfo, RefusesSizesThatNoSensorHas) {
  EXPECT_THROW((void)SensorInfo::make_os1(40, 1024, PacketProfile::kLegacy), Error);
  EXPECT_THROW((void)SensorInfo::make_os1(64, 1000, PacketProfile::kLegacy), Error);
}

TEST(SensorInfo, IsNamedAsTheVendorNamesIt) {
  const SensorInfo info = SensorInfo::make_os1(64, 512, PacketProfile::kLegacy);
  EXPECT_EQ(name_and_mode(info), "OS1-64 512x10");
}

TEST(ColumnWindow, MayWrapThroughColumnZero) {
  const ColumnWindow window{900, 99};
  EXPECT_TRUE(window.contains(900));
  EXPECT_TRUE(window.contains(0));
  EXPECT_TRUE(window.contains(99));
  EXPECT_FALSE(window.contains(100));
  EXPECT_FALSE(window.contains(899));
  EXPECT_EQ(window.size(1024), 224);
}

TEST(ColumnWindow, SizeIsTheNumberOfColumnsItContains) {
  for (const ColumnWindow window :
       {ColumnWindow{0, 1023}, ColumnWindow{5, 5}, ColumnWindow{1, 0}, ColumnWindow{1023, 0}}) {
    int count = 0;
    for (int column = 0; column < 1024; ++column) count += window.contains(column);
    EXPECT_EQ(window.size(1024), count) << window.first << " " << window.last;
  }
}

}  // namespace
}  // namespace saker::lidar
