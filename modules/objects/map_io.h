#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "saker/objects/class_table.h"
#include "saker/objects/geodesy.h"
#include "saker/objects/object_map.h"
#include "saker/objects/smap.h"

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

/// `.smap` version 2 (smap.h); version 1, the JSON's document as CBOR, can still be read.
[[nodiscard]] std::string to_smap(const ObjectMap& map, const ClassTable& table,
                                  SmapContent content = SmapContent::everything);
/// Throws Error where anything of it is damaged.
[[nodiscard]] ObjectMap from_smap(const std::string& bytes, const ClassTable& table,
                                  const std::string& file);

/// The form follows the content, not the name of the file.
[[nodiscard]] ObjectMap read_map(const std::filesystem::path& file, const ClassTable& table);

/// What lies in `region` and is whole: of a `.smap` no more than that is read, and its damage is
/// told instead of thrown.
[[nodiscard]] MapRead read_map_part(const std::filesystem::path& file, const ClassTable& table,
                                    const Region& region);

/// What a `.smap` is made of.
struct SmapLayout {
  std::uint32_t version = 0;
  std::size_t bytes = 0, head_bytes = 0;  ///< of the file, of one of its heads
  std::size_t tiles = 0;
  double tile_m = 0;
  std::int64_t geometry_bytes = 0, ground_bytes = 0, detail_bytes = 0;
};

/// None where the file is no `.smap`. Of version 1 there is nothing but its bytes.
[[nodiscard]] std::optional<SmapLayout> smap_layout(const std::filesystem::path& file);

struct MapFormat {
  SmapContent content = SmapContent::everything;  ///< of a `.smap`
  std::optional<GeoOrigin> origin;                ///< of `.geojson` and `.kml`
};

/// The form follows the ending: `.json`, `.smap` and, for other programs, `.csv`, `.geojson`,
/// `.ply` (map_export.h) and `.kml` (map_kml.h).
void write_map(const std::filesystem::path& file, const ObjectMap& map, const ClassTable& table,
               const MapFormat& format = {});

}  // namespace saker::objects
