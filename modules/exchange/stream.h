#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// What robots tell each other: byte strings that only grow, each under a name.
namespace saker::exchange {

/// What the bytes of a stream are.
enum class StreamKind : std::uint8_t {
  history,      ///< packed_history.h, of one flight
  prior_map,    ///< a .smap
  uncertainty,  ///< a file of uncertainty models
};
constexpr int kStreamKinds = 3;

[[nodiscard]] std::vector<std::string> enum_names(StreamKind);

constexpr std::size_t kLongestName = 16;  ///< of a robot or of another sender, bytes

/// The same name stands for the same bytes for ever: what is not appended to is a new version.
struct StreamId {
  std::string robot;  ///< whose it is: 1 … kLongestName capitals and digits, as in R1
  StreamKind kind = StreamKind::history;
  std::uint32_t version = 0;  ///< a history's flight, counted from 1; of what else, also from 1

  auto operator<=>(const StreamId&) const = default;
};

/// "R1/history/3"
[[nodiscard]] std::string to_string(const StreamId& id);
[[nodiscard]] bool is_name(const std::string& name);

/// Chunk k of a stream is its bytes k · kChunkBytes … (k + 1) · kChunkBytes; only the last one may
/// be shorter, and grow.
constexpr std::size_t kChunkBytes = 1100;
constexpr int kMostChunks = 65536;  ///< of a stream: 72 MB

/// Which bytes of a stream are held: all from the beginning to somewhere, and chunks beyond.
struct Extent {
  std::size_t contiguous = 0;         ///< bytes from the beginning without a gap
  std::map<int, std::size_t> beyond;  ///< chunk after the one with the gap → its bytes held

  /// The chunk that `contiguous` ends in.
  [[nodiscard]] int open_chunk() const { return static_cast<int>(contiguous / kChunkBytes); }
  /// Of chunk k, from its beginning.
  [[nodiscard]] std::size_t bytes_of(int chunk) const;
  /// The first `bytes` bytes of a chunk are held now.
  void add(int chunk, std::size_t bytes);
  /// What is held by either.
  void merge(const Extent& other);

  bool operator==(const Extent&) const = default;
};

}  // namespace saker::exchange
