#include "flight/mavlink/frame.h"

#include <algorithm>
#include <cstring>

namespace saker::flight::mavlink {
namespace {

constexpr std::uint8_t kMagic1 = 0xFE, kMagic2 = 0xFD;
constexpr std::size_t kHeader1 = 6, kHeader2 = 10, kCrc = 2, kSignature = 13;
constexpr std::uint8_t kSignedFlag = 1;

bool is_magic(std::uint8_t byte) { return byte == kMagic1 || byte == kMagic2; }

std::size_t header_length(std::uint8_t magic) { return magic == kMagic2 ? kHeader2 : kHeader1; }

std::uint32_t id_of(std::span<const std::uint8_t> frame) {
  if (frame[0] == kMagic1) return frame[5];
  return frame[7] | frame[8] << 8 | frame[9] << 16;
}

std::uint16_t crc_of(std::span<const std::uint8_t> header_and_payload, std::uint8_t crc_extra) {
  return crc16({&crc_extra, 1}, crc16(header_and_payload.subspan(1)));
}

constexpr std::array<std::uint16_t, 256> crc_table() {
  std::array<std::uint16_t, 256> table{};
  for (unsigned i = 0; i < 256; ++i) {
    unsigned value = i;
    for (int bit = 0; bit < 8; ++bit) value = value & 1 ? value >> 1 ^ 0x8408 : value >> 1;
    table[i] = static_cast<std::uint16_t>(value);
  }
  return table;
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes, std::uint16_t value) {
  static constexpr auto kTable = crc_table();
  for (const std::uint8_t byte : bytes)
    value = static_cast<std::uint16_t>(value >> 8 ^ kTable[(value ^ byte) & 0xFF]);
  return value;
}

const Definition* definition_of(std::uint32_t id) {
  const auto found =
      std::lower_bound(kDefinitions.begin(), kDefinitions.end(), id,
                       [](const Definition& d, std::uint32_t v) { return d.id < v; });
  return found != kDefinitions.end() && found->id == id ? &*found : nullptr;
}

FrameBytes FrameWriter::frame(std::uint32_t id, std::uint8_t crc_extra, const Payload& payload,
                              Signing* signing, SigningTime now) {
  std::size_t length = payload.length;
  while (length > 1 && payload.bytes[length - 1] == 0) --length;
  FrameBytes frame;
  frame.bytes = {kMagic2,
                 static_cast<std::uint8_t>(length),
                 signing ? kSignedFlag : std::uint8_t{0},
                 0,
                 sequence_++,
                 system_,
                 component_,
                 static_cast<std::uint8_t>(id),
                 static_cast<std::uint8_t>(id >> 8),
                 static_cast<std::uint8_t>(id >> 16)};
  std::copy_n(payload.bytes.begin(), length, frame.bytes.begin() + kHeader2);
  frame.length = kHeader2 + length;
  const std::uint16_t crc = crc_of(frame.span(), crc_extra);
  frame.bytes[frame.length++] = static_cast<std::uint8_t>(crc);
  frame.bytes[frame.length++] = static_cast<std::uint8_t>(crc >> 8);
  if (!signing) return frame;
  const SigningTime stamp = signing->clock.next(now);
  const Signature signature = signature_of(signing->key, frame.span(), signing->link, stamp);
  frame.bytes[frame.length++] = signing->link;
  for (int i = 0; i < 6; ++i)
    frame.bytes[frame.length++] = static_cast<std::uint8_t>(stamp >> (8 * i));
  for (const std::uint8_t byte : signature) frame.bytes[frame.length++] = byte;
  return frame;
}

std::size_t FrameReader::push(std::span<const std::uint8_t> bytes) {
  const std::size_t count = std::min(bytes.size(), buffer_.size() - size_);
  std::copy_n(bytes.begin(), count, buffer_.begin() + size_);
  size_ += count;
  settled_ = false;
  return count;
}

std::optional<Frame> FrameReader::next(SigningTime now) {
  while (size_ > 0) {
    const Found found = look_at(0);
    if (found.look == Look::whole) {
      if (std::optional<Frame> frame = taken(found.length, now)) return frame;
      continue;
    }
    if (found.look == Look::more && !settled_ && !two_whole_frames_follow()) return std::nullopt;
    if (found.look == Look::unknown && !whole_frame_begins_within(found.length)) {
      ++counters_.unknown;
      drop(found.length);
      continue;
    }
    counters_.damaged += found.look == Look::damaged || found.look == Look::unknown;
    ++counters_.skipped;
    drop(1);
  }
  return std::nullopt;
}

/// A message without a definition has no CRC that could be checked: it is skipped where another
/// frame begins right behind it and none within it, else it is no frame.
FrameReader::Found FrameReader::look_at(std::size_t begin) const {
  const std::span<const std::uint8_t> rest{buffer_.data() + begin, size_ - begin};
  if (!is_magic(rest[0])) return {};
  const std::size_t header = header_length(rest[0]);
  if (rest.size() < header) return {Look::more};
  if (rest[0] == kMagic2 && (rest[2] & ~kSignedFlag) != 0) return {};  // of an unknown kind
  const bool is_signed = rest[0] == kMagic2 && rest[2] == kSignedFlag;
  const std::size_t checked = header + rest[1];
  const std::size_t length = checked + kCrc + (is_signed ? kSignature : 0);
  if (rest.size() < length) return {Look::more};
  const Definition* definition = definition_of(id_of(rest));
  if (!definition) {
    if (rest.size() == length && !settled_) return {Look::more};
    const bool fits = rest.size() == length || is_magic(rest[length]);
    return {fits ? Look::unknown : Look::damaged, length};
  }
  const std::uint16_t crc = crc_of(rest.first(checked), definition->crc_extra);
  const bool right = crc == (rest[checked] | rest[checked + 1] << 8);
  return {right ? Look::whole : Look::damaged, length};
}

bool FrameReader::whole_frame_begins_within(std::size_t length) const {
  for (std::size_t begin = 1; begin < length; ++begin)
    if (look_at(begin).look == Look::whole) return true;
  return false;
}

bool FrameReader::two_whole_frames_follow() const {
  for (std::size_t begin = 1; begin < size_; ++begin) {
    const Found first = look_at(begin);
    if (first.look != Look::whole || begin + first.length >= size_) continue;
    if (look_at(begin + first.length).look == Look::whole) return true;
  }
  return false;
}

/// The frame at the front, or nothing where it is not believed; it is gone from the buffer.
std::optional<Frame> FrameReader::taken(std::size_t length, SigningTime now) {
  const std::span<const std::uint8_t> bytes{buffer_.data(), length};
  Frame frame;
  const std::size_t header = header_length(bytes[0]);
  const std::size_t at = bytes[0] == kMagic2 ? 4 : 2;
  frame.version = bytes[0] == kMagic2 ? 2 : 1;
  frame.sequence = bytes[at];
  frame.system = bytes[at + 1];
  frame.component = bytes[at + 2];
  frame.id = id_of(bytes);
  frame.payload.length = bytes[1];
  std::copy_n(bytes.begin() + header, frame.payload.length, frame.payload.bytes.begin());
  frame.is_signed = length == header + frame.payload.length + kCrc + kSignature;
  const bool good = believed(bytes, frame, now);
  drop(length);
  if (!good) return std::nullopt;
  ++counters_.frames;
  return frame;
}

bool FrameReader::believed(std::span<const std::uint8_t> frame, const Frame& read,
                           SigningTime now) {
  if (!signing_) return true;
  if (!read.is_signed) {
    ++counters_.unsigned_;
    return false;
  }
  const auto tail = frame.last(kSignature);
  SignedBy by{read.system, read.component, tail[0]};
  for (int i = 0; i < 6; ++i) by.stamp |= SigningTime{tail[1 + i]} << (8 * i);
  const Signature right =
      signature_of(signing_->key, frame.first(frame.size() - kSignature), by.link, by.stamp);
  const bool genuine =
      std::equal(right.begin(), right.end(), tail.begin() + 7) && signing_->clock.accept(by, now);
  counters_.forged += !genuine;
  return genuine;
}

void FrameReader::drop(std::size_t count) {
  std::memmove(buffer_.data(), buffer_.data() + count, size_ - count);
  size_ -= count;
}

}  // namespace saker::flight::mavlink
