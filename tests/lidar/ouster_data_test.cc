#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "made_sensor.h"
#include "md5.h"
#include "paths.h"
#include "saker/lidar/capture_reader.h"
#include "saker/lidar/kitti_folder.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/ouster_capture.h"
#include "saker/lidar/sensor_gate.h"

namespace saker::lidar {
namespace {

namespace fs = std::filesystem;

const fs::path kData = source_dir() + "/../shared/data";

std::vector<fs::path> captures() {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(kData / "ouster", ignored)) {
    if (entry.path().extension() == ".pcap") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The vendor's digest of RANGE for each frame; empty when the capture has none.
std::vector<std::string> digests(const fs::path& capture) {
  std::ifstream in(capture.parent_path() / (capture.stem().string() + "_digest.json"));
  std::vector<std::string> ranges;
  if (!in) return ranges;
  const auto digest = nlohmann::json::parse(in);
  for (const auto& scan : digest.at("scans")) ranges.push_back(scan.at("RANGE"));
  return ranges;
}

TEST(Md5, AgreesWithTheExamplesOfItsStandard) {
  EXPECT_EQ(testing::md5("", 0), "d41d8cd98f00b204e9800998ecf8427e");
  EXPECT_EQ(testing::md5("message digest", 14), "f96b697d7cb7938d525a2f31aaf161d0");
}

TEST(OusterData, RangesHaveTheVendorsDigests) {
  if (captures().empty()) GTEST_SKIP() << "no captures in " << kData;
  int compared = 0;
  for (const fs::path& file : captures()) {
    const auto expected = digests(file);
    if (expected.empty()) continue;
    OusterCapture capture(file, find_metadata(file), true);
    std::vector<std::string> found;
    while (const auto item = capture.next_item()) {
      const auto& ranges = item->assembled.ranges_mm;
      found.push_back(testing::md5(ranges.data(), ranges.size() * sizeof ranges[0]));
    }
    EXPECT_EQ(found, expected) << file;
    EXPECT_EQ(capture.counters().summary(), "") << file;
    ++compared;
  }
  EXPECT_GE(compared, 5);
}

// Of what a real sensor sends nothing is refused, once it is known.
TEST(OusterData, TheGateBelievesEveryPacketOfARealSensor) {
  if (captures().empty()) GTEST_SKIP() << "no captures in " << kData;
  long passed = 0;
  for (const fs::path& file : captures()) {
    SensorGate gate(read_metadata(find_metadata(file)));
    CaptureReader reader(file);
    long refused = 0;
    while (const auto datagram = reader.next()) {
      const UdpSource from{1, static_cast<std::uint16_t>(datagram->port)};  // a port each, as sent
      const GateVerdict verdict = gate.judge(datagram->payload, from, datagram->captured);
      passed += verdict.passes();
      refused += !verdict.passes() && verdict.cause != GateCause::not_agreed;
    }
    EXPECT_EQ(refused, 0) << file;
  }
  EXPECT_GT(passed, 100);
}

TEST(OusterData, GravityPointsUpInTheSensorFrame) {
  if (captures().empty()) GTEST_SKIP() << "no captures in " << kData;
  int samples = 0;
  for (const fs::path& file : captures()) {
    const auto source = open_recording(file);
    while (const auto frame = source->next()) {
      for (const ImuSample& sample : frame->imu) {
        ++samples;
        EXPECT_NEAR(sample.acceleration.norm(), 9.81, 1.5) << file;
        EXPECT_GT(sample.acceleration.z(), 8) << file;
        EXPECT_LT(frame->scan.stamp - sample.stamp, kNanosecondsPerSecond);
      }
    }
  }
  EXPECT_GT(samples, 30);
}

TEST(OusterData, NeighboursInARowAreNeighboursInAzimuth) {
  if (captures().empty()) GTEST_SKIP() << "no captures in " << kData;
  for (const fs::path& file : captures()) {
    const auto frame = open_recording(file)->next();
    ASSERT_TRUE(frame && frame->scan.organised());
    const Scan& scan = frame->scan;
    int compared = 0;
    int near = 0;
    for (int column = 0; column < scan.columns; ++column) {
      double reference = NAN;
      for (int row = 0; row < scan.rows; ++row) {
        const Eigen::Vector3f& p =
            scan.points[static_cast<std::size_t>(row) * scan.columns + column];
        if (!p.allFinite() || p.head<2>().norm() < 2) continue;
        const double azimuth = std::atan2(p.y(), p.x());
        if (std::isnan(reference)) reference = azimuth;
        const double apart = std::abs(std::remainder(azimuth - reference, 2 * M_PI));
        near += apart < 1.5 * 2 * M_PI / scan.columns + 0.01;
        ++compared;
      }
    }
    EXPECT_GT(near, 0.97 * compared) << file;
  }
}

TEST(KittiData, ReadsEveryScanOfARealDrive) {
  if (!fs::exists(kData / "unpack")) GTEST_SKIP() << "no recordings in " << kData;
  const testing::TemporaryFolder folder;
  const std::string command = (kData / "unpack").string() + " semantic_kitti_00 " +
                              (folder / "drive").string() + " >/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto source = open_recording(folder / "drive");
  int scans = 0;
  Time last = -1;
  while (const auto frame = source->next()) {
    EXPECT_EQ(frame->fault, "");
    EXPECT_GT(frame->scan.size(), 50000U);
    EXPECT_GT(frame->scan.stamp, last);
    last = frame->scan.stamp;
    ++scans;
  }
  EXPECT_EQ(scans, 10);
}

}  // namespace
}  // namespace saker::lidar
