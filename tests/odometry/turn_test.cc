#include "saker/odometry/turn.h"

#include <gtest/gtest.h>

namespace saker::odometry {
namespace {

constexpr double kQuarter = M_PI / 2;

TEST(Turn, AQuarterIsOverAQuarterOfATurnAfterItsBeginning) {
  EXPECT_NEAR((Turn{true, M_PI}.passed(kQuarter)), 0.25, 1e-12);  // from the rear over the left
  EXPECT_NEAR((Turn{false, M_PI}.passed(-kQuarter)), 0.25, 1e-12);
  EXPECT_NEAR((Turn{true, 0.3}.passed(0.3 - kQuarter)), 0.25, 1e-12);
}

TEST(Turn, ThePartThatIsOverLiesBetweenZeroAndOne) {
  for (double azimuth = -M_PI; azimuth <= M_PI; azimuth += 0.1) {
    for (const bool clockwise : {true, false}) {
      const double passed = Turn{clockwise, 2.5}.passed(azimuth);
      EXPECT_GE(passed, 0);
      EXPECT_LT(passed, 1);
    }
  }
}

lidar::Scan four_points() {
  lidar::Scan scan;
  scan.stamp = 1'000'000'000;
  scan.points = {{5, 0, 1}, {0, 5, 1}, {0, -5, 1}, Eigen::Vector3f::Constant(NAN)};
  scan.offset_ns.assign(scan.size(), 0);
  return scan;
}

TEST(Turn, TheStampOfScansWithoutTimesIsTheMiddleOfTheirSweep) {
  const lidar::Scan whole = timed(four_points(), {true, M_PI}, 100'000'000);
  EXPECT_EQ(whole.stamp, 1'050'000'000);
  EXPECT_NEAR(static_cast<double>(whole.time_of(0)), 1e9, 100);      // ahead
  EXPECT_NEAR(static_cast<double>(whole.time_of(1)), 0.975e9, 100);  // left
  EXPECT_NEAR(static_cast<double>(whole.time_of(2)), 1.025e9, 100);  // right
}

TEST(Turn, AzimuthsCountAboutTheSensorWhereverTheFrameIs) {
  lidar::Scan scan = four_points();
  scan.T_lidar_sensor.translation() << 20, 0, 0;  // the first point lies behind the sensor
  const lidar::Scan whole = timed(scan, {true, 0}, 100'000'000);
  EXPECT_NEAR(static_cast<double>(whole.time_of(0)), 1e9, 100);
}

TEST(Turn, NoOffsetIsAfterTheStamp) {
  for (const std::int32_t offset : timed(four_points(), {false, 1}, 50'000'000).offset_ns) {
    EXPECT_LE(offset, 0);
    EXPECT_GE(offset, -50'000'000);
  }
}

}  // namespace
}  // namespace saker::odometry
