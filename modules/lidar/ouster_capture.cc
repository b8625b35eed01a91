#include "saker/lidar/ouster_capture.h"

#include "saker/core/error.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/metadata.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kMostSizesKept = 4;

}  // namespace

OusterCapture::OusterCapture(const std::vector<std::filesystem::path>& files,
                             const std::filesystem::path& metadata, bool keep_ranges,
                             const std::string& chosen)
    : reader_(files), stream_(read_metadata(metadata), keep_ranges) {
  const std::filesystem::path& capture = files.front();
  only_ = choose_sender(find_ouster_senders(capture, PacketFormat(stream_.info())), chosen,
                        stream_.info(), capture.string());
  read_until_item();
  if (ahead_) return;
  const SensorInfo& sensor = stream_.info();
  throw Error(capture.string() + ": no lidar packet of " +
              std::to_string(PacketFormat(sensor).packet_bytes()) + " bytes (" +
              to_string(sensor.profile) + ", " + std::to_string(sensor.rows) + " rows, by " +
              metadata.string() + "), found " + sizes_seen() +
              (reader_.ended_early().empty() ? "" : "; " + reader_.ended_early()));
}

std::optional<Frame> OusterCapture::next() {
  auto item = next_item();
  if (!item) return std::nullopt;
  given_ = std::move(item->assembled);
  return std::move(item->frame);
}

std::optional<OusterStream::Item> OusterCapture::next_item() {
  auto item = std::move(ahead_);
  ahead_.reset();
  if (item) read_until_item();
  return item;
}

void OusterCapture::read_until_item() {
  while (!(ahead_ = stream_.take())) {
    const auto datagram = reader_.next();
    if (datagram) {
      add(*datagram);
      continue;
    }
    stream_.finish();
    ahead_ = stream_.take();
    return;
  }
}

void OusterCapture::add(const Datagram& datagram) {
  const std::size_t size = datagram.payload.size();
  if (size == stream_.packet_bytes() || is_imu_packet(datagram.payload)) {
    if (from_another(datagram)) {
      ++other_sensors_;
      return;
    }
    return stream_.add(datagram.payload);
  }
  if (other_sizes_.size() < kMostSizesKept || other_sizes_.contains(size)) ++other_sizes_[size];
  const SensorInfo& sensor = stream_.info();
  bad_packets_ += datagram.port == sensor.lidar_port || datagram.port == sensor.imu_port;
}

bool OusterCapture::from_another(const Datagram& datagram) const {
  if (!only_) return false;
  const SensorInfo& sensor = stream_.info();
  if (only_->serial_number == 0 || sensor.profile == PacketProfile::kLegacy ||
      datagram.payload.size() == kImuPacketBytes) {
    return to_string(datagram.source) != only_->address;
  }
  return read_sender(datagram.payload, sensor.header).serial_number != only_->serial_number;
}

std::string OusterCapture::note() const {
  return stream_.imu_by_arrival() ? "the inertial unit's clock is not the lidar's: its samples are "
                                    "taken at their arrival"
                                  : "";
}

std::string OusterCapture::sizes_seen() const {
  std::string sizes;
  for (const auto& [size, count] : other_sizes_) {
    sizes += (sizes.empty() ? "" : ", ") + std::to_string(count) + " of " + std::to_string(size);
  }
  return sizes.empty() ? "no other datagrams" : sizes + " bytes";
}

SourceCounters OusterCapture::counters() const {
  SourceCounters counters = stream_.counters();
  counters.bad_packets += bad_packets_ + reader_.cut_packets();
  counters.other_sensors = other_sensors_;
  counters.lost_fragments = reader_.lost_datagrams();
  counters.ended_early = reader_.ended_early();
  return counters;
}

}  // namespace saker::lidar
