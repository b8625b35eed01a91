#include "saker/lidar/udp_receiver.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/ouster_sensor.h"
#include "saker/lidar/ouster_stream.h"

namespace saker::lidar {
namespace {

using std::chrono::milliseconds;

class Sender {
 public:
  explicit Sender(int port) : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    address_.sin_family = AF_INET;
    address_.sin_port = htons(static_cast<std::uint16_t>(port));
    address_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  ~Sender() { ::close(socket_); }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

  void send(const testing::Bytes& packet) const {
    ASSERT_EQ(::sendto(socket_, packet.data(), packet.size(), 0,
                       reinterpret_cast<const sockaddr*>(&address_), sizeof address_),
              static_cast<ssize_t>(packet.size()));
  }

 private:
  int socket_;
  sockaddr_in address_{};
};

TEST(UdpReceiver, EveryProfileArrivesThroughARealSocket) {
  for (const PacketProfile profile : packet_profiles()) {
    SensorInfo info = SensorInfo::make_os1(128, 512, profile);
    info.column_window = {400, 130};
    UdpReceiver receiver(0);
    const Sender sender(receiver.port());
    OusterStream stream(info, true);
    for (int frame = 0; frame < 2; ++frame) {
      for (const auto& packet : testing::made_packets(info, frame, frame)) {
        sender.send(packet);
        stream.add(receiver.receive(milliseconds(1000)));
      }
    }
    for (int frame = 0; frame < 2; ++frame) {
      const auto item = stream.take();
      ASSERT_TRUE(item);
      EXPECT_EQ(item->assembled.ranges_mm, testing::made_ranges(info, frame));
    }
  }
}

TEST(UdpReceiver, HoldsAPacketBurstWhileTheReaderIsBusy) {
  UdpReceiver receiver(0);
  const Sender sender(receiver.port());
  for (int i = 0; i < 8; ++i) sender.send(testing::Bytes(8448, static_cast<std::uint8_t>(i)));
  for (int i = 0; i < 8; ++i) {
    const auto packet = receiver.receive(milliseconds(1000));
    ASSERT_EQ(packet.size(), 8448U);
    EXPECT_EQ(packet[0], i);
  }
}

TEST(UdpReceiver, SaysHowMuchTheKernelHolds) {
  EXPECT_EQ(UdpReceiver(0, 65536).buffer_bytes(), 65536);
}

TEST(OusterSensor, GivesFramesWithInertialSamplesFromTwoPortsUntilTheyFallSilent) {
  const SensorInfo info = SensorInfo::make_os1(16, 512, PacketProfile::kRng15Rfl8Nir8);
  OusterSensor sensor(info, {.lidar_port = 0, .imu_port = 0, .silence = milliseconds(200)});
  const Sender lidar(sensor.lidar_port());
  const Sender imu(sensor.imu_port());
  ImuSample sample;
  sample.stamp = testing::made_time(info, 0, 10);
  sample.acceleration = {0, 0, 9.8};
  sample.angular_velocity = {0, 0, 0};
  imu.send(encode_imu(sample, info));
  std::thread sending([&] {
    for (int frame = 0; frame < 3; ++frame) {
      for (const auto& packet : testing::made_packets(info, frame, frame)) lidar.send(packet);
      std::this_thread::sleep_for(milliseconds(20));
    }
  });
  std::size_t frames = 0;
  std::size_t samples = 0;
  while (const auto frame = sensor.next()) {
    ++frames;
    samples += frame->imu.size();
  }
  sending.join();
  EXPECT_EQ(frames, 3U);
  EXPECT_EQ(samples, 1U);
  EXPECT_EQ(sensor.counters().summary(), "");
}

TEST(UdpReceiver, GivesNothingWhenNothingComes) {
  UdpReceiver receiver(0);
  EXPECT_TRUE(receiver.receive(milliseconds(0)).empty());
  EXPECT_TRUE(receiver.receive(milliseconds(5)).empty());
}

TEST(UdpReceiver, APortThatIsTakenIsRefusedByNumber) {
  const UdpReceiver receiver(0);
  try {
    const UdpReceiver second(receiver.port());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(receiver.port())), std::string::npos);
  }
  EXPECT_THROW(UdpReceiver(70000), Error);
}

}  // namespace
}  // namespace saker::lidar
