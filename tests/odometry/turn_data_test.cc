#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "paths.h"
#include "saker/lidar/kitti_folder.h"
#include "saker/odometry/odometry.h"

namespace saker::odometry {
namespace {

namespace fs = std::filesystem;

const fs::path kData = source_dir() + "/../shared/data";

/// How the sensor of a recording turns, by its first scans; a failure where it is not there.
std::optional<Turn> turn_of(const std::string& name, int scans) {
  const fs::path folder = fs::path(::testing::TempDir()) / ("saker_turn_" + name);
  const std::string command =
      (kData / "unpack").string() + " " + name + " " + folder.string() + " > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  lidar::KittiFolder source(folder);
  Odometry odometry{OdometryConfig{}};
  for (auto frame = source.next(); frame && scans > 0; frame = source.next(), --scans)
    (void)odometry.register_scan(frame->scan, {});
  return odometry.turn();
}

TEST(TurnData, ASkewedDriveTurnsClockwiseFromTheRear) {
  if (!fs::exists(kData / "unpack")) GTEST_SKIP() << "no recordings in " << kData;
  const auto turn = turn_of("kitti_drive_0005", 40);
  ASSERT_TRUE(turn);
  EXPECT_TRUE(turn->clockwise);
  EXPECT_LT(std::abs(std::remainder(turn->begin_rad - M_PI, 2 * M_PI)), 0.4);
}

TEST(TurnData, CompensatedRecordingsAreLeftAlone) {
  if (!fs::exists(kData / "unpack")) GTEST_SKIP() << "no recordings in " << kData;
  EXPECT_FALSE(turn_of("pandaset_002", 76));
  EXPECT_FALSE(turn_of("semantic_kitti_00", 10));
  EXPECT_FALSE(turn_of("semantic_kitti_08", 10));
}

}  // namespace
}  // namespace saker::odometry
