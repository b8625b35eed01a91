#include "saker/lidar/sensor_reading.h"

#include <algorithm>
#include <cmath>

#include "saker/lidar/bytes.h"
#include "saker/lidar/imu_packet.h"

namespace saker::lidar {
namespace {

constexpr double kMostUneven = 0.02;  // of a revolution: columns of a packet follow each other

// imu_packet.h: stamps of the profile LEGACY, and of each measurement of the other one.
constexpr std::size_t kImuStamps[] = {0, 8, 16};
constexpr std::size_t kMeasurementsAt = kPacketHeadBytes + 100, kMeasurementBytes = 36;

bool is_time(Time stamp) { return stamp >= 0 && stamp < kStampEnd; }

ReadingFault read_columns(std::span<const std::uint8_t> payload, const PacketFormat& format,
                          const SensorInfo& info, SensorReading& reading) {
  const double most_uneven_s = kMostUneven / info.frame_rate_hz;
  int first_place = 0;
  for (int i = 0; i < format.columns_per_packet(); ++i) {
    if (!format.valid(payload, i)) continue;
    const ColumnTime column{format.frame_id(payload, i), format.measurement_id(payload, i),
                            format.time(payload, i)};
    if (!is_time(column.stamp)) return ReadingFault::stamp;
    if (column.column >= info.columns) return ReadingFault::columns;
    if (!reading.any) {
      reading.any = true;
      reading.first = reading.last = column;
      reading.oldest = reading.newest = column.stamp;
      first_place = i;
      continue;
    }
    const int on = i - first_place;
    const double passed = to_seconds(column.stamp - reading.first.stamp);
    if (column.frame_id != reading.first.frame_id || column.column != reading.first.column + on ||
        std::abs(passed - on * info.column_period_s()) > most_uneven_s) {
      return ReadingFault::columns;
    }
    reading.last = column;
    reading.oldest = std::min(reading.oldest, column.stamp);
    reading.newest = std::max(reading.newest, column.stamp);
  }
  return ReadingFault::none;
}

ReadingFault read_samples(std::span<const std::uint8_t> payload, const SensorInfo& info,
                          PacketHeader header, SensorReading& reading) {
  const std::vector<ImuSample> samples = decode_imu(payload, info);
  if (samples.empty()) return ReadingFault::shape;
  for (const ImuSample& sample : samples) {
    if (!is_time(sample.stamp)) return ReadingFault::stamp;
    if (reading.any && sample.stamp <= reading.newest) return ReadingFault::stamp;
    if (!reading.any) reading.oldest = sample.stamp;
    reading.newest = sample.stamp;
    reading.any = true;
  }
  reading.samples = static_cast<int>(samples.size());
  if (payload.size() != kImuPacketBytes) reading.sender = read_sender(payload, header);
  return ReadingFault::none;
}

void add_at(std::uint8_t* at, Time correction) {
  write_little(read_little<std::uint64_t>(at) + static_cast<std::uint64_t>(correction), at);
}

}  // namespace

ReadPacket read_sensor_packet(std::span<const std::uint8_t> payload, const PacketFormat& format,
                              const SensorInfo& info) {
  ReadPacket read;
  if (payload.size() == format.packet_bytes()) {
    read.reading.stream = SensorStream::lidar;
    read.reading.sender = format.sender(payload);
    read.fault = read_columns(payload, format, info, read.reading);
  } else if (is_imu_packet(payload)) {
    read.reading.stream = SensorStream::imu;
    read.fault = read_samples(payload, info, info.header, read.reading);
  } else {
    read.fault = ReadingFault::shape;
  }
  return read;
}

void add_to_stamps(std::span<std::uint8_t> payload, Time correction, const PacketFormat& format,
                   const SensorInfo& info) {
  if (correction == 0) return;
  if (payload.size() == format.packet_bytes()) {
    const std::size_t head = info.profile == PacketProfile::kLegacy ? 0 : kPacketHeadBytes;
    const auto columns = static_cast<std::size_t>(info.columns_per_packet);
    const std::size_t column_bytes = (payload.size() - 2 * head) / columns;
    for (std::size_t i = 0; i < columns; ++i) add_at(&payload[head + i * column_bytes], correction);
  } else if (payload.size() == kImuPacketBytes) {
    for (const std::size_t at : kImuStamps) add_at(&payload[at], correction);
  } else if (is_imu_packet(payload)) {
    const std::size_t end = payload.size() - kPacketHeadBytes;
    for (std::size_t at = kMeasurementsAt; at < end; at += kMeasurementBytes) {
      add_at(&payload[at], correction);
    }
  }
}

}  // namespace saker::lidar
