#include "saker/lidar/ouster_senders.h"

#include <algorithm>
#include <cstdlib>

#include "saker/core/error.h"
#include "saker/lidar/capture_reader.h"

namespace saker::lidar {
namespace {

constexpr int kMostDatagrams = 20'000;  // 15 s of one sensor

std::string list_of(const std::vector<OusterSender>& senders) {
  std::string list;
  for (const OusterSender& sender : senders) {
    list += (list.empty() ? "" : ", ") + sender.name();
    if (sender.serial_number != 0) list += " (" + sender.address + ")";
  }
  return list;
}

void look_at(const PacketFormat& format, std::span<const std::uint8_t> packet,
             OusterSender& sender) {
  ++sender.packets;
  for (int i = 0; i < format.columns_per_packet(); ++i) {
    if (!format.valid(packet, i)) continue;
    sender.last_column = std::max(sender.last_column, format.measurement_id(packet, i));
    const int frame = format.frame_id(packet, i);
    if (sender.frames == 0 || frame != sender.last_frame) ++sender.frames;
    sender.last_frame = frame;
  }
}

void count(std::vector<OusterSender>& senders, const Datagram& datagram,
           const PacketFormat& format) {
  const std::optional<PacketSender> head = format.sender(datagram.payload);
  const std::string address = to_string(datagram.source);
  const std::uint64_t serial = head ? head->serial_number : 0;
  const auto same = [&](const OusterSender& s) {
    return serial != 0 ? s.serial_number == serial : s.serial_number == 0 && s.address == address;
  };
  auto known = std::find_if(senders.begin(), senders.end(), same);
  if (known == senders.end()) known = senders.insert(known, OusterSender{address, serial});
  look_at(format, datagram.payload, *known);
}

}  // namespace

std::string OusterSender::name() const {
  return serial_number != 0 ? std::to_string(serial_number) : address;
}

std::vector<OusterSender> find_ouster_senders(const std::filesystem::path& capture,
                                              const PacketFormat& format) {
  CaptureReader reader(capture);
  std::vector<OusterSender> senders;
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto datagram = reader.next();
    if (!datagram) break;
    if (datagram->payload.size() != format.packet_bytes()) continue;
    count(senders, *datagram, format);
  }
  return senders;
}

void check_mode(const OusterSender& sender, const SensorInfo& info, const std::string& where) {
  constexpr int kFramesToTell = 3;  // the first and the last may be cut
  const bool too_many = sender.last_column >= info.columns;
  const bool too_few = sender.frames >= kFramesToTell &&
                       info.column_window.size(info.columns) == info.columns &&
                       2 * (sender.last_column + 1) <= info.columns;
  if (!too_many && !too_few) return;
  throw Error(where + ": columns up to " + std::to_string(sender.last_column) +
              ", expected up to " + std::to_string(info.columns - 1) +
              ", as the metadata says: it is of another mode");
}

std::optional<OusterSender> choose_sender(const std::vector<OusterSender>& senders,
                                          const std::string& wanted, const SensorInfo& info,
                                          const std::string& where) {
  if (senders.empty()) return std::nullopt;
  auto chosen = senders.begin();
  if (!wanted.empty()) {
    chosen = std::find_if(senders.begin(), senders.end(), [&](const OusterSender& s) {
      return s.name() == wanted || s.address == wanted;
    });
    if (chosen == senders.end()) {
      throw Error(where + ": --sensor " + wanted + ": not in it, expected one of " +
                  list_of(senders));
    }
  } else if (senders.size() > 1) {
    throw Error(where + ": packets of " + std::to_string(senders.size()) + " sensors, " +
                list_of(senders) + ": choose one with --sensor");
  }
  const std::uint64_t described = std::strtoull(info.serial_number.c_str(), nullptr, 10);
  if (described != 0 && chosen->serial_number != 0 && described != chosen->serial_number) {
    throw Error(where + ": packets of the sensor " + chosen->name() +
                ", expected those of the metadata's, " + info.serial_number);
  }
  check_mode(*chosen, info, where);
  if (senders.size() == 1) return std::nullopt;
  return *chosen;
}

}  // namespace saker::lidar
