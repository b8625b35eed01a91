#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "damage.h"
#include "made_bag.h"
#include "made_clouds.h"
#include "made_osf.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/capture_writer.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/metadata.h"

/// Whatever the bytes are: a line, or frames whose sizes agree (damage.h).
namespace saker::lidar {
namespace {

using testing::expect_survives_damage;
using testing::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(DamagedRecordings, OfRos1BagsOfEveryCompression) {
  const auto messages = testing::made_drive(2, Encoding::kRos1);
  for (const char* compression : {"none", "lz4", "bz2"}) {
    SCOPED_TRACE(compression);
    const TemporaryFolder folder;
    expect_survives_damage(testing::made_ros1_bag(messages, {compression, 7, true, true}),
                           folder / "drive.bag");
  }
}

TEST(DamagedRecordings, OfRos1BagsWithoutAnIndex) {
  const TemporaryFolder folder;
  expect_survives_damage(
      testing::made_ros1_bag(testing::made_drive(2, Encoding::kRos1), {"none", 7, false, true}),
      folder / "drive.bag");
}

TEST(DamagedRecordings, OfMcapFilesOfEveryCompression) {
  const auto messages = testing::made_drive(2, Encoding::kCdr);
  for (const char* compression : {"none", "lz4", "zstd"}) {
    SCOPED_TRACE(compression);
    const TemporaryFolder folder;
    expect_survives_damage(
        testing::made_mcap(messages, Encoding::kCdr, {compression, 7, true, true}),
        folder / "drive.mcap");
  }
}

TEST(DamagedRecordings, OfMcapFilesWithoutChunksOrSummary) {
  const TemporaryFolder folder;
  expect_survives_damage(testing::made_mcap(testing::made_drive(2, Encoding::kRos1),
                                            Encoding::kRos1, {"none", 7, false, false}),
                         folder / "drive.mcap");
}

TEST(DamagedRecordings, OfRos2Databases) {
  const TemporaryFolder folder;
  testing::write_ros2_database(testing::made_drive(2, Encoding::kCdr), folder / "whole.db3");
  expect_survives_damage(bytes_of(folder / "whole.db3"), folder / "drive.db3");
}

TEST(DamagedRecordings, OfOsfFilesOfBothPackings) {
  for (const bool png : {false, true}) {
    SCOPED_TRACE(png);
    const TemporaryFolder folder;
    expect_survives_damage(testing::made_osf(testing::osf_sensor(), 1, png), folder / "drive.osf");
  }
}

TEST(DamagedRecordings, OfPcdFilesOfEveryKind) {
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    SCOPED_TRACE(data);
    const TemporaryFolder folder;
    expect_survives_damage(testing::made_pcd(data, testing::made_points(1)), folder / "scan.pcd");
  }
}

TEST(DamagedRecordings, OfPlyFilesOfEveryKind) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(format);
    const TemporaryFolder folder;
    expect_survives_damage(testing::made_ply(format, testing::made_points(1)), folder / "scan.ply");
  }
}

TEST(DamagedRecordings, OfNumpyFilesWithAndWithoutNames) {
  const auto points = testing::made_points(1);
  const TemporaryFolder folder;
  expect_survives_damage(testing::made_npy(points), folder / "scan.npy");
  expect_survives_damage(testing::npy_of("'<f4'", "400, 6", testing::made_floats(points)),
                         folder / "scan.npy");
}

TEST(DamagedRecordings, OfFloatsOfAnyNumber) {
  const TemporaryFolder folder;
  expect_survives_damage(testing::made_floats(testing::made_points(1)), folder / "scan.bin");
}

/// Two frames with an inertial sample each.
Bytes made_capture(const SensorInfo& info, const TemporaryFolder& folder) {
  CaptureWriter writer(folder / "whole.pcap");
  for (int frame = 0; frame < 2; ++frame) {
    ImuSample sample;
    sample.stamp = testing::made_time(info, frame, 10);
    sample.acceleration = {1, 2, 9};
    sample.angular_velocity = {0.1, 0, 0};
    writer.write(frame, info.imu_port, encode_imu(sample, info));
    for (const auto& packet : testing::made_packets(info, frame, frame)) {
      writer.write(frame, info.lidar_port, packet);
    }
  }
  writer.finish();
  return bytes_of(folder / "whole.pcap");
}

TEST(DamagedRecordings, OfCapturesOfLongAndShortProfiles) {
  for (const PacketProfile profile : {PacketProfile::kLegacy, PacketProfile::kRng15Rfl8Nir8}) {
    const TemporaryFolder folder;
    const SensorInfo info = SensorInfo::make_os1(16, 512, profile);
    write_metadata(info, folder / "drive.json");
    expect_survives_damage(made_capture(info, folder), folder / "drive.pcap");
  }
}

TEST(DamagedRecordings, OfACapturesMetadata) {
  const TemporaryFolder folder;
  const SensorInfo info = SensorInfo::make_os1(16, 512, PacketProfile::kRng15Rfl8Nir8);
  (void)made_capture(info, folder);
  const std::string json = metadata_json(info);
  RecordingOptions options;
  options.metadata = folder / "drive.json";
  int opened = 0;
  testing::for_each_damage({json.begin(), json.end()}, [&](const Bytes& bytes) {
    testing::write_bytes(options.metadata, bytes);
    try {
      const auto source = open_recording(folder / "whole.pcap", options);
      while (const auto frame = source->next()) testing::expect_consistent(*frame);
      ++opened;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  });
  EXPECT_GT(opened, 0);
}

}  // namespace
}  // namespace saker::lidar
