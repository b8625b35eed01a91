#include <arpa/inet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <netinet/ip.h>
#include <netinet/udp.h>
#include <netpacket/packet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iostream>
#include <optional>
#include <thread>
#include <vector>

#include "saker/core/error.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/metadata.h"
#include "saker/lidar/packet.h"
#include "saker/lidar/udp_source.h"

/// Somebody on the sensor's network, for tests by processes: reads what the sensor sends and sends
/// what it should not be believed.
///   sensor_attacker META MODE RATE_HZ SECONDS
/// By the sensor's address and ports: imu_far (a stamp of 146 years), imu_ahead (5 s), frame (the
/// next number). As others: second (a sensor of the same type), flood_lidar, flood_imu; `_copied`
/// behind a flood: by the sensor's address and port. Needs a raw socket: in a namespace.
namespace saker {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Steady = std::chrono::steady_clock;

constexpr std::uint32_t kHere = 0x7F000001, kStranger = 0x7F000009;
constexpr std::uint16_t kOwnMark = 0xBEEF;  // identification of the packets sent here

struct Heard {
  Bytes payload;
  lidar::UdpSource from;
};

class Network {
 public:
  explicit Network(const lidar::SensorInfo& info)
      : info_(info),
        ear_(::socket(AF_PACKET, SOCK_DGRAM | SOCK_NONBLOCK, htons(ETH_P_IP))),
        mouth_(::socket(AF_INET, SOCK_RAW, IPPROTO_RAW)),
        buffer_(65536) {
    if (ear_ < 0 || mouth_ < 0) throw Error("sensor_attacker: no raw socket");
  }
  ~Network() {
    ::close(ear_);
    ::close(mouth_);
  }
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// What came since: the newest of each stream is kept.
  void listen() {
    for (ssize_t size = 0; (size = ::recv(ear_, buffer_.data(), buffer_.size(), 0)) > 0;) {
      if (size < 28) continue;
      iphdr ip{};
      udphdr udp{};
      std::memcpy(&ip, buffer_.data(), sizeof ip);
      const std::size_t head = ip.ihl * 4U;
      std::memcpy(&udp, &buffer_[head], sizeof udp);
      if (ip.protocol != IPPROTO_UDP || ntohs(ip.id) == kOwnMark) continue;
      const int port = ntohs(udp.dest);
      if (port != info_.lidar_port && port != info_.imu_port) continue;
      Heard& heard = port == info_.lidar_port ? lidar : imu;
      heard.payload.assign(buffer_.begin() + static_cast<std::ptrdiff_t>(head + sizeof udp),
                           buffer_.begin() + size);
      heard.from = {ntohl(ip.saddr), ntohs(udp.source)};
    }
  }

  void send(const Bytes& payload, const lidar::UdpSource& as, int port) {
    iphdr ip{};
    udphdr udp{};
    ip.version = 4;
    ip.ihl = 5;
    ip.id = htons(kOwnMark);
    ip.ttl = 8;
    ip.protocol = IPPROTO_UDP;
    ip.saddr = htonl(as.address);
    ip.daddr = htonl(kHere);
    udp.source = htons(as.port);
    udp.dest = htons(static_cast<std::uint16_t>(port));
    udp.len = htons(static_cast<std::uint16_t>(sizeof udp + payload.size()));
    Bytes packet(sizeof ip + sizeof udp + payload.size());
    std::memcpy(packet.data(), &ip, sizeof ip);
    std::memcpy(packet.data() + sizeof ip, &udp, sizeof udp);
    std::copy(payload.begin(), payload.end(), packet.begin() + sizeof ip + sizeof udp);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(kHere);
    (void)::sendto(mouth_, packet.data(), packet.size(), MSG_DONTWAIT,
                   reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

  Heard lidar, imu;

 private:
  const lidar::SensorInfo& info_;
  int ear_, mouth_;
  Bytes buffer_;
};

class Attacker {
 public:
  Attacker(const lidar::SensorInfo& info, std::string mode)
      : info_(info), format_(info), network_(info), mode_(std::move(mode)) {}

  void run(double rate_hz, double seconds) {
    const auto begin = Steady::now();
    long sent = 0;
    for (double passed = 0; passed < seconds;
         passed = std::chrono::duration<double>(Steady::now() - begin).count()) {
      network_.listen();
      for (; static_cast<double>(sent) < passed * rate_hz; ++sent) attack();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::cerr << mode_ << ": " << sent << " packets" << std::endl;
  }

 private:
  void attack() {
    if (network_.lidar.payload.empty() || network_.imu.payload.empty()) return;
    const bool copied = mode_.ends_with("_copied");
    if (mode_.starts_with("flood_lidar")) {
      const Bytes rubbish(format_.packet_bytes(), 0x55);
      network_.send(rubbish, copied ? network_.lidar.from : stranger(), info_.lidar_port);
    } else if (mode_.starts_with("flood_imu")) {
      const Bytes rubbish(lidar::kImuPacketBytes, 0x55);
      network_.send(rubbish, copied ? network_.imu.from : stranger(), info_.imu_port);
    } else if (mode_ == "imu_far") {
      send_imu((Time{1} << 62) - 1, network_.imu.from);
    } else if (mode_ == "imu_ahead") {
      send_imu(stamp() + 5 * kNanosecondsPerSecond, network_.imu.from);
    } else if (mode_ == "frame") {
      send_lidar(1, 0, network_.lidar.from);
    } else if (mode_ == "second") {
      send_lidar(5000, -100 * kNanosecondsPerSecond, stranger());
      send_imu(stamp() - 100 * kNanosecondsPerSecond, stranger());
    }
  }

  [[nodiscard]] static lidar::UdpSource stranger() { return {kStranger, 7502}; }
  [[nodiscard]] Time stamp() const {
    const auto samples = lidar::decode_imu(network_.imu.payload, info_);
    return samples.empty() ? 0 : samples.back().stamp;
  }
  void send_imu(Time stamp, const lidar::UdpSource& as) {
    lidar::ImuSample sample;
    sample.stamp = stamp;
    sample.acceleration = {3, 0, 9};
    sample.angular_velocity = {0, 0, 1};
    network_.send(lidar::encode_imu(sample, info_), as, info_.imu_port);
  }
  void send_lidar(int frames, Time later, const lidar::UdpSource& as) {
    if (network_.lidar.payload.size() != format_.packet_bytes()) return;
    std::vector<lidar::Column> columns;
    for (int i = 0; i < format_.columns_per_packet(); ++i) {
      columns.push_back(format_.column(network_.lidar.payload, i));
      columns.back().frame_id = (columns.back().frame_id + frames) & 0xFFFF;
      columns.back().time += later;
    }
    network_.send(format_.encode(columns), as, info_.lidar_port);
  }

  lidar::SensorInfo info_;
  lidar::PacketFormat format_;
  Network network_;
  std::string mode_;
};

}  // namespace
}  // namespace saker

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    const saker::lidar::SensorInfo info = saker::lidar::read_metadata(words.at(0));
    saker::Attacker(info, words.at(1)).run(std::stod(words.at(2)), std::stod(words.at(3)));
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
  return 0;
}
