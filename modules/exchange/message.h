#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "saker/exchange/stream.h"

/// The two messages of the protocol, as bytes (little-endian, variable-length integers).
namespace saker::exchange {

/// Of a message before it is sealed: a whole chunk with the longest names.
constexpr std::size_t kLongestMessage = kChunkBytes + 50;

/// "So much of this stream I hold": offer, request and acknowledgement in one.
struct Holding {
  StreamId id;
  Extent held{};             ///< beyond the gap as far as kMostBeyond chunks
  std::uint32_t digest = 0;  ///< of held.contiguous bytes (digest.h)
  bool refused = false;      ///< could not be kept: do not go on sending it
};

/// Chunks after the open one that a Holding tells apart.
constexpr int kMostBeyond = 512;

struct HoldingsMessage {
  bool asks = false;          ///< for the counterpart's holdings of the same streams
  std::uint32_t round = 0;    ///< of the sender, when it asks
  std::uint32_t answers = 0;  ///< the counterpart's round; 0: none
  std::vector<Holding> lines{};
};

struct ChunkMessage {
  StreamId id{};
  std::size_t offset = 0;  ///< in the stream
  std::string bytes{};     ///< within one chunk
};

using Message = std::variant<HoldingsMessage, ChunkMessage>;

[[nodiscard]] std::string to_bytes(const HoldingsMessage& message);
[[nodiscard]] std::string to_bytes(const ChunkMessage& message);
/// Bytes that a line takes in a message.
[[nodiscard]] std::size_t size_of(const Holding& line);
/// Nothing where the bytes are no message.
[[nodiscard]] std::optional<Message> message_of(std::string_view bytes);

}  // namespace saker::exchange
