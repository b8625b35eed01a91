#include "saker/lidar/bags/bag_recording.h"

#include <gtest/gtest.h>

#include "made_bag.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/metadata.h"

namespace saker::lidar {
namespace {

using testing::MadeMessage;
using testing::TemporaryFolder;
using testing::write_bytes;

constexpr Time kBegin = 1'700'000'000 * kNanosecondsPerSecond;

std::string message_of(const std::filesystem::path& file, const RecordingOptions& options = {}) {
  try {
    (void)open_recording(file, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expect_made_drive(ScanSource& source) {
  int scans = 0;
  for (; const auto frame = source.next(); ++scans) {
    ASSERT_EQ(frame->fault, "");
    ASSERT_EQ(frame->scan.size(), 400U);
    // The message's stamp is the scan's begin: the stamp is the last point's.
    EXPECT_EQ(frame->scan.stamp, kBegin + scans * 100'000'000LL + 399 * 249'000LL);
    EXPECT_EQ(frame->scan.offset_ns[399], 0);
    EXPECT_EQ(frame->scan.offset_ns[0], -399 * 249'000);
    EXPECT_EQ(frame->scan.ring[17], 1);
    EXPECT_FLOAT_EQ(frame->scan.points[10].x(), 3);
    EXPECT_FLOAT_EQ(frame->scan.points[10].z(), 0.5F * static_cast<float>(scans));
    EXPECT_FLOAT_EQ(frame->scan.reflectivity[100], 50.0F / 255);
    ASSERT_EQ(frame->imu.size(), 10U) << scans;
    EXPECT_LE(frame->imu.back().stamp, frame->scan.stamp);
    EXPECT_DOUBLE_EQ(frame->imu[3].acceleration.x(), 0.1 * 3);
    EXPECT_DOUBLE_EQ(frame->imu[3].angular_velocity.z(), 0.1 * scans);
  }
  EXPECT_EQ(scans, 4);
  EXPECT_EQ(source.counters().imu_samples, 40);
  EXPECT_EQ(source.counters().summary(), "");
}

TEST(BagRecording, ScansTimesRingsAndInertialSamplesAreTheSameOfEveryFormat) {
  const TemporaryFolder folder;
  const auto ros1 = testing::made_drive(4, Encoding::kRos1);
  const auto ros2 = testing::made_drive(4, Encoding::kCdr);
  write_bytes(folder / "a.bag", testing::made_ros1_bag(ros1, {"lz4", 9, true, true}));
  write_bytes(folder / "b.mcap", testing::made_mcap(ros2, Encoding::kCdr, {"zstd", 9, true, true}));
  write_bytes(folder / "c.mcap",
              testing::made_mcap(ros1, Encoding::kRos1, {"none", 9, false, false}));
  testing::write_ros2_database(ros2, folder / "d.db3");
  for (const char* name : {"a.bag", "b.mcap", "c.mcap", "d.db3"}) {
    SCOPED_TRACE(name);
    const auto source = open_recording(folder / name);
    EXPECT_EQ(source->expected_scans(), 4);
    expect_made_drive(*source);
  }
}

TEST(BagRecording, IsToldByItsContentAndNotByItsName) {
  const TemporaryFolder folder;
  write_bytes(folder / "recording.bin",
              testing::made_ros1_bag(testing::made_drive(4, Encoding::kRos1)));
  const auto source = open_recording(folder / "recording.bin");
  expect_made_drive(*source);
}

TEST(BagRecording, SeveralTopicsAreListedAndOneIsChosen) {
  const TemporaryFolder folder;
  auto messages = testing::made_drive(4, Encoding::kRos1);
  for (MadeMessage m : testing::made_drive(4, Encoding::kRos1)) {
    if (m.type != "sensor_msgs/PointCloud2") continue;
    m.topic = "/rear/points";
    messages.push_back(m);
  }
  write_bytes(folder / "a.bag", testing::made_ros1_bag(messages));
  const std::string message = message_of(folder / "a.bag");
  EXPECT_NE(message.find("/points (sensor_msgs/PointCloud2, 4)"), std::string::npos) << message;
  EXPECT_NE(message.find("/rear/points"), std::string::npos) << message;
  EXPECT_NE(message.find("--topic"), std::string::npos) << message;
  RecordingOptions options;
  options.topics = {"/points"};
  expect_made_drive(*open_recording(folder / "a.bag", options));
  options.topics = {"/nowhere"};
  EXPECT_NE(message_of(folder / "a.bag", options).find("/nowhere"), std::string::npos);
}

TEST(BagRecording, WithoutATopicWithScansItSaysWhatThereIs) {
  const TemporaryFolder folder;
  auto messages = testing::made_drive(2, Encoding::kRos1);
  std::erase_if(messages, [](const MadeMessage& m) { return m.topic == "/points"; });
  write_bytes(folder / "a.bag", testing::made_ros1_bag(messages));
  EXPECT_NE(message_of(folder / "a.bag").find("/imu/data (sensor_msgs/Imu"), std::string::npos);
}

TEST(BagRecording, InertialSamplesAreTurnedIntoTheCloudsFrame) {
  const TemporaryFolder folder;
  auto messages = testing::made_drive(3, Encoding::kRos1);
  messages.insert(messages.begin(), {"/tf_static", "tf2_msgs/TFMessage", kBegin,
                                     testing::made_quarter_turn("lidar", "imu", Encoding::kRos1)});
  write_bytes(folder / "a.bag", testing::made_ros1_bag(messages));
  const auto frame = open_recording(folder / "a.bag")->next();
  ASSERT_TRUE(frame);
  // The unit's x is the lidar's y.
  EXPECT_NEAR(frame->imu[3].acceleration.y(), 0.3, 1e-9);
  EXPECT_NEAR(frame->imu[3].acceleration.x(), -0.2, 1e-9);
}

TEST(BagRecording, AccelerationsInGAreToldByTheirLength) {
  const TemporaryFolder folder;
  std::vector<MadeMessage> messages = testing::made_drive(3, Encoding::kCdr);
  for (MadeMessage& m : messages) {
    if (m.type != "sensor_msgs/Imu") continue;
    m.bytes = testing::made_imu(m.received, {0, 0, 1}, {0, 0, 0.1}, Encoding::kCdr);
  }
  write_bytes(folder / "a.mcap", testing::made_mcap(messages, Encoding::kCdr));
  const auto source = open_recording(folder / "a.mcap");
  EXPECT_NE(source->note().find("in g"), std::string::npos);
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  EXPECT_NEAR(frame->imu.front().acceleration.z(), 9.80665, 1e-9);
}

TEST(BagRecording, ACloudThatIsDamagedIsAFaultAndTheRecordingGoesOn) {
  const TemporaryFolder folder;
  auto messages = testing::made_drive(3, Encoding::kRos1);
  for (MadeMessage& m : messages) {
    if (m.topic == "/points" && m.received < kBegin + 150'000'000) m.bytes.resize(200);
  }
  write_bytes(folder / "a.bag", testing::made_ros1_bag(messages));
  const auto source = open_recording(folder / "a.bag");
  std::vector<std::string> faults;
  while (const auto frame = source->next()) faults.push_back(frame->fault);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_NE(faults[0], "");
  EXPECT_EQ(faults[1], "");
  EXPECT_EQ(source->counters().faulty_scans, 1);
}

std::vector<MadeMessage> made_packet_messages(const SensorInfo& info, bool metadata) {
  std::vector<MadeMessage> messages;
  const auto add = [&](const char* topic, const std::vector<std::uint8_t>& packet) {
    testing::MessageWriter writer(Encoding::kRos1);
    writer.bytes(packet);
    messages.push_back({topic, "ouster_ros/PacketMsg", kBegin + static_cast<Time>(messages.size()),
                        writer.done()});
  };
  for (int frame = 0; frame < 2; ++frame) {
    ImuSample sample;
    sample.stamp = testing::made_time(info, frame, 10);
    sample.acceleration = {1, 2, 9};
    sample.angular_velocity = {0.1, 0, 0};
    add("/os_node/imu_packets", encode_imu(sample, info));
    for (const auto& packet : testing::made_packets(info, frame, frame)) {
      add("/os_node/lidar_packets", packet);
    }
  }
  if (metadata) {
    testing::MessageWriter writer(Encoding::kRos1);
    writer.text(metadata_json(info));
    messages.push_back({"/os_node/metadata", "std_msgs/String", kBegin + 1'000'000, writer.done()});
  }
  return messages;
}

TEST(BagRecording, OustersPacketsAreDecodedByTheMetadataInTheBag) {
  const TemporaryFolder folder;
  const SensorInfo info = SensorInfo::make_os1(32, 512, PacketProfile::kRng15Rfl8Nir8Dual);
  write_bytes(folder / "a.bag", testing::made_ros1_bag(made_packet_messages(info, true)));
  RecordingOptions options;
  options.keep_ranges = true;
  const auto source = open_recording(folder / "a.bag", options);
  int frames = 0;
  for (; const auto frame = source->next(); ++frames) {
    EXPECT_EQ(frame->scan.rows, 32);
    ASSERT_NE(source->assembled(), nullptr);
    EXPECT_EQ(source->assembled()->ranges_mm, testing::made_ranges(info, frames));
    EXPECT_EQ(frame->imu.size(), 1U);
  }
  EXPECT_EQ(frames, 2);
}

TEST(BagRecording, OustersPacketsWithoutMetadataAskForThem) {
  const TemporaryFolder folder;
  const SensorInfo info = SensorInfo::make_os1(32, 512, PacketProfile::kLegacy);
  write_bytes(folder / "a.bag", testing::made_ros1_bag(made_packet_messages(info, false)));
  EXPECT_NE(message_of(folder / "a.bag").find("--meta"), std::string::npos);
  write_metadata(info, folder / "a.json");
  RecordingOptions options;
  options.metadata = folder / "a.json";
  EXPECT_TRUE(open_recording(folder / "a.bag", options)->next());
}

TEST(BagRecording, NamesOfTopicsStayInTheLineThatNamesThem) {
  const TemporaryFolder folder;
  auto messages = testing::made_drive(1, Encoding::kRos1);
  for (MadeMessage& m : messages) m.type = "std_msgs/Int8", m.topic = "/a\nb";
  write_bytes(folder / "a.bag", testing::made_ros1_bag(messages));
  const std::string message = message_of(folder / "a.bag");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_NE(message.find("/a?b (std_msgs/Int8"), std::string::npos) << message;
}

}  // namespace
}  // namespace saker::lidar
