#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// How many numbers make a point of a file that does not say so (`*.bin`), and what they are.
namespace saker::lidar {

/// What each number of a point is: "x", "y", "z", "intensity", "ring", "time", or "_" (not used).
using FloatFields = std::vector<std::string>;

/// What the columns of rows of that many numbers are; the first three are x, y, z.
[[nodiscard]] FloatFields name_columns(std::span<const float> values, std::size_t columns);

/// "x,y,z,i,ring": throws Error when x, y or z is missing or a name is unknown.
[[nodiscard]] FloatFields parse_point_fields(const std::string& text);

/// "x y z intensity ring".
[[nodiscard]] std::string describe_fields(const FloatFields& fields);

/// From the first, the middle and the last file: the number of floats for which the numbers of a
/// column are alike (sign, wholeness, size) and those of different columns are not, and the first
/// three make plausible points. With too few points to tell: x, y, z, intensity, as KITTI has them.
/// Throws Error when nothing fits, saying what was found (float64, for instance).
[[nodiscard]] FloatFields find_fields(const std::vector<std::filesystem::path>& files,
                                      const std::string& where);

}  // namespace saker::lidar
