#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "flight/bus/scan_log.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::flight {
namespace {

constexpr Time kPeriod = 100'000'000;

class ScanLogTest : public testing::Test {
 protected:
  ScanLogTest() {
    std::filesystem::remove_all(folder_), std::filesystem::create_directories(folder_);
  }
  ~ScanLogTest() override { std::filesystem::remove_all(folder_); }

  /// Opens the log anew, so that what is written is on the disk when it closes.
  struct Writer {
    explicit Writer(const std::filesystem::path& file) : log(file.string(), "w") {}

    template <class Message>
    void add(const std::string& channel, const Message& message) {
      std::vector<char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
      message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
      add(channel, bytes);
    }
    void add(const std::string& channel, std::vector<char>& bytes) {
      lcm::LogEvent event{};
      event.timestamp = ++count;
      event.channel = channel;
      event.datalen = static_cast<std::int32_t>(bytes.size());
      event.data = bytes.data();
      log.writeEvent(&event);
    }

    lcm::LogFile log;
    int count = 0;
  };

  static std::vector<scan_t> chunks(int n) {
    const auto cloud = std::make_shared<std::vector<Eigen::Vector3f>>(
        25000, Eigen::Vector3f(static_cast<float>(n), 2, 3));
    return to_lcm({.stamp = (n + 1) * kPeriod, .points = cloud}, n);
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("saker_scan_log_" + std::to_string(::getpid()));
  const std::filesystem::path file_ = folder_ / "flight.lcm";
};

TEST_F(ScanLogTest, GivesTheScansOfAMission) {
  {
    Writer writer(file_);
    for (int n = 0; n < 3; ++n) {
      writer.add("R1_SETPOINT", setpoint_t{});
      for (const scan_t& chunk : chunks(n)) writer.add("R1_SCAN", chunk);
    }
  }
  ScanLog log(file_);
  EXPECT_EQ(log.expected_scans(), 3);
  EXPECT_EQ(log.channel(), "R1_SCAN");
  for (int n = 0; n < 3; ++n) {
    const auto frame = log.next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->scan.stamp, (n + 1) * kPeriod);
    ASSERT_EQ(frame->scan.size(), 25000u);
    EXPECT_EQ(frame->scan.points.back().x(), static_cast<float>(n));
    EXPECT_EQ(frame->scan.offset_ns.size(), frame->scan.size());
    EXPECT_EQ(frame->scan.reflectivity.size(), frame->scan.size());
  }
  EXPECT_FALSE(log.next());
  EXPECT_EQ(log.counters().summary(), "");
}

TEST_F(ScanLogTest, ALostChunkIsALostFrame) {
  {
    Writer writer(file_);
    writer.add("R1_SCAN", chunks(0)[0]);
    for (const scan_t& chunk : chunks(1)) writer.add("R1_SCAN", chunk);
  }
  ScanLog log(file_);
  const auto frame = log.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->scan.stamp, 2 * kPeriod);
  EXPECT_EQ(log.counters().lost_frames, 1);
}

TEST_F(ScanLogTest, WhatIsNoScanOnTheChannelIsCounted) {
  {
    Writer writer(file_);
    std::vector<char> junk(100, 'x');
    writer.add("R1_SCAN", junk);
    for (const scan_t& chunk : chunks(0)) writer.add("R1_SCAN", chunk);
  }
  ScanLog log(file_);
  EXPECT_TRUE(log.next());
  EXPECT_EQ(log.counters().bad_packets, 1);
}

TEST_F(ScanLogTest, ALogWithoutScansIsRefusedWithTheCommandThatLogsThem) {
  { Writer(file_).add("R1_SETPOINT", setpoint_t{}); }
  try {
    const ScanLog log(file_);
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("lcm-logger --lcm-url="), std::string::npos);
  }
}

TEST_F(ScanLogTest, TwoRobotsInOneLogAreRefused) {
  {
    Writer writer(file_);
    writer.add("R1_SCAN", chunks(0)[0]);
    writer.add("R2_SCAN", chunks(0)[0]);
  }
  EXPECT_THROW(const ScanLog log(file_), Error);
}

TEST_F(ScanLogTest, AnotherFileIsRefused) {
  core::write_file(file_, "x y z");
  EXPECT_FALSE(is_lcm_log(file_));
  EXPECT_THROW(const ScanLog log(file_), Error);
  EXPECT_THROW(const ScanLog log(folder_ / "nothing"), Error);
}

TEST_F(ScanLogTest, ALogThatWasCutGivesWhatIsWhole) {
  {
    Writer writer(file_);
    for (int n = 0; n < 2; ++n) {
      for (const scan_t& chunk : chunks(n)) writer.add("R1_SCAN", chunk);
    }
  }
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 1000);
  ScanLog log(file_);
  EXPECT_TRUE(log.next());
  EXPECT_FALSE(log.next());
}

}  // namespace
}  // namespace saker::flight
