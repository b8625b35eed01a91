#include "saker/lidar/ouster_capture.h"

#include <gtest/gtest.h>

#include <fstream>

#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/capture_writer.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/metadata.h"

namespace saker::lidar {
namespace {

using testing::made_packets;
using testing::TemporaryFolder;

SensorInfo sensor(PacketProfile profile) {
  SensorInfo info = SensorInfo::make_os1(64, 512, profile);
  info.column_window = {300, 210};  // wraps
  return info;
}

/// Frames with a lost, a repeated and a late packet, in fragments, beside other traffic.
void write_capture(const SensorInfo& info, const std::filesystem::path& file, int frames) {
  CaptureWriter writer(file);
  testing::Bytes held_back;
  for (int frame = 0; frame < frames; ++frame) {
    auto packets = made_packets(info, frame, frame);
    if (frame == 1) packets.erase(packets.begin() + 3);
    if (frame == 2) packets.insert(packets.begin() + 5, packets[4]);
    if (frame == 3) {
      held_back = packets.back();
      packets.pop_back();
    }
    if (frame == 4) packets.insert(packets.begin() + 1, held_back);
    for (const auto& packet : packets) writer.write(frame, info.lidar_port, packet);
    writer.write(frame, 5353, testing::Bytes(99, 1));
  }
  writer.finish();
}

TEST(OusterCapture, DecodesEveryProfileWithPacketsLostRepeatedAndLateInFragments) {
  for (const PacketProfile profile : packet_profiles()) {
    const TemporaryFolder folder;
    const SensorInfo info = sensor(profile);
    write_metadata(info, folder / "drive.json");
    write_capture(info, folder / "drive.pcap", 6);
    OusterCapture capture(folder / "drive.pcap", folder / "drive.json", true);
    int frames = 0;
    for (; const auto item = capture.next_item(); ++frames) {
      if (frames == 1 || frames == 3) continue;  // not complete
      EXPECT_EQ(item->assembled.ranges_mm, testing::made_ranges(info, frames));
    }
    EXPECT_EQ(frames, 6);
    EXPECT_EQ(capture.counters().late_packets, 1);
    EXPECT_EQ(capture.counters().repeated_columns, 16);
    EXPECT_GT(capture.counters().missing_columns, 16);
    EXPECT_EQ(capture.counters().bad_packets, 0);  // other traffic is none of them
  }
}

TEST(OusterCapture, ACutCaptureGivesItsWholeFramesAndSaysSo) {
  const TemporaryFolder folder;
  const SensorInfo info = sensor(PacketProfile::kLegacy);
  write_metadata(info, folder / "drive.json");
  write_capture(info, folder / "drive.pcap", 6);
  std::filesystem::resize_file(folder / "drive.pcap",
                               std::filesystem::file_size(folder / "drive.pcap") * 2 / 3);
  const auto source = open_recording(folder / "drive.pcap");
  int frames = 0;
  while (source->next()) ++frames;
  EXPECT_GE(frames, 4);
  EXPECT_LT(frames, 6);
  EXPECT_NE(source->counters().ended_early, "");
}

TEST(OusterCapture, InertialSamplesComeWithTheirScan) {
  const TemporaryFolder folder;
  const SensorInfo info = sensor(PacketProfile::kLegacy);
  write_metadata(info, folder / "drive.json");
  CaptureWriter writer(folder / "drive.pcap");
  ImuSample sample;
  sample.stamp = testing::made_time(info, 0, 100);
  sample.acceleration = {1, 2, 9};
  sample.angular_velocity = {0.1, 0, 0};
  writer.write(0, info.imu_port, encode_imu(sample, info));
  for (const auto& packet : made_packets(info, 0, 0)) writer.write(0, info.lidar_port, packet);
  writer.finish();
  const auto frame = open_recording(folder / "drive.pcap")->next();
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->imu.size(), 1U);
  EXPECT_LT((frame->imu[0].acceleration - sample.acceleration).norm(), 1e-5);
}

TEST(OusterCapture, MetadataOfAnotherSensorIsRefusedWithBothSizes) {
  const TemporaryFolder folder;
  write_metadata(sensor(PacketProfile::kRng15Rfl8Nir8), folder / "drive.json");
  write_capture(sensor(PacketProfile::kLegacy), folder / "drive.pcap", 1);
  try {
    (void)open_recording(folder / "drive.pcap");
    FAIL();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("4352 bytes (RNG15_RFL8_NIR8"), std::string::npos) << message;
    EXPECT_NE(message.find("of 12608"), std::string::npos) << message;
  }
}

TEST(OpenRecording, FindsMetadataByTheStemOrWithoutItsLastPart) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)find_metadata(folder / "drive_000.pcap"), Error);  // no such capture
  std::ofstream(folder / "drive_000.pcap") << "capture";
  EXPECT_THROW((void)find_metadata(folder / "drive_000.pcap"), Error);
  std::ofstream(folder / "drive.json") << "{}";
  EXPECT_EQ(find_metadata(folder / "drive_000.pcap"), folder / "drive.json");
  std::ofstream(folder / "drive_000.json") << "{}";
  EXPECT_EQ(find_metadata(folder / "drive_000.pcap"), folder / "drive_000.json");
  std::ofstream(folder / "drive-001.PCAP") << "capture";
  EXPECT_EQ(find_metadata(folder / "drive-001.PCAP"), folder / "drive.json");
  std::ofstream(folder / "other.pcap") << "capture";
  std::ofstream(folder / "other_0.json") << "{}";
  EXPECT_EQ(find_metadata(folder / "other.pcap"), folder / "other_0.json");
}

TEST(OpenRecording, RefusesWhatIsNoRecording) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)open_recording(folder / "missing"), Error);
  EXPECT_THROW((void)open_recording(folder.path()), Error);
  std::ofstream(folder / "drive.txt") << "text";
  EXPECT_THROW((void)open_recording(folder / "drive.txt"), Error);
}

}  // namespace
}  // namespace saker::lidar
