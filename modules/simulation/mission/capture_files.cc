#include "saker/simulation/mission/capture_files.h"

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"
#include "saker/lidar/metadata.h"

namespace saker::simulation {
namespace {

lidar::PacketProfile profile_of(const std::string& name) {
  std::string names;
  for (const lidar::PacketProfile profile : lidar::packet_profiles()) {
    if (name == lidar::to_string(profile)) return profile;
    names += (names.empty() ? "" : ", ") + std::string(lidar::to_string(profile));
  }
  throw Error("flight.capture.profile: " + name + ", expected one of " + names);
}

}  // namespace

lidar::SensorInfo sensor_info(const CaptureConfig& config) {
  lidar::SensorInfo info =
      lidar::SensorInfo::make_os1(config.rows, config.columns, profile_of(config.profile));
  info.serial_number = "122000000001";
  info.initialization_id = 1;
  if (config.window_first >= 0 && config.window_last >= 0) {
    info.column_window = {config.window_first, config.window_last};
  }
  lidar::check(info, "flight.capture");
  return info;
}

SensorCapture::SensorCapture(const std::filesystem::path& folder, const std::string& name,
                             const CaptureConfig& config, std::uint64_t seed)
    : info_(sensor_info(config)),
      format_(info_),
      config_(config),
      rng_(seed),
      writer_(folder / (name + ".pcap"), config.mtu) {
  lidar::write_metadata(info_, folder / (name + ".json"));
}

lidar::Column column_of(const CastScan& scan, const lidar::SensorInfo& info,
                        const lidar::PacketFormat& format, int frame_id, int column, Time start) {
  lidar::Column out;
  out.time = start + from_seconds(column * info.column_period_s());
  out.frame_id = frame_id & 0xFFFF;
  out.measurement_id = column;
  out.valid = info.column_window.contains(column);
  for (int row = 0; row < scan.rows; ++row) {
    const std::size_t i = static_cast<std::size_t>(row) * scan.columns + column;
    lidar::Pixel pixel;
    pixel.range_mm =
        format.representable_mm(static_cast<std::uint32_t>(std::lround(1000 * scan.range_m[i])));
    if (pixel.range_mm > 0) {
      pixel.reflectivity = static_cast<std::uint8_t>(std::lround(255 * scan.reflectivity[i]));
      pixel.signal = static_cast<std::uint16_t>(20 + std::lround(900 * scan.reflectivity[i]));
      pixel.near_infrared =
          static_cast<std::uint16_t>(60 + std::lround(400 * scan.reflectivity[i]));
    }
    out.pixels.push_back(pixel);
  }
  return out;
}

void SensorCapture::add_packets(const CastScan& scan, int frame_id, Time start, Ranges& sent) {
  const int step = info_.columns_per_packet;
  for (int first = 0; first < info_.columns; first += step) {
    std::vector<lidar::Column> columns;
    bool any = false;
    for (int column = first; column < first + step; ++column) {
      columns.push_back(column_of(scan, info_, format_, frame_id, column, start));
      any = any || columns.back().valid;
    }
    if (!any || rng_.chance(config_.lost_share)) continue;
    for (const lidar::Column& column : columns) {
      if (!column.valid) continue;
      for (int row = 0; row < info_.rows; ++row) {
        sent[static_cast<std::size_t>(row) * info_.columns + column.measurement_id] =
            column.pixels[row].range_mm;
      }
    }
    const Datagram datagram{columns.back().time, info_.lidar_port, format_.encode(columns)};
    queue_.push_back(datagram);
    if (rng_.chance(config_.repeated_share)) queue_.push_back(datagram);
  }
}

/// Lets some packets be overtaken by up to five others of the same revolution.
void SensorCapture::delay_some(std::vector<Datagram>& datagrams) {
  for (std::size_t i = 0; i + 1 < datagrams.size(); ++i) {
    if (!rng_.chance(config_.late_share)) continue;
    const std::size_t to = std::min(datagrams.size() - 1, i + 1 + rng_.index(5));
    std::rotate(datagrams.begin() + static_cast<std::ptrdiff_t>(i),
                datagrams.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                datagrams.begin() + static_cast<std::ptrdiff_t>(to) + 1);
  }
}

SensorCapture::Ranges SensorCapture::write(const CastScan& scan, int frame_id, Time start,
                                           std::span<const lidar::ImuSample> imu) {
  queue_.clear();
  Ranges sent(scan.range_m.size(), 0);
  add_packets(scan, frame_id, start, sent);
  for (const lidar::ImuSample& sample : imu) {
    queue_.push_back({sample.stamp, info_.imu_port, lidar::encode_imu(sample, info_)});
  }
  std::stable_sort(queue_.begin(), queue_.end(),
                   [](const Datagram& a, const Datagram& b) { return a.time < b.time; });
  std::vector<Time> times;
  for (const Datagram& datagram : queue_) times.push_back(datagram.time);
  delay_some(queue_);
  for (std::size_t i = 0; i < queue_.size(); ++i)
    writer_.write(times[i], queue_[i].port, queue_[i].bytes);
  return sent;
}

void SensorCapture::finish() { writer_.finish(); }

}  // namespace saker::simulation
