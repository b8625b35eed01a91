#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "saker/objects/class_table.h"

namespace saker::objects {

/// How coarse the geometry of a `.smap` is; the largest error is half a step in each coordinate.
struct SmapSteps {
  double position_m = 0.02;
  double size_m = 0.03;
  double radius_m = 0.01;
  double angle_deg = 1;
  double probability = 0.05;
  int tile_bits = 12;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("position_m", position_m, {1e-3, 1}, "m",
            "of a place: 0.02 keeps it within 1.8 cm in space");
    v.field("size_m", size_m, {1e-3, 1}, "m", "of lengths, widths and heights: within 1.5 cm");
    v.field("radius_m", radius_m, {1e-3, 1}, "m", "of radii: trunks begin at 4 cm, signs at 2.5");
    v.field("angle_deg", angle_deg, {0.01, 10}, "degrees", "of headings and of both tilts");
    v.field("probability", probability, {1e-3, 0.5}, "", "of the class's probability");
    v.field("tile_bits", tile_bits, {4, 24}, "",
            "a tile is 2^this steps of position wide: 82 m hold some 190 objects at 5 m from each "
            "other, enough that its own tables cost less than 3 bits an object");
  }

  [[nodiscard]] double tile_m() const { return position_m * static_cast<double>(1 << tile_bits); }
};

/// A square of the ground and how many bytes its parts have.
struct SmapTile {
  std::int64_t x = 0, y = 0;  ///< from (x, y) · SmapSteps::tile_m() on
  std::int64_t objects = 0, planes = 0;
  std::int64_t geometry_bytes = 0, ground_bytes = 0, detail_bytes = 0;

  [[nodiscard]] std::int64_t bytes() const { return geometry_bytes + ground_bytes + detail_bytes; }
  [[nodiscard]] Eigen::AlignedBox2d extent(const SmapSteps& steps) const;
};

struct SmapClass {
  std::string name;
  Shape shape = Shape::none;
};

/// What stands before the tiles, and once more behind them.
struct SmapHead {
  SmapSteps steps;
  std::string frame;
  std::vector<SmapClass> classes;  ///< tiles name them by their place in this list
  std::vector<SmapTile> tiles;     ///< in the order of the file
};

/// Throws Error on what is no head: nothing in it is believed before it was checked.
[[nodiscard]] std::string pack_head(const SmapHead& head);
[[nodiscard]] SmapHead unpack_head(std::string_view bytes);

/// The frame of every version: "SMAP", version, length, content, CRC-32; little-endian.
inline constexpr std::string_view kSmapMagic = "SMAP";
inline constexpr std::uint32_t kSmapVersion = 2;
inline constexpr std::size_t kFrameBytes = 12;  ///< before the content

[[nodiscard]] std::string framed(std::uint32_t version, std::string_view content);
[[nodiscard]] std::uint32_t version_of(std::string_view frame);     ///< throws Error
[[nodiscard]] std::size_t bytes_of(std::string_view frame);         ///< all of the frame's
[[nodiscard]] std::string_view content_of(std::string_view frame);  ///< throws Error

[[nodiscard]] std::string word(std::uint32_t value);
[[nodiscard]] std::uint32_t word_at(std::string_view bytes, std::size_t at);

}  // namespace saker::objects
