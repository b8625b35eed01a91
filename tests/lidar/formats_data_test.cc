#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "paths.h"
#include "saker/core/error.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/recording.h"
#include "saker/lidar/scan_assembler.h"

/// Real files of kinds that went wrong once (../shared/data/cases).
namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

const fs::path kCases = source_dir() + "/../shared/data/cases";

#define SKIP_WITHOUT_CASES() \
  if (!fs::exists(kCases)) GTEST_SKIP() << "no cases in " << kCases

fs::path file_with(const std::string& part) {
  for (const auto& entry : fs::directory_iterator(kCases)) {
    if (entry.path().filename().string().find(part) != std::string::npos) return entry.path();
  }
  return {};
}

std::size_t returns_in(const Scan& scan) {
  return static_cast<std::size_t>(
      std::count_if(scan.points.begin(), scan.points.end(),
                    [](const Eigen::Vector3f& p) { return p.allFinite(); }));
}

TEST(FormatsData, ANuscenesSweepHasFiveFloatsAPoint) {
  SKIP_WITHOUT_CASES();
  const auto source = open_recording(file_with("LIDAR_TOP"));
  EXPECT_NE(source->note().find("5 floats a point: x y z intensity ring"), std::string::npos)
      << source->note();
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->scan.size(), 34688U);
  const std::set<std::uint16_t> rings(frame->scan.ring.begin(), frame->scan.ring.end());
  EXPECT_EQ(rings.size(), 32U);
  EXPECT_EQ(*rings.rbegin(), 31);
}

TEST(FormatsData, ABagWithOustersPacketsHasOneFrame) {
  SKIP_WITHOUT_CASES();
  const auto source = open_recording(kCases / "512x10_raw.bag");
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  ASSERT_NE(source->assembled(), nullptr);
  EXPECT_EQ(source->assembled()->valid_columns, 512);
  EXPECT_EQ(returns_in(frame->scan), 28751U);
  EXPECT_FALSE(source->next());
}

TEST(FormatsData, AnOsfFileOfFirmware32HasTenScans) {
  SKIP_WITHOUT_CASES();
  const auto source = open_recording(kCases / "osf_fw_3.2_10scans.osf");
  int scans = 0;
  Time last = 0;
  for (; const auto frame = source->next(); ++scans) {
    EXPECT_EQ(frame->fault, "");
    EXPECT_GT(frame->scan.stamp, last);
    EXPECT_GT(returns_in(frame->scan), 1000U);
    last = frame->scan.stamp;
  }
  EXPECT_EQ(scans, 10);
}

TEST(FormatsData, AFunctionalSafetySensorsCaptureIsDecoded) {
  SKIP_WITHOUT_CASES();
  const auto source = open_recording(file_with("20230712_120049.pcap"));
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(source->assembled()->frame_id, 229);
  EXPECT_EQ(source->assembled()->valid_columns, 8 * 16);
  EXPECT_GT(returns_in(frame->scan), 1000U);
  EXPECT_EQ(source->counters().summary(), "");
}

TEST(FormatsData, InertialPacketsOfEightSamplesAreUsed) {
  SKIP_WITHOUT_CASES();
  const auto source = open_recording(kCases / "imu_accel32/flight.pcap");
  std::size_t samples = 0;
  while (const auto frame = source->next()) samples += frame->imu.size();
  EXPECT_GT(samples, 1000U);
  EXPECT_EQ(source->counters().bad_packets, 0);
}

TEST(FormatsData, EveryGoodMetadataFileIsReadAndEveryMalformedOneIsRefused) {
  SKIP_WITHOUT_CASES();
  int good = 0, malformed = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kCases / "metadata")) {
    if (!entry.is_regular_file()) continue;
    const bool wrong = entry.path().parent_path().filename() == "malformed";
    try {
      const SensorInfo info = read_metadata(entry.path());
      EXPECT_FALSE(wrong) << entry.path();
      EXPECT_GT(info.rows, 0);
      ++good;
    } catch (const Error& error) {
      EXPECT_TRUE(wrong) << error.what();
      EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos) << error.what();
      ++malformed;
    }
  }
  EXPECT_EQ(malformed, 8);
  EXPECT_GE(good, 26);
}

}  // namespace
}  // namespace saker::lidar
