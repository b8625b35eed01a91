#include "saker/lidar/spinning/spinning_packet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace saker::lidar {
namespace {

constexpr std::size_t kVelodyneBytes = 1206;
constexpr std::size_t kVelodyneBlocks = 12;
constexpr std::size_t kVelodyneClockAt = 1200, kModeAt = 1204, kMakerAt = 1205;
constexpr std::size_t kVelodyneReturns = 32;
constexpr std::uint16_t kUpperBank = 0xEEFF, kLowerBank = 0xDDFF;
constexpr std::uint16_t kHesaiFlag = 0xFFEE;
constexpr int kTwoReturns = 0x39;       // and, of Hesai, what follows
constexpr int kThreeReturns = 0x3D;     // of Hesai's newest: not read
constexpr unsigned kWholeTurn = 36000;  // hundredths of a degree
constexpr double kMostTurned = 10;      // degrees from a block to the next; 1.2 at 20 Hz
constexpr Time kHour = 3600 * kNanosecondsPerSecond;

/// From −180 to 180.
double turn(double degrees) { return std::remainder(degrees, 360.); }

/// How fast the rotor turns, from a block to the next of the same return; the last as the one
/// before it. \return false where it cannot turn as far as that: the packet is damaged
[[nodiscard]] bool place_turning(std::vector<SpinningBlock>& blocks, std::size_t group) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::size_t from = i + group < blocks.size() ? i : blocks.size() - 2 * group + i % group;
    const SpinningBlock& a = blocks[from];
    const SpinningBlock& b = blocks[from + group];
    const double turned = turn(b.azimuth_deg - a.azimuth_deg);
    if (std::abs(turned) > kMostTurned) return false;
    blocks[i].turning_deg_us = turned / (b.time_us - a.time_us);
  }
  return true;
}

// --- Velodyne ---

std::optional<SpinningKind> velodyne_kind(ByteView bytes, bool two_banks) {
  using enum SpinningKind;
  if (two_banks) return kHdl64e;
  switch (bytes[kMakerAt]) {
    case 0x21:
      return kHdl32e;
    case 0x22:
      return kVlp16;
    case 0x24:
      return kVlp16HiRes;
    case 0x28:
      return kVlp32c;
    default:
      return std::nullopt;
  }
}

struct RawBlock {
  std::uint16_t bank = 0, azimuth = 0;
  ByteView returns;
};
using RawBlocks = std::array<RawBlock, kVelodyneBlocks>;

RawBlocks velodyne_blocks(ByteView bytes) {
  RawBlocks blocks;
  Cursor cursor(bytes);
  for (RawBlock& block : blocks) {
    block.bank = cursor.number<std::uint16_t>();
    block.azimuth = cursor.number<std::uint16_t>();
    block.returns = cursor.take(3 * kVelodyneReturns);
  }
  return blocks;
}

/// Upper and lower bank in turn.
bool has_two_banks(const RawBlocks& blocks) {
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].bank != (i % 2 == 0 ? kUpperBank : kLowerBank)) return false;
  }
  return true;
}

/// An HDL-64E does not say its mode; with two returns each pair of banks comes twice.
bool pairs_repeat(const RawBlocks& blocks) {
  for (std::size_t i = 0; i + 2 < blocks.size(); i += 4) {
    if (blocks[i].azimuth != blocks[i + 2].azimuth) return false;
  }
  return true;
}

std::optional<SpinningPacket> read_velodyne(ByteView bytes) {
  const RawBlocks raw = velodyne_blocks(bytes);
  const bool two_banks = has_two_banks(raw);
  const auto good = [&](const RawBlock& block) {
    return block.azimuth < kWholeTurn && (two_banks || block.bank == kUpperBank);
  };
  const auto kind = velodyne_kind(bytes, two_banks);
  if (!kind || !std::all_of(raw.begin(), raw.end(), good)) return std::nullopt;
  const bool two = two_banks ? pairs_repeat(raw) : bytes[kModeAt] == kTwoReturns;
  const std::size_t banks = two_banks ? 2 : 1;
  const std::size_t a_time = banks * (two ? 2 : 1);  // blocks of the same time
  SpinningPacket packet;
  packet.kind = *kind;
  packet.clock = Time{Cursor(bytes.subspan(kVelodyneClockAt)).number<std::uint32_t>()} * 1000;
  packet.clock_period = kHour;
  packet.range_unit_m = *kind == SpinningKind::kVlp32c ? 0.004 : 0.002;
  const double block_us = spinning_block_us(*kind);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    const std::size_t in_group = i % a_time;
    if (in_group >= banks) continue;  // the other return of a block that was taken
    SpinningBlock block;
    block.azimuth_deg = raw[i].azimuth / 100.;
    block.time_us = static_cast<double>(i / a_time) * block_us;
    block.first_beam = in_group * kVelodyneReturns;
    block.returns = raw[i].returns;
    if (two) block.others = raw[i + banks].returns;
    // Two returns of a VLP-16 and HDL-32E: the last, then the strongest, which is preferred.
    if (two && !two_banks) std::swap(block.returns, block.others);
    packet.blocks.push_back(block);
  }
  if (!place_turning(packet.blocks, banks)) return std::nullopt;
  return packet;
}

// --- Hesai ---

/// Where things are in a packet, by the manual of each sensor.
struct HesaiFormat {
  SpinningKind kind;
  std::size_t lasers, blocks, head, return_bytes, tail;
  std::size_t sequence_bytes;             ///< at the end; may be missing
  std::size_t clock_at, mode_at, utc_at;  ///< in the tail
  double first_us, before_us;             ///< time of the first block; of the last before the clock
  [[nodiscard]] std::size_t body() const { return blocks * (2 + lasers * return_bytes); }
};

constexpr std::array kHesaiFormats = {
    HesaiFormat{SpinningKind::kPandar64, 64, 6, 8, 3, 22, 4, 10, 14, 16, 0, -42.58},
    HesaiFormat{SpinningKind::kXt32, 32, 8, 12, 4, 24, 4, 19, 10, 13, 0, 0},
    HesaiFormat{SpinningKind::kQt64, 64, 4, 12, 4, 24, 4, 12, 16, 18, 25.71, 0},
};

/// Head of a Pandar64: flag, lasers, blocks, mode, unit; of the others: flag, version (two bytes),
/// two of nothing, lasers, blocks, mode, unit.
const HesaiFormat* hesai_format(ByteView bytes) {
  for (const HesaiFormat& format : kHesaiFormats) {
    const std::size_t size = format.head + format.body() + format.tail;
    if (bytes.size() != size && bytes.size() != size + format.sequence_bytes) continue;
    const bool pandar64 = format.kind == SpinningKind::kPandar64;
    const std::size_t at = pandar64 ? 2 : 6;
    if (bytes[at] != format.lasers || bytes[at + 1] != format.blocks) continue;
    if (!pandar64 && bytes[2] != (format.kind == SpinningKind::kXt32 ? 6 : 3)) continue;
    return &format;
  }
  return nullptr;
}

/// Days since 1970 of a date of the Gregorian calendar (H. Hinnant, "chrono-compatible low-level
/// date algorithms").
std::int64_t days_of(int year, int month, int day) {
  year -= month <= 2;
  const int era = (year >= 0 ? year : year - 399) / 400;
  const int of_era = year - era * 400;
  const int of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  return std::int64_t{era} * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

/// Year since 1900, month, day, hour, minute, second; or 0, 0 and seconds since 1970, big-endian.
Time hesai_second(ByteView utc) {
  if (utc[0] == 0) {
    return Time{Cursor(utc.subspan(2), true).number<std::uint32_t>()} * kNanosecondsPerSecond;
  }
  constexpr int kSecondsADay = 86400;
  const std::int64_t days = days_of(1900 + utc[0], utc[1], utc[2]);
  const int seconds = (utc[3] * 60 + utc[4]) * 60 + utc[5];
  return (days * kSecondsADay + seconds) * kNanosecondsPerSecond;
}

/// A Pandar64 and an XT32 say when the last block fired, a QT64 when the first did.
double hesai_block_us(const HesaiFormat& format, std::size_t time, std::size_t times) {
  const double block_us = spinning_block_us(format.kind);
  if (format.kind == SpinningKind::kQt64) {
    return format.first_us + block_us * static_cast<double>(time);
  }
  return format.before_us - block_us * static_cast<double>(times - 1 - time);
}

std::optional<SpinningPacket> read_hesai(ByteView bytes) {
  const HesaiFormat* format = hesai_format(bytes);
  if (!format) return std::nullopt;
  const ByteView tail = bytes.subspan(format->head + format->body());
  const int mode = tail[format->mode_at];
  if (mode >= kThreeReturns) return std::nullopt;
  const std::size_t a_time = mode >= kTwoReturns ? 2 : 1;
  SpinningPacket packet;
  packet.kind = format->kind;
  packet.clock = hesai_second(tail.subspan(format->utc_at, 6)) +
                 Time{Cursor(tail.subspan(format->clock_at)).number<std::uint32_t>()} * 1000;
  packet.range_unit_m = bytes[format->kind == SpinningKind::kPandar64 ? 5 : 9] / 1000.;
  packet.return_bytes = format->return_bytes;
  Cursor cursor(bytes.subspan(format->head));
  for (std::size_t i = 0; i < format->blocks; i += a_time) {
    SpinningBlock block;
    for (std::size_t k = 0; k < a_time; ++k) {
      block.azimuth_deg = cursor.number<std::uint16_t>() / 100.;
      // Of two returns the second block's counts: the strongest, or the first.
      block.others = block.returns;
      block.returns = cursor.take(format->lasers * format->return_bytes);
    }
    if (block.azimuth_deg > 360) return std::nullopt;
    block.time_us = hesai_block_us(*format, i / a_time, format->blocks / a_time);
    packet.blocks.push_back(block);
  }
  if (!place_turning(packet.blocks, 1)) return std::nullopt;
  return packet;
}

std::uint16_t flag_of(ByteView bytes) { return Cursor(bytes).number<std::uint16_t>(); }

}  // namespace

std::optional<SpinningPacket> read_spinning_packet(ByteView bytes) {
  if (bytes.size() == kVelodyneBytes && flag_of(bytes) == kUpperBank) return read_velodyne(bytes);
  if (bytes.size() >= 8 && flag_of(bytes) == kHesaiFlag) return read_hesai(bytes);
  return std::nullopt;
}

std::string unread_spinning_packet(ByteView bytes) {
  char text[96] = "";
  if (bytes.size() == kVelodyneBytes && flag_of(bytes) == kUpperBank) {
    std::snprintf(text, sizeof text, "Velodyne's, maker's byte 0x%02X", bytes[kMakerAt]);
  } else if (bytes.size() >= 200 && flag_of(bytes) == kHesaiFlag) {
    std::snprintf(text, sizeof text, "Hesai's, version %d.%d, %zu bytes", bytes[2], bytes[3],
                  bytes.size());
  }
  return text;
}

}  // namespace saker::lidar
