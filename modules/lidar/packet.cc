#include "saker/lidar/packet.h"

#include <algorithm>
#include <cstdlib>

#include "saker/lidar/bytes.h"

namespace saker::lidar {
namespace {

constexpr std::uint32_t kLegacyRangeMask = 0xFFFFF;
constexpr std::uint32_t kRange19Mask = 0x7FFFF;
constexpr std::uint32_t kRange15Mask = 0x7FFF;
constexpr int kRange15Shift = 3;  // in steps of 8 mm
constexpr int kNearInfrared8Shift = 4;

constexpr std::size_t kFrameIdAt = 2;
constexpr std::size_t kInitializationIdAt = 4;
constexpr std::size_t kSerialNumberAt = 7;
constexpr std::size_t kMeasurementIdAt = 8;
constexpr std::size_t kStatusAt = 10;
constexpr std::size_t kLegacyFrameIdAt = 10;
constexpr std::size_t kLegacyEncoderAt = 12;
constexpr std::uint32_t kLegacyEncoderTicks = 90112;  // a revolution
constexpr std::uint32_t kLegacyValid = 0xFFFFFFFF;
constexpr std::uint16_t kLidarPacketType = 1;

std::size_t pixel_bytes(PacketProfile profile) {
  switch (profile) {
    case PacketProfile::kRng19Rfl8Sig16Nir16Dual:
      return 16;
    case PacketProfile::kRng15Rfl8Nir8:
      return 4;
    default:
      return 12;
  }
}

/// Where a profile keeps the two fields of a scan: the loop over a column's pixels is then free of
/// cases.
template <std::uint32_t mask, int shift, std::size_t pixel_size, std::size_t reflectivity_at>
void read_pixels(const std::uint8_t* pixels, int rows, std::uint32_t* ranges,
                 std::uint8_t* reflectivity, std::size_t stride) {
  for (int row = 0; row < rows; ++row) {
    const std::uint8_t* pixel = pixels + pixel_size * row;
    ranges[stride * row] = (read_little<std::uint32_t>(pixel) & mask) << shift;
    reflectivity[stride * row] = pixel[reflectivity_at];
  }
}

}  // namespace

PacketFormat::PacketFormat(const SensorInfo& info)
    : profile_(info.profile),
      rows_(info.rows),
      columns_(info.columns),
      columns_per_packet_(info.columns_per_packet),
      initialization_id_(info.initialization_id),
      serial_number_(std::strtoull(info.serial_number.c_str(), nullptr, 10)),
      pixel_bytes_(pixel_bytes(info.profile)) {
  const bool legacy = profile_ == PacketProfile::kLegacy;
  column_head_bytes_ = legacy ? 16 : 12;
  column_bytes_ = column_head_bytes_ + pixel_bytes_ * rows_ + (legacy ? 4 : 0);
  packet_head_bytes_ = legacy ? 0 : 32;
  packet_bytes_ =
      2 * packet_head_bytes_ + column_bytes_ * columns_per_packet_;  // the foot is as long
}

std::span<const std::uint8_t> PacketFormat::column_bytes(std::span<const std::uint8_t> packet,
                                                         int i) const {
  return packet.subspan(packet_head_bytes_ + column_bytes_ * i, column_bytes_);
}

int PacketFormat::frame_id(std::span<const std::uint8_t> packet, int i) const {
  if (profile_ != PacketProfile::kLegacy) return read_little<std::uint16_t>(&packet[kFrameIdAt]);
  return read_little<std::uint16_t>(&column_bytes(packet, i)[kLegacyFrameIdAt]);
}

int PacketFormat::measurement_id(std::span<const std::uint8_t> packet, int i) const {
  return read_little<std::uint16_t>(&column_bytes(packet, i)[kMeasurementIdAt]);
}

Time PacketFormat::time(std::span<const std::uint8_t> packet, int i) const {
  return read_little<std::int64_t>(column_bytes(packet, i).data());
}

bool PacketFormat::valid(std::span<const std::uint8_t> packet, int i) const {
  const auto bytes = column_bytes(packet, i);
  if (profile_ != PacketProfile::kLegacy) return bytes[kStatusAt] & 1;
  return read_little<std::uint32_t>(&bytes[column_bytes_ - 4]) == kLegacyValid;
}

void PacketFormat::read_column(std::span<const std::uint8_t> packet, int i, std::uint32_t* ranges,
                               std::uint8_t* reflectivity, std::size_t stride) const {
  const std::uint8_t* pixels = column_bytes(packet, i).data() + column_head_bytes_;
  switch (profile_) {
    case PacketProfile::kLegacy:
      return read_pixels<kLegacyRangeMask, 0, 12, 4>(pixels, rows_, ranges, reflectivity, stride);
    case PacketProfile::kRng19Rfl8Sig16Nir16:
      return read_pixels<kRange19Mask, 0, 12, 4>(pixels, rows_, ranges, reflectivity, stride);
    case PacketProfile::kRng19Rfl8Sig16Nir16Dual:
      return read_pixels<kRange19Mask, 0, 16, 3>(pixels, rows_, ranges, reflectivity, stride);
    case PacketProfile::kRng15Rfl8Nir8:
      return read_pixels<kRange15Mask, kRange15Shift, 4, 2>(pixels, rows_, ranges, reflectivity,
                                                            stride);
  }
}

Pixel PacketFormat::pixel(const std::uint8_t* bytes) const {
  const auto word = read_little<std::uint32_t>(bytes);
  switch (profile_) {
    case PacketProfile::kLegacy:
      return {word & kLegacyRangeMask, read_little<std::uint16_t>(bytes + 6),
              read_little<std::uint16_t>(bytes + 8), bytes[4]};
    case PacketProfile::kRng19Rfl8Sig16Nir16:
      return {word & kRange19Mask, read_little<std::uint16_t>(bytes + 6),
              read_little<std::uint16_t>(bytes + 8), bytes[4]};
    case PacketProfile::kRng19Rfl8Sig16Nir16Dual:
      return {word & kRange19Mask, read_little<std::uint16_t>(bytes + 8),
              read_little<std::uint16_t>(bytes + 12), bytes[3]};
    case PacketProfile::kRng15Rfl8Nir8:
      return {(word & kRange15Mask) << kRange15Shift, 0,
              static_cast<std::uint16_t>(bytes[3] << kNearInfrared8Shift), bytes[2]};
  }
  return {};
}

Column PacketFormat::column(std::span<const std::uint8_t> packet, int i) const {
  Column column;
  column.time = time(packet, i);
  column.frame_id = frame_id(packet, i);
  column.measurement_id = measurement_id(packet, i);
  column.valid = valid(packet, i);
  const std::uint8_t* pixels = column_bytes(packet, i).data() + column_head_bytes_;
  column.pixels.reserve(static_cast<std::size_t>(rows_));
  for (int row = 0; row < rows_; ++row) column.pixels.push_back(pixel(pixels + pixel_bytes_ * row));
  return column;
}

std::uint32_t PacketFormat::representable_mm(std::uint32_t range_mm) const {
  switch (profile_) {
    case PacketProfile::kLegacy:
      return range_mm <= kLegacyRangeMask ? range_mm : 0;
    case PacketProfile::kRng15Rfl8Nir8:
      return range_mm >> kRange15Shift <= kRange15Mask ? range_mm & ~7U : 0;
    default:
      return range_mm <= kRange19Mask ? range_mm : 0;
  }
}

void PacketFormat::write_pixel(const Pixel& pixel, std::uint8_t* bytes) const {
  const std::uint32_t range = representable_mm(pixel.range_mm);
  switch (profile_) {
    case PacketProfile::kLegacy:
    case PacketProfile::kRng19Rfl8Sig16Nir16:
      write_little(range, bytes);
      bytes[4] = pixel.reflectivity;
      write_little(pixel.signal, bytes + 6);
      write_little(pixel.near_infrared, bytes + 8);
      break;
    case PacketProfile::kRng19Rfl8Sig16Nir16Dual:
      write_little(range, bytes);
      bytes[3] = pixel.reflectivity;
      write_little(pixel.signal, bytes + 8);
      write_little(pixel.near_infrared, bytes + 12);
      break;
    case PacketProfile::kRng15Rfl8Nir8:
      write_little(static_cast<std::uint16_t>(range >> kRange15Shift), bytes);
      bytes[2] = pixel.reflectivity;
      bytes[3] =
          static_cast<std::uint8_t>(std::min(255, pixel.near_infrared >> kNearInfrared8Shift));
      break;
  }
}

void PacketFormat::write_column(const Column& column, std::uint8_t* bytes) const {
  write_little(column.time, bytes);
  write_little(static_cast<std::uint16_t>(column.measurement_id), bytes + kMeasurementIdAt);
  if (profile_ == PacketProfile::kLegacy) {
    const auto step = kLegacyEncoderTicks / static_cast<std::uint32_t>(columns_);
    write_little(static_cast<std::uint16_t>(column.frame_id), bytes + kLegacyFrameIdAt);
    write_little(static_cast<std::uint32_t>(column.measurement_id) * step,
                 bytes + kLegacyEncoderAt);
    write_little(column.valid ? kLegacyValid : 0U, bytes + column_bytes_ - 4);
  } else {
    write_little(static_cast<std::uint16_t>(column.valid ? 1 : 0), bytes + kStatusAt);
  }
  const std::size_t rows = std::min(column.pixels.size(), static_cast<std::size_t>(rows_));
  for (std::size_t row = 0; row < rows; ++row) {
    write_pixel(column.pixels[row], bytes + column_head_bytes_ + pixel_bytes_ * row);
  }
}

std::vector<std::uint8_t> PacketFormat::encode(std::span<const Column> columns) const {
  std::vector<std::uint8_t> packet(packet_bytes_, 0);
  if (profile_ != PacketProfile::kLegacy && !columns.empty()) {
    write_little(kLidarPacketType, packet.data());
    write_little(static_cast<std::uint16_t>(columns[0].frame_id), &packet[kFrameIdAt]);
    std::memcpy(&packet[kInitializationIdAt], &initialization_id_, 3);
    std::memcpy(&packet[kSerialNumberAt], &serial_number_, 5);
  }
  const std::size_t count = std::min(columns.size(), static_cast<std::size_t>(columns_per_packet_));
  for (std::size_t i = 0; i < count; ++i) {
    write_column(columns[i], &packet[packet_head_bytes_ + column_bytes_ * i]);
  }
  return packet;
}

}  // namespace saker::lidar
