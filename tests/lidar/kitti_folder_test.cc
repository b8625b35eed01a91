#include "saker/lidar/kitti_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "made_sensor.h"
#include "saker/core/error.h"

namespace saker::lidar {
namespace {

using testing::TemporaryFolder;

void write_floats(const std::filesystem::path& file, const std::vector<float>& floats) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(floats.data()),
             static_cast<std::streamsize>(floats.size() * sizeof(float)));
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

const std::vector<float> kTwoPoints = {1, 2, 3, 0.5F, -4, 5, -6, 1.5F};

TEST(KittiFolder, GivesPointsInTheirOrderAtTenHertz) {
  const TemporaryFolder folder;
  write_floats(folder / "000001.bin", kTwoPoints);
  write_floats(folder / "000000.bin", {7, 8, 9, 0.1F});
  KittiFolder source(folder.path());
  EXPECT_EQ(source.expected_scans(), 2);
  const auto first = source.next();
  const auto second = source.next();
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(source.next());
  EXPECT_EQ(first->name, "000000");
  EXPECT_EQ(first->scan.points[0], Eigen::Vector3f(7, 8, 9));
  EXPECT_FALSE(second->scan.organised());
  EXPECT_EQ(second->scan.stamp, 100'000'000);
  EXPECT_EQ(second->scan.points[1], Eigen::Vector3f(-4, 5, -6));
  EXPECT_EQ(second->scan.reflectivity, (std::vector<float>{0.5F, 1}));
  EXPECT_EQ(second->scan.offset_ns, (std::vector<std::int32_t>{0, 0}));
}

TEST(KittiFolder, TakesTimesFromTheFolderOrBesideIt) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "velodyne");
  write_floats(folder / "velodyne/000000.bin", kTwoPoints);
  write_text(folder / "times.txt", "1.25e+00\n");
  EXPECT_EQ(KittiFolder(folder.path()).next()->scan.stamp, 1'250'000'000);
  EXPECT_EQ(KittiFolder(folder / "velodyne").next()->scan.stamp, 1'250'000'000);
  EXPECT_EQ(KittiFolder(folder / "velodyne/").next()->scan.stamp, 1'250'000'000);
  write_text(folder / "velodyne/times.txt", "3\n\n");
  EXPECT_EQ(KittiFolder(folder.path()).next()->scan.stamp, 3'000'000'000);
}

TEST(KittiFolder, ABadScanIsAFaultAndTheRecordingGoesOn) {
  const TemporaryFolder folder;
  write_floats(folder / "0.bin", kTwoPoints);
  write_floats(folder / "1.bin", {1, 2, 3});
  write_floats(folder / "2.bin", {});
  write_floats(folder / "3.bin", kTwoPoints);
  std::filesystem::create_symlink(folder / "nowhere", folder / "4.bin");
  KittiFolder source(folder.path());
  std::vector<std::string> faults;
  while (const auto frame = source.next()) faults.push_back(frame->fault);
  ASSERT_EQ(faults.size(), 5U);
  EXPECT_EQ(faults[0], "");
  EXPECT_EQ(faults[1], "1.bin: 12 bytes, expected a multiple of 16");
  EXPECT_EQ(faults[2], "2.bin: holds no points");
  EXPECT_EQ(faults[3], "");
  EXPECT_NE(faults[4].find("cannot be read"), std::string::npos);
  EXPECT_EQ(source.counters().faulty_scans, 3);
}

/// A recording of one scan of two points with these bytes as its ring numbers.
std::optional<Frame> with_rings(const TemporaryFolder& folder, const std::string& bytes) {
  for (const char* part : {"velodyne", "ring"}) std::filesystem::create_directory(folder / part);
  write_floats(folder / "velodyne/000000.bin", kTwoPoints);
  write_text(folder / "ring/000000.u8", bytes);
  return KittiFolder(folder.path()).next();
}

TEST(KittiFolder, TakesRingNumbersFromBesideIt) {
  const TemporaryFolder folder;
  const auto frame = with_rings(folder, "\x05\x1f");
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->scan.ring, (std::vector<std::uint16_t>{5, 31}));
}

TEST(KittiFolder, RingNumbersThatAreNotOneAPointAreAFault) {
  const TemporaryFolder folder;
  const auto frame = with_rings(folder, "\x05");
  ASSERT_TRUE(frame);
  EXPECT_NE(frame->fault.find("2 ring numbers"), std::string::npos) << frame->fault;
  EXPECT_TRUE(frame->scan.points.empty());
}

TEST(KittiFolder, PassesPointsThatAreNotFiniteOnInTheirPlace) {
  const TemporaryFolder folder;
  write_floats(folder / "0.bin", {NAN, 0, INFINITY, NAN, 1, 2, 3, 0.5F});
  const auto frame = KittiFolder(folder.path()).next();
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->scan.size(), 2U);
  EXPECT_FALSE(frame->scan.points[0].allFinite());
  EXPECT_EQ(frame->scan.reflectivity[0], 0);
}

TEST(KittiFolder, TimesThatDoNotFitAreRefusedByName) {
  const TemporaryFolder folder;
  write_floats(folder / "0.bin", kTwoPoints);
  for (const char* text : {"0.1\n0.2\n", "soon\n", "", "nan\n", "1e300\n", "1.0 2.0\n"}) {
    write_text(folder / "times.txt", text);
    try {
      const KittiFolder source(folder.path());
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("times.txt"), std::string::npos);
    }
  }
}

TEST(KittiFolder, AFolderWithoutScansIsRefused) {
  const TemporaryFolder folder;
  EXPECT_FALSE(is_kitti_folder(folder.path()));
  EXPECT_THROW(KittiFolder{folder.path()}, Error);
  EXPECT_THROW(KittiFolder(folder / "missing"), Error);
  write_floats(folder / "0.bin", kTwoPoints);
  EXPECT_TRUE(is_kitti_folder(folder.path()));
}

}  // namespace
}  // namespace saker::lidar
