#include "saker/lidar/ouster_senders.h"

#include <gtest/gtest.h>

#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/capture_writer.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/ouster_capture.h"

namespace saker::lidar {
namespace {

using testing::made_packets;
using testing::TemporaryFolder;

SensorInfo sensor(const char* serial, int columns = 512) {
  SensorInfo info = SensorInfo::make_os1(16, columns, PacketProfile::kRng15Rfl8Nir8);
  info.serial_number = serial;
  return info;
}

/// Packets of the sensors by turns, four frames each.
void write_capture(const std::vector<SensorInfo>& sensors, const std::filesystem::path& file) {
  CaptureWriter writer(file);
  for (int frame = 0; frame < 4; ++frame) {
    std::vector<std::vector<testing::Bytes>> packets;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      packets.push_back(made_packets(sensors[i], frame, frame + 100 * static_cast<int>(i)));
    }
    for (std::size_t k = 0; k < packets[0].size(); ++k) {
      for (std::size_t i = 0; i < sensors.size(); ++i) {
        writer.write(frame, sensors[i].lidar_port, packets[i][k]);
      }
    }
  }
  writer.finish();
}

std::string message_of(const TemporaryFolder& folder, const std::string& chosen = {}) {
  try {
    const OusterCapture capture(folder / "a.pcap", folder / "a.json", false, chosen);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(OusterSenders, TwoSensorsInOneCaptureAreTwoStreams) {
  const TemporaryFolder folder;
  write_capture({sensor("1001"), sensor("1002")}, folder / "a.pcap");
  write_metadata(sensor("1002"), folder / "a.json");
  const std::string message = message_of(folder);
  EXPECT_NE(message.find("1001"), std::string::npos) << message;
  EXPECT_NE(message.find("1002"), std::string::npos) << message;
  EXPECT_NE(message.find("--sensor"), std::string::npos) << message;

  OusterCapture capture(folder / "a.pcap", folder / "a.json", true, "1002");
  int frames = 0;
  for (; const auto item = capture.next_item(); ++frames) {
    EXPECT_EQ(item->assembled.frame_id, 100 + frames);
    EXPECT_EQ(item->assembled.valid_columns, 512);
  }
  EXPECT_EQ(frames, 4);
  EXPECT_EQ(capture.counters().other_sensors, 4 * 32);
  EXPECT_EQ(capture.counters().late_packets, 0);
}

TEST(OusterSenders, MetadataOfAnotherSerialNumberAreRefusedWithBoth) {
  const TemporaryFolder folder;
  write_capture({sensor("1001")}, folder / "a.pcap");
  write_metadata(sensor("1002"), folder / "a.json");
  const std::string message = message_of(folder);
  EXPECT_NE(message.find("sensor 1001"), std::string::npos) << message;
  EXPECT_NE(message.find("1002"), std::string::npos) << message;
  EXPECT_NE(message_of(folder, "1003").find("--sensor 1003"), std::string::npos);
}

TEST(OusterSenders, MetadataOfAnotherModeAreRefusedWithBoth) {
  for (const auto& [sent, said] : std::vector<std::pair<int, int>>{{1024, 512}, {512, 1024}}) {
    const TemporaryFolder folder;
    write_capture({sensor("1001", sent)}, folder / "a.pcap");
    write_metadata(sensor("1001", said), folder / "a.json");
    const std::string message = message_of(folder);
    EXPECT_NE(message.find("columns up to " + std::to_string(sent - 1)), std::string::npos)
        << message;
    EXPECT_NE(message.find("expected up to " + std::to_string(said - 1)), std::string::npos)
        << message;
  }
}

TEST(OusterStream, InertialSamplesOfAnotherClockAreTakenAtTheirArrival) {
  const SensorInfo info = sensor("1001");
  OusterStream stream(info);
  int packets = 0;
  std::size_t samples = 0;
  for (int frame = 0; frame < 3; ++frame) {
    for (const auto& packet : made_packets(info, frame, frame)) {
      stream.add(packet);
      if (packets++ % 4 != 0) continue;
      std::vector<ImuSample> eight(8);
      for (int i = 0; i < 8; ++i) {
        eight[i].stamp = 77'000'000'000'000 + packets * 3'000'000LL + i * 300'000LL;
        eight[i].acceleration = {0, 0, 9.8};
        eight[i].angular_velocity = {0, 0, 0.1};
      }
      stream.add(encode_imu(eight, info));
    }
    while (const auto item = stream.take()) {
      samples += item->frame.imu.size();
      for (const ImuSample& sample : item->frame.imu) {
        EXPECT_LT(std::abs(to_seconds(item->frame.scan.stamp - sample.stamp)), 0.3);
      }
    }
  }
  EXPECT_TRUE(stream.imu_by_arrival());
  EXPECT_GT(samples, 100U);
}

TEST(OusterStream, OneInertialPacketWithAWildTimeIsDropped) {
  const SensorInfo info = sensor("1001");
  OusterStream stream(info);
  for (const auto& packet : made_packets(info, 0, 0)) stream.add(packet);
  ImuSample wild;
  wild.stamp = 77'000'000'000'000;
  wild.acceleration = {0, 0, 9.8};
  wild.angular_velocity = {0, 0, 0};
  stream.add(encode_imu(wild, info));
  stream.finish();
  EXPECT_FALSE(stream.imu_by_arrival());
  EXPECT_EQ(stream.late_imu_samples(), 1);
}

}  // namespace
}  // namespace saker::lidar
