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

/// Where a head keeps its fields.
struct HeadLayout {
  std::size_t frame_id_at, initialization_id_at, serial_number_at;
};
constexpr HeadLayout kStandardHead = {2, 4, 7};
constexpr HeadLayout kFusaHead = {4, 1, 11};
constexpr std::size_t kInitializationIdBytes = 3, kSerialNumberBytes = 5;

const HeadLayout& head_layout(PacketHeader header) {
  return header == PacketHeader::kFusa ? kFusaHead : kStandardHead;
}

constexpr std::size_t kMeasurementIdAt = 8;
constexpr std::size_t kStatusAt = 10;
constexpr std::size_t kLegacyFrameIdAt = 10;
constexpr std::size_t kLegacyEncoderAt = 12;
constexpr std::uint32_t kLegacyEncoderTicks = 90112;  // a revolution
constexpr std::uint32_t kLegacyValid = 0xFFFFFFFF;
constexpr std::uint8_t kLidarPacketType = 1;
constexpr std::uint32_t kLargestFrameId = 0x7FFFFFFF;

/// Where a pixel keeps its fields; 0 where it does not have them.
struct PixelLayout {
  std::size_t bytes;
  std::uint32_t range_mask;
  int range_shift;
  std::size_t reflectivity_at;
  std::size_t signal_at;
  std::size_t near_infrared_at;  ///< 16 bits, of the short profiles 8
};

PixelLayout pixel_layout(PacketProfile profile) {
  switch (profile) {
    case PacketProfile::kLegacy:
      return {12, kLegacyRangeMask, 0, 4, 6, 8};
    case PacketProfile::kRng19Rfl8Sig16Nir16:
    case PacketProfile::kRng19Rfl8Sig16Nir16Zone16:
      return {12, kRange19Mask, 0, 4, 6, 8};
    case PacketProfile::kRng19Rfl8Sig16Nir16Dual:
      return {16, kRange19Mask, 0, 3, 8, 12};
    case PacketProfile::kRng19Rfl8Sig16Zone16Dual:
      return {16, kRange19Mask, 0, 3, 8, 0};
    case PacketProfile::kRng19Rfl8Sig16Nir16Rgb16:
      return {16, kRange19Mask, 0, 3, 4, 6};
    case PacketProfile::kRng19Rfl8Sig16Nir16Rgb16Dual:
    case PacketProfile::kFiveWordPixel:
      return {20, kRange19Mask, 0, 3, 8, 12};
    case PacketProfile::kRng15Rfl8Nir8:
      return {4, kRange15Mask, kRange15Shift, 2, 0, 3};
    case PacketProfile::kRng15Rfl8Win8:
      return {4, kRange15Mask, kRange15Shift, 2, 0, 0};
    case PacketProfile::kRng15Rfl8Nir8Dual:
    case PacketProfile::kFusaRng15Rfl8Nir8Dual:
    case PacketProfile::kRng15Rfl8Nir8Zone16:
      return {8, kRange15Mask, kRange15Shift, 2, 0, 3};
  }
  return {};
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
      header_(info.header),
      rows_(info.rows),
      columns_(info.columns),
      columns_per_packet_(info.columns_per_packet),
      initialization_id_(info.initialization_id),
      serial_number_(std::strtoull(info.serial_number.c_str(), nullptr, 10)),
      pixel_bytes_(pixel_layout(info.profile).bytes) {
  const bool legacy = profile_ == PacketProfile::kLegacy;
  column_head_bytes_ = legacy ? 16 : 12;
  column_bytes_ = column_head_bytes_ + pixel_bytes_ * rows_ + (legacy ? 4 : 0);
  packet_head_bytes_ = legacy ? 0 : kPacketHeadBytes;
  packet_bytes_ =
      2 * packet_head_bytes_ + column_bytes_ * columns_per_packet_;  // the foot is as long
}

std::span<const std::uint8_t> PacketFormat::column_bytes(std::span<const std::uint8_t> packet,
                                                         int i) const {
  return packet.subspan(packet_head_bytes_ + column_bytes_ * i, column_bytes_);
}

int PacketFormat::frame_id(std::span<const std::uint8_t> packet, int i) const {
  if (profile_ != PacketProfile::kLegacy) {
    const std::uint8_t* at = &packet[head_layout(header_).frame_id_at];
    return header_ == PacketHeader::kFusa
               ? static_cast<int>(read_little<std::uint32_t>(at) & kLargestFrameId)
               : read_little<std::uint16_t>(at);
  }
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
    case PacketProfile::kRng19Rfl8Sig16Nir16Zone16:
      return read_pixels<kRange19Mask, 0, 12, 4>(pixels, rows_, ranges, reflectivity, stride);
    case PacketProfile::kRng19Rfl8Sig16Nir16Dual:
    case PacketProfile::kRng19Rfl8Sig16Zone16Dual:
    case PacketProfile::kRng19Rfl8Sig16Nir16Rgb16:
      return read_pixels<kRange19Mask, 0, 16, 3>(pixels, rows_, ranges, reflectivity, stride);
    case PacketProfile::kRng19Rfl8Sig16Nir16Rgb16Dual:
    case PacketProfile::kFiveWordPixel:
      return read_pixels<kRange19Mask, 0, 20, 3>(pixels, rows_, ranges, reflectivity, stride);
    case PacketProfile::kRng15Rfl8Nir8:
    case PacketProfile::kRng15Rfl8Win8:
      return read_pixels<kRange15Mask, kRange15Shift, 4, 2>(pixels, rows_, ranges, reflectivity,
                                                            stride);
    case PacketProfile::kRng15Rfl8Nir8Dual:
    case PacketProfile::kFusaRng15Rfl8Nir8Dual:
    case PacketProfile::kRng15Rfl8Nir8Zone16:
      return read_pixels<kRange15Mask, kRange15Shift, 8, 2>(pixels, rows_, ranges, reflectivity,
                                                            stride);
  }
}

Pixel PacketFormat::pixel(const std::uint8_t* bytes) const {
  const PixelLayout layout = pixel_layout(profile_);
  Pixel pixel;
  pixel.range_mm = (read_little<std::uint32_t>(bytes) & layout.range_mask) << layout.range_shift;
  pixel.reflectivity = bytes[layout.reflectivity_at];
  if (layout.signal_at > 0) pixel.signal = read_little<std::uint16_t>(bytes + layout.signal_at);
  if (layout.near_infrared_at > 0) {
    const std::uint8_t* at = bytes + layout.near_infrared_at;
    pixel.near_infrared = layout.range_shift > 0
                              ? static_cast<std::uint16_t>(*at << kNearInfrared8Shift)
                              : read_little<std::uint16_t>(at);
  }
  return pixel;
}

PacketSender read_sender(std::span<const std::uint8_t> packet, PacketHeader header) {
  PacketSender sender;
  if (packet.size() < kPacketHeadBytes) return sender;
  const HeadLayout& layout = head_layout(header);
  std::memcpy(&sender.initialization_id, &packet[layout.initialization_id_at],
              kInitializationIdBytes);
  std::memcpy(&sender.serial_number, &packet[layout.serial_number_at], kSerialNumberBytes);
  return sender;
}

std::optional<PacketSender> PacketFormat::sender(std::span<const std::uint8_t> packet) const {
  if (profile_ == PacketProfile::kLegacy) return std::nullopt;
  return read_sender(packet, header_);
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
  const PixelLayout layout = pixel_layout(profile_);
  const std::uint32_t steps = range_mm >> layout.range_shift;
  return steps <= layout.range_mask ? steps << layout.range_shift : 0;
}

void PacketFormat::write_pixel(const Pixel& pixel, std::uint8_t* bytes) const {
  const PixelLayout layout = pixel_layout(profile_);
  const std::uint32_t steps = representable_mm(pixel.range_mm) >> layout.range_shift;
  if (layout.range_shift > 0) {
    write_little(static_cast<std::uint16_t>(steps), bytes);
  } else {
    write_little(steps, bytes);
  }
  bytes[layout.reflectivity_at] = pixel.reflectivity;
  if (layout.signal_at > 0) write_little(pixel.signal, bytes + layout.signal_at);
  if (layout.near_infrared_at == 0) return;
  if (layout.range_shift > 0) {
    bytes[layout.near_infrared_at] =
        static_cast<std::uint8_t>(std::min(255, pixel.near_infrared >> kNearInfrared8Shift));
  } else {
    write_little(pixel.near_infrared, bytes + layout.near_infrared_at);
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
    const HeadLayout& layout = head_layout(header_);
    packet[0] = kLidarPacketType;
    if (header_ == PacketHeader::kFusa) {
      write_little(static_cast<std::uint32_t>(columns[0].frame_id), &packet[layout.frame_id_at]);
    } else {
      write_little(static_cast<std::uint16_t>(columns[0].frame_id), &packet[layout.frame_id_at]);
    }
    std::memcpy(&packet[layout.initialization_id_at], &initialization_id_, kInitializationIdBytes);
    std::memcpy(&packet[layout.serial_number_at], &serial_number_, kSerialNumberBytes);
  }
  const std::size_t count = std::min(columns.size(), static_cast<std::size_t>(columns_per_packet_));
  for (std::size_t i = 0; i < count; ++i) {
    write_column(columns[i], &packet[packet_head_bytes_ + column_bytes_ * i]);
  }
  return packet;
}

}  // namespace saker::lidar
