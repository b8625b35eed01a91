#include "saker/lidar/sensor_candidates.h"

#include <algorithm>

namespace saker::lidar {
namespace {

constexpr Time kSilence = kNanosecondsPerSecond / 2;  // then it is forgotten
constexpr double kMostAhead_s = 0.02, kMostLate_s = 0.1;

bool same_port(std::uint16_t known, std::uint16_t port) { return known == 0 || known == port; }

}  // namespace

std::string to_string(const SensorIdentity& identity) {
  std::string text = to_string(UdpSource{identity.address, identity.lidar_port}) +
                     ", inertial unit :" + std::to_string(identity.imu_port);
  if (identity.sender.serial_number == 0) return text;
  return text + ", serial number " + std::to_string(identity.sender.serial_number) + ", init id " +
         std::to_string(identity.sender.initialization_id);
}

bool SensorCandidates::belongs(const ArrivedReading& packet, const Candidate& candidate) const {
  const SensorReading& reading = packet.reading;
  const SensorIdentity& who = candidate.identity;
  const bool lidar = reading.stream == SensorStream::lidar;
  if (packet.from.address != who.address) return false;
  if (!same_port(lidar ? who.lidar_port : who.imu_port, packet.from.port)) return false;
  if (reading.sender && who.sender != PacketSender{} && *reading.sender != who.sender) return false;
  const double ahead = to_seconds(packet.offset() - candidate.offset);
  if (ahead > kMostAhead_s || ahead < -kMostLate_s) return false;
  if (!lidar) return candidate.imu == 0 || reading.oldest > candidate.newest_imu;
  return candidate.lidar == 0 || (count_.seconds(candidate.last_column, reading.last) > 0 &&
                                  count_.agrees(candidate.last_column, reading.last));
}

void SensorCandidates::add(const ArrivedReading& packet, Candidate& candidate) {
  const SensorReading& reading = packet.reading;
  SensorIdentity& who = candidate.identity;
  const bool first = candidate.lidar + candidate.imu == 0;
  candidate.offset = first ? packet.offset() : std::max(candidate.offset, packet.offset());
  candidate.heard = packet.arrival;
  who.address = packet.from.address;
  if (reading.sender) who.sender = *reading.sender;
  if (reading.stream == SensorStream::imu) {
    who.imu_port = packet.from.port;
    candidate.newest_imu = reading.newest;
    ++candidate.imu;
    return;
  }
  who.lidar_port = packet.from.port;
  if (candidate.lidar == 0) {
    candidate.first_column = reading.first;
    candidate.first_arrival = packet.arrival;
  }
  candidate.last_column = reading.last;
  ++candidate.lidar;
}

SensorCandidates::Candidate& SensorCandidates::place_for_another() {
  if (all_.size() < kMost) return all_.emplace_back();
  const auto heard = [](const Candidate& c) { return c.lidar + c.imu; };
  Candidate& least = *std::ranges::min_element(all_, {}, heard);
  least = {};
  return least;
}

void SensorCandidates::drop(const SensorIdentity& known) {
  std::erase_if(all_, [&](const Candidate& c) {
    const SensorIdentity& who = c.identity;
    return c.lidar > 0 && who.address == known.address && who.lidar_port == known.lidar_port &&
           who.sender == known.sender;
  });
}

const SensorCandidates::Candidate* SensorCandidates::offer(const ArrivedReading& packet,
                                                           bool begin) {
  std::erase_if(all_, [&](const Candidate& c) { return packet.arrival - c.heard > kSilence; });
  for (Candidate& candidate : all_) {
    if (!belongs(packet, candidate)) continue;
    add(packet, candidate);
    return &candidate;
  }
  if (!begin) return nullptr;
  Candidate& another = place_for_another();
  add(packet, another);
  return &another;
}

}  // namespace saker::lidar
