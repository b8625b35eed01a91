#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>

#include "made_bag.h"
#include "made_clouds.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/recording.h"

/// One recording, written in every format, reads as the same points, times and order.
namespace saker::lidar {
namespace {

using testing::MadePoint;
using testing::TemporaryFolder;
using testing::write_bytes;
using Bytes = std::vector<std::uint8_t>;

constexpr int kScans = 12;
constexpr Time kPeriod = 100'000'000;

/// \param apart  ns that a time may lose in the format
void expect_made(ScanSource& source, int apart) {
  int scan = 0;
  for (; const auto frame = source.next(); ++scan) {
    ASSERT_EQ(frame->fault, "");
    const std::vector<MadePoint> truth = testing::made_points(scan);
    ASSERT_EQ(frame->scan.size(), truth.size());
    ASSERT_EQ(frame->scan.ring.size(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const MadePoint& p = truth[i];
      ASSERT_EQ(frame->scan.points[i], Eigen::Vector3f(p.x, p.y, p.z)) << scan << " " << i;
      ASSERT_FLOAT_EQ(frame->scan.reflectivity[i], p.intensity / 255) << scan << " " << i;
      ASSERT_EQ(frame->scan.ring[i], p.ring) << scan << " " << i;
      const Time time = testing::kDriveBegin + scan * kPeriod + p.t;
      ASSERT_LE(std::abs(frame->scan.time_of(i) - time), apart) << scan << " " << i;
    }
  }
  EXPECT_EQ(scan, kScans);
  EXPECT_EQ(source.counters().summary(), "");
}

/// A file a scan, named by its time in nanoseconds.
void write_scans(const TemporaryFolder& folder, const std::string& extension,
                 const std::function<Bytes(const std::vector<MadePoint>&)>& bytes_of) {
  for (int scan = 0; scan < kScans; ++scan) {
    const std::string stamp = std::to_string(testing::kDriveBegin + scan * kPeriod);
    write_bytes(folder / (stamp + extension), bytes_of(testing::made_points(scan)));
  }
}

TEST(FormatsEqual, Ros1BagsAreTheRecording) {
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(kScans, Encoding::kRos1);
  for (const char* compression : {"none", "lz4", "bz2"}) {
    write_bytes(folder / "a.bag", testing::made_ros1_bag(messages, {compression, 9, true, true}));
    expect_made(*open_recording(folder / "a.bag"), 0);
  }
}

TEST(FormatsEqual, McapFilesAreTheRecording) {
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(kScans, Encoding::kCdr);
  for (const char* compression : {"none", "lz4", "zstd"}) {
    write_bytes(folder / "a.mcap",
                testing::made_mcap(messages, Encoding::kCdr, {compression, 9, true, true}));
    expect_made(*open_recording(folder / "a.mcap"), 0);
  }
}

TEST(FormatsEqual, Ros2DatabasesAreTheRecording) {
  const TemporaryFolder folder;
  testing::write_ros2_database(testing::made_drive(kScans, Encoding::kCdr), folder / "a.db3");
  expect_made(*open_recording(folder / "a.db3"), 0);
}

TEST(FormatsEqual, FilesThatArePackedAsAWholeAreTheRecording) {
  const TemporaryFolder folder;
  testing::write_ros2_database(testing::made_drive(kScans, Encoding::kCdr), folder / "a.db3");
  const auto pack = [&](const char* name) {
    std::ifstream in(folder / name, std::ios::binary);
    const Bytes plain((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    testing::write_bytes(folder / (std::string(name) + ".zstd"),
                         testing::compressed("zstd", plain));
    std::filesystem::remove(folder / name);
  };
  pack("a.db3");
  expect_made(*open_recording(folder / "a.db3.zstd"), 0);
  testing::write_bytes(
      folder / "b.mcap",
      testing::made_mcap(testing::made_drive(kScans, Encoding::kCdr), Encoding::kCdr));
  pack("b.mcap");
  expect_made(*open_recording(folder / "b.mcap.zstd"), 0);
}

TEST(FormatsEqual, APackedFileLeavesNothingInTheTemporaryFolder) {
  const TemporaryFolder folder, temporary;
  testing::write_bytes(
      folder / "a.mcap.zstd",
      testing::compressed(
          "zstd", testing::made_mcap(testing::made_drive(2, Encoding::kCdr), Encoding::kCdr)));
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  ::setenv("TMPDIR", temporary.path().c_str(), 1);
  {
    const auto source = open_recording(folder / "a.mcap.zstd");
    EXPECT_FALSE(std::filesystem::is_empty(temporary.path()));
    EXPECT_TRUE(source->next());
  }
  before ? ::setenv("TMPDIR", kept.c_str(), 1) : ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(temporary.path()));
}

TEST(FormatsEqual, APackedFileThatIsCutIsReadUpToTheCut) {
  const TemporaryFolder folder;
  Bytes packed = testing::compressed(
      "zstd", testing::made_mcap(testing::made_drive(kScans, Encoding::kCdr), Encoding::kCdr));
  packed.resize(packed.size() * 2 / 3);
  testing::write_bytes(folder / "a.mcap.zstd", packed);
  try {
    const auto source = open_recording(folder / "a.mcap.zstd");
    int scans = 0;
    while (source->next()) ++scans;
    EXPECT_LT(scans, kScans);
    EXPECT_NE(source->counters().ended_early, "");
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(FormatsEqual, FoldersOfPcdAreTheRecording) {
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    const TemporaryFolder folder;
    write_scans(folder, ".pcd",
                [&](const auto& points) { return testing::made_pcd(data, points); });
    expect_made(*open_recording(folder.path()), 0);
  }
}

TEST(FormatsEqual, FoldersOfPlyAreTheRecording) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const TemporaryFolder folder;
    write_scans(folder, ".ply",
                [&](const auto& points) { return testing::made_ply(format, points); });
    expect_made(*open_recording(folder.path()), 0);
  }
}

TEST(FormatsEqual, FoldersOfNumpyRecordsAreTheRecording) {
  const TemporaryFolder folder;
  write_scans(folder, ".npy", testing::made_npy);
  expect_made(*open_recording(folder.path()), 0);
}

TEST(FormatsEqual, FoldersOfFloatsAreTheRecordingToTheirSecondsPrecision) {
  const TemporaryFolder folder;
  write_scans(folder, ".bin", testing::made_floats);
  expect_made(*open_recording(folder.path()), 16);  // 2^-24 of 0.1 s, and of the last point
}

TEST(FormatsEqual, ScansThatAreNumberedComeInTheOrderOfTheirNumbers) {
  const TemporaryFolder folder;
  for (int scan = 0; scan < kScans; ++scan) {
    write_bytes(folder / (std::to_string(scan) + ".pcd"),
                testing::made_pcd("binary", testing::made_points(scan)));
  }
  const auto source = open_recording(folder.path());
  for (int scan = 0; scan < kScans; ++scan) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->name, std::to_string(scan));
    EXPECT_FLOAT_EQ(frame->scan.points[0].z(), 0.5F * static_cast<float>(scan));
    EXPECT_EQ(frame->scan.time_of(0), scan * kPeriod);
  }
}

}  // namespace
}  // namespace saker::lidar
