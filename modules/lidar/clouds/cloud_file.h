#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saker/lidar/clouds/point_layout.h"

/// Files of one cloud each: PCD (ascii, binary, binary_compressed), PLY (ascii, binary of either
/// order) and NumPy's .npy (rows of numbers, or records with names).
namespace saker::lidar {

struct Cloud {
  PointLayout layout;
  std::size_t rows = 1;  ///< of an organised cloud; 1 otherwise
  std::size_t columns = 0;
  std::vector<std::uint8_t> bytes;  ///< records, row by row
};

enum class CloudFormat { kNone, kPcd, kPly, kNpy };

/// By a file's first bytes.
[[nodiscard]] CloudFormat cloud_format(ByteView begin);

/// \return why it could not be read, "line 3: …, expected …", or empty
[[nodiscard]] std::string read_cloud(const std::filesystem::path& file, Cloud& cloud);

[[nodiscard]] std::string parse_pcd(ByteView bytes, Cloud& cloud);
[[nodiscard]] std::string parse_ply(ByteView bytes, Cloud& cloud);
[[nodiscard]] std::string parse_npy(ByteView bytes, Cloud& cloud);

inline constexpr std::size_t kMostCloudPoints = 20'000'000;

/// Words of the next line; false at the end of the bytes.
[[nodiscard]] bool next_line(Cursor& cursor, std::vector<std::string>& words);

/// A whole number from 0 to `most`; −1 where it is none.
[[nodiscard]] long whole_number(const std::string& word, long most);

/// Numbers as text, `points` of them a field: into records of float64.
[[nodiscard]] std::string parse_text_points(Cursor& cursor, std::size_t points, Cloud& cloud);

}  // namespace saker::lidar
