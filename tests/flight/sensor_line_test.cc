#include "flight/executive/sensor_line.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "../lidar/made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/imu_packet.h"

namespace saker::flight {
namespace {

using lidar::GateCause;
using lidar::testing::Bytes;
using Steady = SensorLine::Steady;
using std::chrono::milliseconds;

constexpr std::uint32_t kHere = 0x7F000001, kElsewhere = 0x7F000002;  // both on this machine

/// A socket of an address of this machine.
class Sender {
 public:
  explicit Sender(std::uint32_t address) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    const sockaddr_in from = socket_address(address, 0);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&from), sizeof from), 0);
  }
  ~Sender() { ::close(socket_); }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

  void send(const Bytes& bytes, int port) const {
    const sockaddr_in to = socket_address(kHere, port);
    (void)::sendto(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT,
                   reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

 private:
  static sockaddr_in socket_address(std::uint32_t address, int port) {
    sockaddr_in result{};
    result.sin_family = AF_INET;
    result.sin_port = htons(static_cast<std::uint16_t>(port));
    result.sin_addr.s_addr = htonl(address);
    return result;
  }

  int socket_;
};

/// Two free ports.
lidar::SensorInfo described() {
  auto info = lidar::SensorInfo::make_os1(16, 512, lidar::PacketProfile::kRng15Rfl8Nir8);
  info.serial_number = "122000000001";
  info.initialization_id = 7;
  const lidar::UdpReceiver first(0), second(0);
  info.lidar_port = first.port();
  info.imu_port = second.port();
  return info;
}

/// A sensor that sends in real time, and what of it passes.
class ASensorLine : public ::testing::Test {
 protected:
  [[nodiscard]] Time stamp() const {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Steady::now() - begin).count() +
           kNanosecondsPerSecond;
  }
  void send(const Sender& lidar, const Sender& imu) {
    const Time period = from_seconds(info.column_period_s());
    const auto column = static_cast<int>(stamp() / period) / 16 * 16;  // of all
    std::vector<lidar::Column> columns;
    for (int i = 0; i < 16; ++i) {
      lidar::Column one = lidar::testing::made_column(info, 0, column / 512, column % 512 + i);
      one.time = (column + i) * period;
      columns.push_back(std::move(one));
    }
    if (column != sent) lidar.send(lidar::PacketFormat(info).encode(columns), info.lidar_port);
    sent = column;
    imu.send(sample(stamp()), info.imu_port);
  }
  [[nodiscard]] Bytes sample(Time at) const {
    lidar::ImuSample one;
    one.stamp = at;
    one.acceleration = {0, 0, 9.8};
    one.angular_velocity = {0, 0, 0};
    return lidar::encode_imu(one, info);
  }
  void turn() {
    line.turn([this](const SensorLine::Packet& packet) {
      ++(packet.payload.size() == lidar::kImuPacketBytes ? imu_passed : lidar_passed);
    });
  }
  void run(milliseconds time) {
    for (const auto end = Steady::now() + time; Steady::now() < end;) {
      send(sensor, sensor_imu);
      turn();
      std::this_thread::sleep_for(milliseconds(5));
    }
  }
  /// Until what it publishes once a second is of now.
  [[nodiscard]] SensorLine::Figures figures() {
    run(milliseconds(1050));
    return *line.figures();
  }

  lidar::SensorInfo info = described();
  SensorLine line{{}, info, 200};
  Sender sensor{kHere}, sensor_imu{kHere}, stranger{kElsewhere};
  Steady::time_point begin = Steady::now();
  int sent = -1;
  long lidar_passed = 0, imu_passed = 0;
};

TEST_F(ASensorLine, PassesOnWhatTheSensorSends) {
  run(milliseconds(300));
  EXPECT_GT(lidar_passed, 10);
  EXPECT_GT(imu_passed, 10);
  EXPECT_EQ(figures().gate.agreements, 1);
}

TEST_F(ASensorLine, AnEmptyDatagramEndsNoTurn) {
  run(milliseconds(300));
  const long before = imu_passed;
  sensor_imu.send({}, info.imu_port);
  sensor_imu.send(sample(stamp()), info.imu_port);
  turn();
  EXPECT_EQ(imu_passed, before + 1);
}

TEST_F(ASensorLine, WhatOthersSendIsLeftToTheKernel) {
  run(milliseconds(300));
  const SensorLine::Figures before = figures();
  for (int i = 0; i < 5000; ++i) {
    stranger.send(sample(stamp()), info.imu_port);
    stranger.send(Bytes(1400, 1), info.lidar_port);
  }
  const long passed = imu_passed;
  const SensorLine::Figures after = figures();
  EXPECT_EQ(after.kernel_drops - before.kernel_drops, 10'000);
  EXPECT_EQ(after.gate.refused, before.gate.refused);
  EXPECT_EQ(after.cut_turns, before.cut_turns);
  EXPECT_GT(imu_passed, passed + 50);
}

// By a sender that copies even the sensor's address and port: the turn ends, the other port is
// heard.
TEST_F(ASensorLine, AFloodOfOnePortEndsTheTurnAndLeavesTheOtherItsShare) {
  run(milliseconds(300));
  for (int i = 0; i < 3000; ++i) sensor.send(Bytes(100, 1), info.lidar_port);
  const long before = imu_passed;
  const auto began = Steady::now();
  sensor_imu.send(sample(stamp()), info.imu_port);
  turn();
  EXPECT_LT(Steady::now() - began, milliseconds(50));  // 1 ms where nothing else runs
  EXPECT_EQ(imu_passed, before + 1);
  const SensorLine::Figures after = figures();
  EXPECT_GE(after.cut_turns, 1);
  EXPECT_GT(after.gate.refused[static_cast<std::size_t>(GateCause::shape)], 1000);
}

TEST_F(ASensorLine, ASensorThatComesFromOtherPortsIsHeardAgain) {
  run(milliseconds(300));
  std::this_thread::sleep_for(milliseconds(1050));
  const Sender lidar_again(kHere), imu_again(kHere);
  const long before = imu_passed;
  for (int i = 0; i < 100; ++i) {
    send(lidar_again, imu_again);
    turn();
    std::this_thread::sleep_for(milliseconds(5));
  }
  EXPECT_GT(imu_passed, before + 20);
}

TEST_F(ASensorLine, HealthAndLogNameWhatWasRefused) {
  SensorLine::Figures made;
  made.gate.refused[static_cast<std::size_t>(GateCause::ahead)] = 3;
  made.gate.refused[static_cast<std::size_t>(GateCause::frame)] = 40;
  made.gate.last_from[static_cast<std::size_t>(GateCause::frame)] = {kElsewhere, 99};
  made.kernel_drops = 7;
  const auto health = health_of(made, 3);
  ASSERT_EQ(health.size(), 3U);
  EXPECT_EQ(health[0], (std::pair<std::string, long>("sensor_refused", 50)));
  EXPECT_EQ(health[1], (std::pair<std::string, long>("sensor_frame", 40)));
  EXPECT_EQ(health[2].first, "sensor_kernel_drops");
  SensorNews news;
  const auto lines = news.lines(made, begin);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1],
            "sensor: refused 40 packets of a frame that is not due, the last from "
            "127.0.0.2:99");
  made.gate.refused[static_cast<std::size_t>(GateCause::frame)] = 50;
  EXPECT_TRUE(news.lines(made, begin + milliseconds(4900)).empty());
  EXPECT_EQ(news.lines(made, begin + milliseconds(5100)).size(), 1U);
}

TEST(SensorLine, NamesAreShortEnoughForHealth) {
  SensorLine::Figures made;
  made.gate.refused.fill(1);
  made.kernel_drops = 1;
  for (const auto& [name, value] : health_of(made, 99))
    EXPECT_LE(name.size(), static_cast<std::size_t>(counter_t::MAX_NAME)) << name;
}

TEST(SensorLine, RefusesAnAddressThatIsNone) {
  const lidar::SensorInfo info = described();
  try {
    const SensorLine line({"lidar.local"}, info, 200);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("sensor.address: lidar.local"), std::string::npos);
  }
  EXPECT_THROW(SensorLine({"0.0.0.0"}, info, 200), Error);
}

TEST(SensorLine, TheConfiguredAddressIsHeardOnItsInterfaceAlone) {
  const lidar::SensorInfo info = described();
  SensorLine line({"127.0.0.1"}, info, 200);
  const Sender stranger(kElsewhere), sensor(kHere);
  const auto turn = [&] { line.turn([](const SensorLine::Packet&) {}); };
  turn();  // from here the kernel drops others
  for (int i = 0; i < 10; ++i) stranger.send(Bytes(100, 1), info.lidar_port);
  for (int i = 0; i < 10; ++i) sensor.send(Bytes(100, 1), info.lidar_port);
  std::this_thread::sleep_for(milliseconds(1050));
  turn();
  EXPECT_EQ(line.figures()->kernel_drops, 10);
  EXPECT_EQ(line.figures()->gate.refused[static_cast<std::size_t>(GateCause::shape)], 10);
  EXPECT_EQ(line.figures()->gate.refused[static_cast<std::size_t>(GateCause::address)], 0);
}

}  // namespace
}  // namespace saker::flight
