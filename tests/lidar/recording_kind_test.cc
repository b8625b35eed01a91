#include "saker/lidar/recording_kind.h"

#include <gtest/gtest.h>

#include <fstream>

#include "made_bag.h"
#include "made_clouds.h"
#include "made_osf.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/recording.h"

namespace saker::lidar {
namespace {

using testing::TemporaryFolder;
using testing::write_bytes;
using Bytes = std::vector<std::uint8_t>;
using enum RecordingKind;

/// Of a file that holds that, whatever its name.
RecordingKind kind_of(const Bytes& bytes, const std::string& name = "recording") {
  const TemporaryFolder folder;
  write_bytes(folder / name, bytes);
  return recording_kind(folder / name);
}

Bytes text(const std::string& text) { return {text.begin(), text.end()}; }

Bytes ros1_bag() { return testing::made_ros1_bag(testing::made_drive(1, Encoding::kRos1)); }
Bytes mcap() { return testing::made_mcap(testing::made_drive(1, Encoding::kCdr), Encoding::kCdr); }

TEST(RecordingKind, IsToldByTheFirstBytes) {
  const auto points = testing::made_points(0);
  EXPECT_EQ(kind_of(ros1_bag()), kRos1Bag);
  EXPECT_EQ(kind_of(mcap()), kMcap);
  EXPECT_EQ(kind_of(testing::made_osf(testing::osf_sensor(), 1, false)), kOsf);
  EXPECT_EQ(kind_of(testing::made_pcd("binary", points)), kClouds);
  EXPECT_EQ(kind_of(testing::made_ply("ascii", points)), kClouds);
  EXPECT_EQ(kind_of(testing::made_npy(points)), kClouds);
  const TemporaryFolder folder;
  testing::write_ros2_database(testing::made_drive(1, Encoding::kCdr), folder / "recording");
  EXPECT_EQ(recording_kind(folder / "recording"), kRos2Database);
}

TEST(RecordingKind, OfACaptureIsToldInEitherOrderOfBytesAndPrecision) {
  for (const std::uint32_t magic : {0xA1B2C3D4U, 0xA1B23C4DU}) {
    for (const bool big_endian : {false, true}) {
      Bytes bytes;
      testing::put(bytes, magic, big_endian);
      EXPECT_EQ(kind_of(bytes), kCapture) << magic;
    }
  }
  EXPECT_EQ(kind_of({0x0A, 0x0D, 0x0D, 0x0A}), kCapture);  // pcapng
}

TEST(RecordingKind, IsNotToldByANameThatSaysAnother) {
  for (const char* name : {"a.pcap", "a.bin", "a.pcd", "a.json"}) {
    EXPECT_EQ(kind_of(ros1_bag(), name), kRos1Bag) << name;
    EXPECT_EQ(kind_of(mcap(), name), kMcap) << name;
  }
}

TEST(RecordingKind, OfFloatsIsToldByTheNameAsTheyHaveNoHead) {
  const Bytes floats = testing::made_floats(testing::made_points(0));
  EXPECT_EQ(kind_of(floats, "000000.bin"), kFloatScans);
  EXPECT_EQ(kind_of(floats, "000000.BIN"), kFloatScans);
  EXPECT_EQ(kind_of(floats, "000000.dat"), kUnknown);
}

TEST(RecordingKind, OfAFileThatIsNamedACaptureIsACaptureSoThatItsFaultIsSaid) {
  for (const char* name : {"a.pcap", "a.PCAP", "a.pcapng"}) EXPECT_EQ(kind_of({}, name), kCapture);
}

TEST(RecordingKind, OfOtherFilesIsUnknown) {
  for (const char* begin : {"", "a", "#ROSBAG V1.2\n", "ply", "polygon\n", "SQLite", "{\"a\": 1}",
                            "\x89PNG\r\n", "OSF$", "12345678OSF", "VERSIONS\n", "\x93NUM"}) {
    EXPECT_EQ(kind_of(text(begin)), kUnknown) << begin;
  }
  EXPECT_EQ(recording_kind("missing"), kUnknown);
}

TEST(RecordingParts, OfAFolderAreTheBagsInNaturalOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"drive_10.bag", "drive_9.bag", "drive_1.bag"}) {
    write_bytes(folder / name, ros1_bag());
  }
  std::ofstream(folder / "metadata.yaml") << "rosbag2_bagfile_information:\n";
  const RecordingParts parts = recording_parts(folder.path());
  EXPECT_EQ(parts.kind, kRos1Bag);
  EXPECT_EQ(parts.files,
            (std::vector{folder / "drive_1.bag", folder / "drive_9.bag", folder / "drive_10.bag"}));
}

/// What refuses a folder, or nothing.
std::string refusal(const std::filesystem::path& folder) {
  try {
    (void)recording_parts(folder);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RecordingParts, OfSeveralKindsAreRefusedWithAFileOfEach) {
  const TemporaryFolder folder;
  write_bytes(folder / "a.bag", ros1_bag());
  write_bytes(folder / "b.mcap", mcap());
  EXPECT_NE(refusal(folder.path()).find("a.bag and b.mcap"), std::string::npos);
}

TEST(RecordingParts, OfSeveralCapturesAreRefusedWithTheirNumber) {
  const TemporaryFolder folder;
  for (const char* name : {"a.pcap", "b.pcap", "c.pcap"}) write_bytes(folder / name, {});
  EXPECT_NE(refusal(folder.path()).find("3 captures"), std::string::npos);
}

TEST(RecordingParts, OfAFolderOfScansAreTheFolder) {
  const TemporaryFolder clouds, floats, empty;
  write_bytes(clouds / "0", testing::made_npy(testing::made_points(0)));
  write_bytes(floats / "0.bin", testing::made_floats(testing::made_points(0)));
  EXPECT_EQ(recording_parts(clouds.path()).kind, kClouds);
  EXPECT_EQ(recording_parts(floats.path()).kind, kFloatScans);
  EXPECT_EQ(recording_parts(floats.path()).files, std::vector{floats.path()});
  EXPECT_EQ(recording_parts(empty.path()).kind, kUnknown);
  EXPECT_TRUE(recording_parts(empty.path()).files.empty());
}

TEST(RecordingParts, ThatWereSplitReadAsOneRecording) {
  const TemporaryFolder folder;
  const auto messages = testing::made_drive(12, Encoding::kRos1);
  for (int part = 0; part < 12; ++part) {  // 1 … 12: by bytes, 10 would follow 1
    const auto begin = messages.begin() + 11 * part;
    write_bytes(folder / ("drive_" + std::to_string(part + 1) + ".bag"),
                testing::made_ros1_bag({begin, begin + 11}));
  }
  const auto source = open_recording(folder.path());
  EXPECT_EQ(source->expected_scans(), 12);
  int scans = 0;
  for (; const auto frame = source->next(); ++scans) {
    EXPECT_EQ(frame->scan.time_of(0), testing::kDriveBegin + scans * 100'000'000LL);
    EXPECT_EQ(frame->imu.size(), 10U);
  }
  EXPECT_EQ(scans, 12);
}

}  // namespace
}  // namespace saker::lidar
