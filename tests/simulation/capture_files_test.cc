#include "saker/simulation/mission/capture_files.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/lidar/ouster_stream.h"
#include "saker/lidar/recording.h"

namespace saker::simulation {
namespace {

/// A scan of ranges that no two pixels share with their neighbours.
CastScan made_up(int rows, int columns, int index) {
  CastScan scan;
  scan.rows = rows;
  scan.columns = columns;
  for (int i = 0; i < rows * columns; ++i) {
    const bool empty = i % 11 == 0;
    scan.range_m.push_back(
        empty ? 0 : 0.6F + static_cast<float>((i * 37 + index * 101) % 90000) * 1e-3F);
    scan.reflectivity.push_back(0.5F);
  }
  return scan;
}

struct Sent {
  std::filesystem::path capture;
  std::vector<SensorCapture::Ranges> ranges;
};

Sent send(const CaptureConfig& config, const std::string& name, int scans) {
  const std::filesystem::path folder = testing::TempDir();
  SensorCapture capture(folder, name, config, 7);
  Sent sent{folder / (name + ".pcap"), {}};
  for (int i = 0; i < scans; ++i) {
    const Time start = 1000 * kNanosecondsPerSecond + from_seconds(0.1 * i);
    lidar::ImuSample imu;
    imu.stamp = start + from_seconds(0.03);
    imu.acceleration = {0.1, 0.2, 9.8};
    imu.angular_velocity = {0.01, 0.02, 0.03};
    sent.ranges.push_back(
        capture.write(made_up(config.rows, config.columns, i), i + 1, start, {&imu, 1}));
  }
  capture.finish();
  return sent;
}

/// Decodes the capture and compares each destaggered range with what was sent.
void expect_decoded(const CaptureConfig& config, const Sent& sent) {
  const lidar::SensorInfo info = sensor_info(config);
  const auto source = lidar::open_recording(sent.capture);
  for (const SensorCapture::Ranges& ranges : sent.ranges) {
    const auto frame = source->next();
    ASSERT_TRUE(frame.has_value());
    ASSERT_EQ(frame->scan.points.size(), ranges.size());
    EXPECT_EQ(frame->imu.size(), 1U);
    const lidar::RayTable rays(info);
    for (int row = 0; row < info.rows; ++row) {
      for (int column = 0; column < info.columns; ++column) {
        const std::uint32_t range = ranges[static_cast<std::size_t>(row) * info.columns + column];
        const int shifted = (column + info.pixel_shift_by_row[row] + info.columns) % info.columns;
        const Eigen::Vector3f& p =
            frame->scan.points[static_cast<std::size_t>(row) * info.columns + shifted];
        if (range == 0) {
          ASSERT_TRUE(std::isnan(p.x()));
          continue;
        }
        const auto& ray = rays.ray(row, column);
        ASSERT_NEAR((p - ray.origin - 1e-3F * static_cast<float>(range) * ray.direction).norm(), 0,
                    1e-3);
      }
    }
  }
  EXPECT_FALSE(source->next().has_value());
}

TEST(CaptureFiles, EveryProfileAndSizeDecodesToWhatWasSent) {
  for (const lidar::PacketProfile profile : lidar::packet_profiles()) {
    for (const int rows : {16, 32, 64, 128}) {
      for (const int columns : {512, 1024, 2048}) {
        CaptureConfig config;
        config.profile = lidar::to_string(profile);
        config.rows = rows;
        config.columns = columns;
        SCOPED_TRACE(config.profile + " " + std::to_string(rows) + "x" + std::to_string(columns));
        expect_decoded(config, send(config, "profiles", 1));
      }
    }
  }
}

TEST(CaptureFiles, AWindowThatWrapsLeavesTheOtherColumnsOut) {
  CaptureConfig config;
  config.columns = 512;
  config.window_first = 400;
  config.window_last = 99;
  const Sent sent = send(config, "window", 1);
  int returns = 0;
  for (const std::uint32_t range : sent.ranges[0]) returns += range > 0;
  EXPECT_NEAR(returns, 64 * 212 * 10 / 11, 64 * 4);
  expect_decoded(config, sent);
}

TEST(CaptureFiles, PacketsLostRepeatedLateAndInFragmentsDecodeToWhatWasSent) {
  CaptureConfig config;
  config.columns = 1024;
  config.lost_share = 0.05;
  config.repeated_share = 0.1;
  config.late_share = 0.2;
  config.mtu = 576;
  expect_decoded(config, send(config, "impaired", 3));
}

TEST(CaptureFiles, AnUnknownProfileIsRefusedByName) {
  CaptureConfig config;
  config.profile = "RNG99";
  try {
    (void)sensor_info(config);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("RNG99"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::simulation
