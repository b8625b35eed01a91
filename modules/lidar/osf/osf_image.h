#pragma once

#include <vector>

#include "saker/lidar/cursor.h"

namespace saker::lidar {

/// A field of an OSF scan: numbers of 1, 2, 4 or 8 bytes, row by row.
struct OsfImage {
  std::size_t rows = 0, columns = 0;
  std::size_t bytes_a_pixel = 0;
  std::vector<std::uint8_t> pixels;
  bool destaggered = false;  ///< rows are moved by their pixel shifts

  [[nodiscard]] std::uint64_t pixel(std::size_t row, std::size_t column) const;
};

/// Unpacks a field: images of today's files (filtered and packed with zstd; columns as sent) or PNG
/// (older files; destaggered). False where it is neither, damaged, or of another size than given.
[[nodiscard]] bool unpack_osf_image(ByteView bytes, std::size_t rows, std::size_t columns,
                                    OsfImage& image);

}  // namespace saker::lidar
