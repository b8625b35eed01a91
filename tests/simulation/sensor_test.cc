#include "saker/simulation/sensor/sensor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saker/lidar/ray_table.h"

namespace saker::simulation {
namespace {

double elevation_deg(const Eigen::Vector3f& d) { return std::asin(d.z()) * 180 / M_PI; }

TEST(Sensor, OusterBeamsAreTheVendorsFormula) {
  const auto info = lidar::SensorInfo::make_os1(32, 512, lidar::PacketProfile::kLegacy);
  const BeamTable beams = ouster_beams(info);
  const lidar::RayTable rays(info);
  for (int row = 0; row < info.rows; row += 7) {
    for (int column = 0; column < info.columns; column += 31) {
      EXPECT_EQ(beams.directions[beams.index(row, column)], rays.ray(row, column).direction);
      EXPECT_EQ(beams.origins[beams.index(row, column)], rays.ray(row, column).origin);
    }
  }
}

TEST(Sensor, Hdl64LooksFromTwoDegreesUpToTwentyFourDown) {
  core::Rng rng(3);
  const BeamTable beams = hdl64_beams(rng);
  ASSERT_EQ(beams.rows, 64);
  EXPECT_NEAR(beams.columns, 2045, 46);
  EXPECT_NEAR(elevation_deg(beams.directions[beams.index(0, 0)]), 2, 0.9);
  EXPECT_NEAR(elevation_deg(beams.directions[beams.index(63, 0)]), -24.33, 1.4);
  for (int row = 1; row < 64; ++row) {
    EXPECT_LT(elevation_deg(beams.directions[beams.index(row, 5)]),
              elevation_deg(beams.directions[beams.index(row - 1, 5)]));
  }
}

TEST(Sensor, TwoUnitsDifferInTheirCalibration) {
  core::Rng a(1), b(2);
  EXPECT_NE(hdl64_beams(a).directions[100], hdl64_beams(b).directions[100]);
}

}  // namespace
}  // namespace saker::simulation
