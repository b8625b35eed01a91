#pragma once

#include <filesystem>
#include <string>

#include "objects/class_table.h"
#include "objects/object_map.h"

/// Object maps in files: JSON for people and scripts, `.smap` for everything else. Both hold the
/// same.
///
/// JSON: {"frame", "objects": [{"id", "class", "probability", "observations", "position",
/// "rotation" [qx, qy, qz, qw], "size" | "root", "axis", "radius", "height", "sd", "correlation",
/// "points"}], "ground": [{"normal", "point", "radius"}]}; metres, in the map's frame. `sd`
/// (radians and metres, in the object's own frame) is there where a covariance was computed, and
/// with it `correlation` between x, y, length and width of a cuboid ([xy, xl, xw, yl, yw, lw]) or x
/// and y of a cylinder's root ([xy]); `points` where a simulator says what it hit. Numbers are
/// written with six decimals, so that both forms of a map agree. Every error of reading is an Error
/// that names file, field, what was found and what was expected.
namespace saker::objects {

[[nodiscard]] std::string to_json(const ObjectMap& map, const ClassTable& table);
[[nodiscard]] ObjectMap from_json(const std::string& text, const ClassTable& table,
                                  const std::string& file);

/// `.smap`: "SMAP", version, length, the map, CRC-32; little-endian.
[[nodiscard]] std::string to_smap(const ObjectMap& map, const ClassTable& table);
[[nodiscard]] ObjectMap from_smap(const std::string& bytes, const ClassTable& table,
                                  const std::string& file);

/// The form follows the content, not the name of the file.
[[nodiscard]] ObjectMap read_map(const std::filesystem::path& file, const ClassTable& table);

/// The form follows the ending: `.json` or `.smap`.
void write_map(const std::filesystem::path& file, const ObjectMap& map, const ClassTable& table);

}  // namespace saker::objects
