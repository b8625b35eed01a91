#include <gtest/gtest.h>

#include <functional>

#include "made_bag.h"
#include "made_sensor.h"
#include "memory_limit.h"
#include "saker/lidar/recording.h"

/// Memory does not grow with a recording: each is many times larger than what reading it may take.
namespace saker::lidar {
namespace {

using testing::TemporaryFolder;

constexpr int kScans = 400;
constexpr std::size_t kPoints = 4000;  // 128 kB: 51 MB in all
constexpr rlim_t kMostMemory = rlim_t{12} << 20;

std::vector<testing::MadeMessage> long_drive(Encoding encoding) {
  std::vector<testing::MadeMessage> messages;
  std::vector<testing::MadePoint> points;
  while (points.size() < kPoints) {
    const auto more = testing::made_points(static_cast<int>(points.size() / 400));
    points.insert(points.end(), more.begin(), more.end());
  }
  for (int scan = 0; scan < kScans; ++scan) {
    const Time begin = testing::kDriveBegin + scan * 100'000'000LL;
    messages.push_back({"/points", "sensor_msgs/PointCloud2", begin,
                        testing::made_cloud(points, begin, encoding)});
  }
  return messages;
}

int scans_within_the_limit(const std::filesystem::path& file) {
  const testing::MemoryLimit limit(kMostMemory);
  const auto source = open_recording(file);
  int scans = 0;
  while (const auto frame = source->next()) scans += frame->fault.empty();
  return scans;
}

TEST(ReadingMemory, DoesNotGrowWithABag) {
  const TemporaryFolder folder;
  for (const char* compression : {"none", "lz4"}) {
    testing::write_bytes(folder / "a.bag", testing::made_ros1_bag(long_drive(Encoding::kRos1),
                                                                  {compression, 2, true, true}));
    EXPECT_EQ(scans_within_the_limit(folder / "a.bag"), kScans) << compression;
  }
}

TEST(ReadingMemory, DoesNotGrowWithAnMcapFile) {
  const TemporaryFolder folder;
  for (const bool summary : {true, false}) {
    testing::write_bytes(
        folder / "a.mcap",
        testing::made_mcap(long_drive(Encoding::kCdr), Encoding::kCdr, {"zstd", 2, summary, true}));
    EXPECT_EQ(scans_within_the_limit(folder / "a.mcap"), kScans) << summary;
  }
}

TEST(ReadingMemory, DoesNotGrowWithARos2Database) {
  const TemporaryFolder folder;
  testing::write_ros2_database(long_drive(Encoding::kCdr), folder / "a.db3");
  EXPECT_EQ(scans_within_the_limit(folder / "a.db3"), kScans);
}

}  // namespace
}  // namespace saker::lidar
