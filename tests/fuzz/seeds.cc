#include "seeds.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <string>

#include "fuzz.h"
#include "lidar/made_bag.h"
#include "lidar/made_clouds.h"
#include "lidar/made_osf.h"
#include "lidar/made_sensor.h"
#include "lidar/made_spinning.h"
#include "saker/lidar/capture_writer.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/metadata.h"

/// fuzz_seeds FOLDER: FOLDER/TARGET/ with a few good inputs of each target, as the tests make them.
namespace saker::lidar::fuzz {

std::filesystem::path Seeds::file(const std::string& target) {
  std::filesystem::create_directories(folder_ / target);
  return folder_ / target / fmt::format("seed-{}", next_++);
}

void Seeds::add(const std::string& target, const SeedBytes& bytes) {
  testing::write_bytes(file(target), bytes);
}

SeedBytes behind(std::uint8_t first, std::string_view text) {
  SeedBytes all = {first};
  all.insert(all.end(), text.begin(), text.end());
  return all;
}

SeedBytes behind(std::uint8_t first, const SeedBytes& bytes) {
  return behind(first, text_of(bytes));
}

namespace {

using testing::Bytes;

void add_bags(Seeds& seeds) {
  const auto ros1 = testing::made_drive(1, Encoding::kRos1);
  const auto ros2 = testing::made_drive(1, Encoding::kCdr);
  for (const char* name : {"none", "lz4", "bz2"}) {
    seeds.add("ros1_bag", testing::made_ros1_bag(ros1, {name, 5, true, true}));
  }
  for (const char* name : {"none", "lz4", "zstd"}) {
    seeds.add("mcap", testing::made_mcap(ros2, Encoding::kCdr, {name, 5, true, true}));
  }
  seeds.add("mcap", testing::made_mcap(ros1, Encoding::kRos1, {"none", 5, false, false}));
  testing::write_ros2_database(ros2, seeds.file("ros2_database"));
  for (std::size_t i = 9; i < 11; ++i) {  // an inertial sample and a cloud
    seeds.add("ros_messages", behind(0, ros1[i].bytes));
    seeds.add("ros_messages", behind(1, ros2[i].bytes));
  }
  seeds.add("ros_messages", behind(1, testing::made_quarter_turn("lidar", "imu", Encoding::kCdr)));
}

/// Some packets of each sensor.
void add_spinning(Seeds& seeds) {
  using enum SpinningKind;
  std::uint8_t sensor = 0;
  for (const auto kind : {kVlp16, kVlp32c, kHdl32e, kHdl64e, kPandar64, kXt32, kQt64}) {
    testing::MadeSpinning made = testing::made_spinning(kind);
    made.turns = 0.02;
    for (const bool two : {false, true}) {
      made.two_returns = two;
      Bytes bytes = {sensor};
      for (const testing::MadePacket& packet : testing::made_packets(made)) {
        testing::put(bytes, packet.time);
        bytes.insert(bytes.end(), packet.bytes.begin(), packet.bytes.end());
      }
      seeds.add("spinning", bytes);
    }
    ++sensor;
  }
}

void add_clouds(Seeds& seeds) {
  auto points = testing::made_points(1);
  points.resize(40);
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    seeds.add("pcd", testing::made_pcd(data, points));
  }
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    seeds.add("ply", testing::made_ply(format, points));
  }
  seeds.add("npy", testing::made_npy(points));
  seeds.add("npy", testing::npy_of("'<f4'", "40, 6", testing::made_floats(points)));
  seeds.add("float_rows", testing::made_floats(testing::made_points(1)));
}

ImuSample imu_sample(const SensorInfo& info) {
  ImuSample sample;
  sample.stamp = testing::made_time(info, 0, 10);
  sample.acceleration = {1, 2, 9};
  sample.angular_velocity = {0.1, 0, 0};
  return sample;
}

void add_ouster(Seeds& seeds) {
  const auto& profiles = packet_profiles();
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const SensorInfo info = sensor(profiles[i]);
    Bytes bytes = {static_cast<std::uint8_t>(i)};
    for (const Bytes& packet : testing::made_packets(info, 0, 0)) {
      const Bytes marked = behind(1, packet);
      bytes.insert(bytes.end(), marked.begin(), marked.end());
      if (bytes.size() > 8192) break;
    }
    seeds.add("packet", bytes);
    const std::string json = metadata_json(info);
    seeds.add("metadata", {json.begin(), json.end()});
  }
  const SensorInfo info = sensor(PacketProfile::kRng15Rfl8Nir8);
  seeds.add("imu_packet", encode_imu(imu_sample(info), info));
  seeds.add("imu_packet", encode_imu(std::vector<ImuSample>(8, imu_sample(info)), info));
  CaptureWriter writer(seeds.file("capture"));
  writer.write(0, info.imu_port, encode_imu(imu_sample(info), info));
  for (const Bytes& packet : testing::made_packets(info, 0, 0)) {
    writer.write(0, info.lidar_port, packet);
  }
  writer.finish();
  for (const bool png : {false, true}) {
    seeds.add("osf", testing::made_osf(testing::osf_sensor(), 1, png));
  }
}

/// Each message behind a byte of its size, which is odd for binary ones.
void add_ground(Seeds& seeds) {
  const auto add = [&](const std::string& message, int binary) {
    const Bytes bytes(message.begin(), message.end());
    seeds.add("ground_message",
              behind(static_cast<std::uint8_t>(2 * bytes.size() + binary), bytes));
  };
  add(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":1,"channelId":5}]})", 0);
  add(R"({"op":"unsubscribe","subscriptionIds":[0]})", 0);
  add(R"({"op":"getParameters","parameterNames":[],"id":"a"})", 0);
  add({"\2\1\0\0\0\1\0\0\0\4\0\0\0json{\"t_s\":1}", 26}, 1);
  add({"\3\0\0\0\200?\1\0\0\0\0\0\0\0\0\2\0\0\0id", 21}, 1);
}

}  // namespace
}  // namespace saker::lidar::fuzz

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "fuzz_seeds FOLDER\n";
    return 2;
  }
  saker::lidar::fuzz::Seeds seeds(words[1]);
  saker::lidar::fuzz::add_bags(seeds);
  saker::lidar::fuzz::add_clouds(seeds);
  saker::lidar::fuzz::add_spinning(seeds);
  saker::lidar::fuzz::add_ouster(seeds);
  saker::lidar::fuzz::add_ground(seeds);
  saker::lidar::fuzz::add_flight(seeds);
}
