#include "saker/exchange/message.h"

#include <algorithm>

#include "saker/exchange/bytes.h"

namespace saker::exchange {
namespace {

// The first byte: which message, and its flags.
constexpr std::uint8_t kHoldings = 0x10, kChunk = 0x20, kAsks = 0x01;
// Of a line.
constexpr std::uint8_t kRefused = 0x01, kBeyond = 0x02;

void write(const StreamId& id, ByteWriter& out) {
  out.text(id.robot);
  out.byte(static_cast<std::uint8_t>(id.kind));
  out.varint(id.version);
}

bool read(ByteReader& in, StreamId& id) {
  id.robot = in.text();
  const int kind = in.byte();
  const std::uint64_t version = in.varint();
  id.kind = static_cast<StreamKind>(kind);
  id.version = static_cast<std::uint32_t>(version);
  return !in.failed() && is_name(id.robot) && kind < kStreamKinds && version == id.version;
}

/// The chunks after the open one: bit i of the string stands for chunk open + 1 + i. Only the last
/// one may be partial; others that are do not count as held.
void write_beyond(const Extent& held, ByteWriter& out) {
  const int first = held.open_chunk() + 1;
  std::string bits;
  std::size_t last_bytes = 0;
  for (const auto& [chunk, bytes] : held.beyond) {
    const int bit = chunk - first;
    if (bit >= kMostBeyond) break;
    const bool last = chunk == held.beyond.rbegin()->first;
    if (bytes < kChunkBytes && !last) continue;
    bits.resize(static_cast<std::size_t>(bit) / 8 + 1, '\0');
    bits.back() = static_cast<char>(bits.back() | 1 << (bit % 8));
    last_bytes = bytes;
  }
  out.varint(last_bytes);
  out.text(bits);
}

bool read_beyond(ByteReader& in, Extent& held) {
  const std::uint64_t last_bytes = in.varint();
  const std::string_view bits = in.text();
  if (in.failed() || last_bytes > kChunkBytes || bits.size() > kMostBeyond / 8) return false;
  const int first = held.open_chunk() + 1;
  for (int bit = 0; bit < static_cast<int>(8 * bits.size()); ++bit) {
    if ((bits[static_cast<std::size_t>(bit) / 8] >> (bit % 8) & 1) == 0) continue;
    if (first + bit >= kMostChunks) return false;
    held.beyond[first + bit] = kChunkBytes;
  }
  if (!held.beyond.empty()) held.beyond.rbegin()->second = last_bytes;
  return held.beyond.empty() == (last_bytes == 0);
}

void write(const Holding& line, ByteWriter& out) {
  write(line.id, out);
  out.byte(static_cast<std::uint8_t>((line.refused ? kRefused : 0) |
                                     (line.held.beyond.empty() ? 0 : kBeyond)));
  out.varint(line.held.contiguous);
  if (line.held.contiguous > 0) out.fixed(line.digest);
  if (!line.held.beyond.empty()) write_beyond(line.held, out);
}

bool read(ByteReader& in, Holding& line) {
  if (!read(in, line.id)) return false;
  const std::uint8_t flags = in.byte();
  const std::uint64_t contiguous = in.varint();
  if (flags > (kRefused | kBeyond) || contiguous > kMostChunks * kChunkBytes) return false;
  line.refused = (flags & kRefused) != 0;
  line.held.contiguous = contiguous;
  if (contiguous > 0) line.digest = in.fixed<std::uint32_t>();
  if ((flags & kBeyond) != 0 && !read_beyond(in, line.held)) return false;
  return !in.failed();
}

std::optional<Message> holdings_of(ByteReader& in, bool asks) {
  HoldingsMessage message{.asks = asks};
  message.round = static_cast<std::uint32_t>(in.varint());
  message.answers = static_cast<std::uint32_t>(in.varint());
  while (in.rest() > 0) {
    Holding line;
    if (!read(in, line)) return std::nullopt;
    message.lines.push_back(std::move(line));
  }
  if (!in.done()) return std::nullopt;
  return message;
}

std::optional<Message> chunk_of(ByteReader& in) {
  ChunkMessage message;
  if (!read(in, message.id)) return std::nullopt;
  message.offset = in.varint();
  message.bytes = in.raw(in.rest());
  const bool fits = message.offset < kMostChunks * kChunkBytes && !message.bytes.empty() &&
                    message.offset % kChunkBytes + message.bytes.size() <= kChunkBytes;
  if (in.failed() || !fits) return std::nullopt;
  return message;
}

}  // namespace

std::string to_bytes(const HoldingsMessage& message) {
  ByteWriter out;
  out.byte(static_cast<std::uint8_t>(kHoldings | (message.asks ? kAsks : 0)));
  out.varint(message.round);
  out.varint(message.answers);
  for (const Holding& line : message.lines) write(line, out);
  return out.bytes();
}

std::string to_bytes(const ChunkMessage& message) {
  ByteWriter out;
  out.byte(kChunk);
  write(message.id, out);
  out.varint(message.offset);
  out.raw(message.bytes);
  return out.bytes();
}

std::size_t size_of(const Holding& line) {
  ByteWriter out;
  write(line, out);
  return out.bytes().size();
}

std::optional<Message> message_of(std::string_view bytes) {
  ByteReader in(bytes);
  const std::uint8_t head = in.byte();
  if (head == kChunk) return chunk_of(in);
  if ((head & ~kAsks) == kHoldings) return holdings_of(in, (head & kAsks) != 0);
  return std::nullopt;
}

}  // namespace saker::exchange
