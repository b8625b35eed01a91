#pragma once

#include <string_view>
#include <vector>

#include "saker/lidar/cursor.h"

namespace saker::lidar {

inline constexpr std::size_t kLargestPiece = std::size_t{1} << 30;  ///< of decompressed bytes

/// What bags and MCAP files call a compression.
enum class Compression { kNone, kLz4, kZstd, kBz2, kUnknown };

/// "none", "lz4", "zstd", "bz2" and "" as they stand in files.
[[nodiscard]] Compression compression_of(std::string_view name);

/// Appends nothing to what was in `into`: it is replaced. As much as can be had is there even where
/// the bytes are cut or damaged.
/// \param most  bytes at which it is given up
/// \return true where the bytes were whole
[[nodiscard]] bool decompress(Compression compression, ByteView bytes, std::size_t most,
                              std::vector<std::uint8_t>& into);

/// LZF, of PCD files, to exactly `size` bytes; false where it is damaged.
[[nodiscard]] bool decompress_lzf(ByteView bytes, std::size_t size,
                                  std::vector<std::uint8_t>& into);

}  // namespace saker::lidar
