#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "made_bag.h"
#include "made_sensor.h"
#include "peer.h"
#include "saker/core/error.h"
#include "saker/lidar/recording.h"

/// Bags and MCAP files that others wrote read as what was written, and others read ours.
namespace saker::lidar {
namespace {

using testing::MadeMessage;
using testing::MadePoint;
using testing::TemporaryFolder;

constexpr int kScans = 12;
constexpr int kImuSamples = 10 * kScans;

/// How many scans of the made drive come, each as it was written, and their inertial samples.
struct Came {
  int scans = 0, imu = 0;
};

Came read_made(ScanSource& source) {
  Came came;
  for (; const auto frame = source.next(); ++came.scans) {
    EXPECT_EQ(frame->fault, "");
    const std::vector<MadePoint> truth = testing::made_points(came.scans);
    const Time begin = testing::kDriveBegin + came.scans * 100'000'000LL;
    if (frame->scan.size() != truth.size()) {
      ADD_FAILURE() << frame->scan.size() << " points";
      continue;
    }
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const MadePoint& p = truth[i];
      EXPECT_EQ(frame->scan.points[i], Eigen::Vector3f(p.x, p.y, p.z));
      EXPECT_EQ(frame->scan.time_of(i), begin + p.t);
      EXPECT_EQ(frame->scan.ring[i], p.ring);
    }
    for (const ImuSample& sample : frame->imu) {
      const Time since = sample.stamp - testing::kDriveBegin;
      EXPECT_EQ(sample.stamp, testing::kDriveBegin + 10'000'000LL * came.imu);
      EXPECT_EQ(sample.acceleration.x(), 0.1 * static_cast<double>(since / 10'000'000 % 10));
      EXPECT_EQ(sample.angular_velocity.z(), 0.1 * static_cast<double>(since / 100'000'000));
      ++came.imu;
    }
  }
  return came;
}

void expect_made(const std::filesystem::path& file) {
  const auto source = open_recording(file);
  const Came came = read_made(*source);
  EXPECT_EQ(came.scans, kScans);
  EXPECT_EQ(came.imu, kImuSamples);
  EXPECT_EQ(source->counters().summary(), "");
}

TEST(Peers, BagsThatRosWritesAreRead) {
  SKIP_WITHOUT("write_ros1.py");
  const TemporaryFolder folder;
  testing::write_messages(testing::made_drive(kScans, Encoding::kRos1), folder / "messages");
  for (const char* compression : {"none", "bz2", "lz4"}) {
    SCOPED_TRACE(compression);
    ASSERT_EQ(
        testing::run_peer("write_ros1.py", {folder / "messages", folder / "a.bag", compression}),
        "");
    expect_made(folder / "a.bag");
  }
}

TEST(Peers, RosReadsOurBags) {
  SKIP_WITHOUT("read_ros1.py");
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(kScans, Encoding::kRos1);
  for (const char* compression : {"none", "bz2", "lz4"}) {
    SCOPED_TRACE(compression);
    testing::write_bytes(folder / "a.bag",
                         testing::made_ros1_bag(messages, {compression, 9, true, true}));
    ASSERT_EQ(testing::run_peer("read_ros1.py", {folder / "a.bag", folder / "read"}), "");
    const auto read = testing::read_messages(folder / "read");
    ASSERT_EQ(read.size(), messages.size());
    std::multimap<std::pair<Time, std::string>, std::vector<std::uint8_t>> written;
    for (const MadeMessage& m : messages) written.insert({{m.received, m.topic}, m.bytes});
    for (const MadeMessage& m : read) {
      const auto found = written.find({m.received, m.topic});
      ASSERT_NE(found, written.end());
      EXPECT_EQ(found->second, m.bytes);
      written.erase(found);
    }
  }
}

/// What @foxglove/rosbag finds in a bag is the made drive.
void expect_foxglove_reads(const TemporaryFolder& folder) {
  ASSERT_EQ(testing::run_peer("read_ros1.cjs", {folder / "a.bag", folder / "read"}), "");
  int scan = 0, imu = 0;
  for (const MadeMessage& message : testing::read_messages(folder / "read")) {
    const std::vector<double> numbers = testing::numbers_of(message);
    if (message.type == "sensor_msgs/Imu") {
      ASSERT_EQ(numbers.size(), 6U);
      EXPECT_EQ(numbers[0], 0.1 * (imu % 10));
      ++imu;
      continue;
    }
    const auto truth = testing::made_points(scan++);
    ASSERT_EQ(numbers.size(), 6 * truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const MadePoint& p = truth[i];
      const double made[] = {
          p.x, p.y, p.z, p.intensity, static_cast<double>(p.t), static_cast<double>(p.ring)};
      for (std::size_t k = 0; k < 6; ++k) ASSERT_EQ(numbers[6 * i + k], made[k]);
    }
  }
  EXPECT_EQ(scan, kScans);
  EXPECT_EQ(imu, kImuSamples);
}

TEST(Peers, FoxgloveReadsOurBagsAndThoseOfRosAlike) {
  SKIP_WITHOUT("read_ros1.cjs");
  SKIP_WITHOUT("write_ros1.py");
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(kScans, Encoding::kRos1);
  testing::write_messages(messages, folder / "messages");
  for (const char* compression : {"none", "bz2", "lz4"}) {
    SCOPED_TRACE(compression);
    testing::write_bytes(folder / "a.bag",
                         testing::made_ros1_bag(messages, {compression, 9, true, true}));
    expect_foxglove_reads(folder);
    ASSERT_EQ(
        testing::run_peer("write_ros1.py", {folder / "messages", folder / "a.bag", compression}),
        "");
    expect_foxglove_reads(folder);
  }
}

TEST(Peers, McapFilesThatOthersWriteAreReadWithAndWithoutSummary) {
  SKIP_WITHOUT("write_mcap.cjs");
  const TemporaryFolder folder;
  testing::write_messages(testing::made_drive(kScans, Encoding::kCdr), folder / "messages");
  for (const char* compression : {"none", "lz4", "zstd"}) {
    for (const char* kind : {"summary", "plain"}) {
      SCOPED_TRACE(std::string(compression) + " " + kind);
      ASSERT_EQ(testing::run_peer("write_mcap.cjs",
                                  {folder / "messages", folder / "a.mcap", compression, kind}),
                "");
      expect_made(folder / "a.mcap");
    }
  }
}

TEST(Peers, McapFilesOfOthersThatAreCutAnywhereAreReadUpToTheCut) {
  SKIP_WITHOUT("write_mcap.cjs");
  const TemporaryFolder folder;
  testing::write_messages(testing::made_drive(kScans, Encoding::kCdr), folder / "messages");
  for (const char* compression : {"none", "lz4", "zstd"}) {
    ASSERT_EQ(testing::run_peer("write_mcap.cjs",
                                {folder / "messages", folder / "a.mcap", compression, "summary"}),
              "");
    std::ifstream in(folder / "a.mcap", std::ios::binary);
    const std::vector<std::uint8_t> whole((std::istreambuf_iterator<char>(in)),
                                          std::istreambuf_iterator<char>());
    int before = 0;
    for (std::size_t percent = 1; percent < 100; percent += 3) {
      SCOPED_TRACE(std::string(compression) + " " + std::to_string(percent) + " %");
      testing::write_bytes(folder / "cut.mcap",
                           {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(
                                                               whole.size() * percent / 100)});
      try {
        const auto source = open_recording(folder / "cut.mcap");
        const int scans = read_made(*source).scans;
        EXPECT_GE(scans, before);
        before = scans;
        EXPECT_TRUE(source->counters().ended_early != "" || scans == kScans) << scans;
      } catch (const Error&) {
        EXPECT_EQ(before, 0);  // no channel before the cut
      }
    }
    EXPECT_GE(before, kScans - 2) << compression;
  }
}

TEST(Peers, OthersReadOurMcapFiles) {
  SKIP_WITHOUT("read_mcap.cjs");
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(kScans, Encoding::kCdr);
  for (const char* compression : {"none", "lz4", "zstd"}) {
    for (const bool index : {true, false}) {
      SCOPED_TRACE(compression);
      testing::write_bytes(folder / "a.mcap", testing::made_mcap(messages, Encoding::kCdr,
                                                                 {compression, 9, index, true}));
      ASSERT_EQ(testing::run_peer("read_mcap.cjs", {folder / "a.mcap", folder / "read"}), "");
      const auto read = testing::read_messages(folder / "read");
      ASSERT_EQ(read.size(), messages.size());
      for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].topic, messages[i].topic);
        EXPECT_EQ(read[i].received, messages[i].received);
        EXPECT_EQ(read[i].bytes, messages[i].bytes);
      }
    }
  }
}

}  // namespace
}  // namespace saker::lidar
