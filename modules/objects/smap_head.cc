#include "saker/objects/smap_head.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "saker/core/config.h"
#include "saker/core/error.h"
#include "saker/objects/checksum.h"
#include "saker/objects/object_numbers.h"
#include "saker/objects/rice.h"

namespace saker::objects {
namespace {

constexpr std::size_t kWord = 4;
constexpr std::int64_t kMostBytesOfAPart = UINT32_MAX;
constexpr int kShapeBits = 2;
constexpr std::size_t kMostClasses = 256;  ///< as many as a ClassId tells apart

constexpr std::int64_t SmapTile::*kColumns[] = {&SmapTile::x,
                                                &SmapTile::y,
                                                &SmapTile::objects,
                                                &SmapTile::planes,
                                                &SmapTile::geometry_bytes,
                                                &SmapTile::ground_bytes,
                                                &SmapTile::detail_bytes};

struct PutFields {
  BitWriter& out;
  template <class T>
  void field(const char*, T& value, core::Bounds, const char*, const char*) {
    out.put(static_cast<double>(value));
  }
};

struct TakeFields {
  BitReader& in;
  template <class T>
  void field(const char*, T& value, core::Bounds, const char*, const char*) {
    const double taken = in.take_double();
    if (!(std::abs(taken) < kFarthest_m)) throw Error("a step is not a number");
    value = static_cast<T>(taken);
  }
};

/// What is shown to people and written into other files.
std::string take_name(BitReader& in) {
  std::string name = in.take_text();
  for (const char c : name) {
    if (static_cast<std::uint8_t>(c) < ' ') throw Error("a name with control characters");
  }
  try {
    (void)nlohmann::json(name).dump();
  } catch (const nlohmann::json::exception&) {
    throw Error("a name that is not UTF-8");
  }
  return name;
}

void check(const SmapTile& tile, const SmapSteps& steps) {
  const double farthest = kFarthest_m / steps.tile_m() + 1;
  if (!(std::abs(static_cast<double>(tile.x)) <= farthest &&
        std::abs(static_cast<double>(tile.y)) <= farthest)) {
    throw Error("a tile lies too far out");
  }
  for (const std::int64_t bytes : {tile.geometry_bytes, tile.ground_bytes, tile.detail_bytes}) {
    if (bytes < 0 || bytes > kMostBytesOfAPart) throw Error("a tile's length is impossible");
  }
  // An object has at least eight columns and a plane as many numbers, each of a bit or more.
  if (tile.objects < 0 || tile.objects > tile.geometry_bytes || tile.planes < 0 ||
      tile.planes > tile.ground_bytes) {
    throw Error("a tile holds more than fits into its bytes");
  }
}

}  // namespace

Eigen::AlignedBox2d SmapTile::extent(const SmapSteps& steps) const {
  const Eigen::Vector2d corner =
      steps.tile_m() * Eigen::Vector2d(static_cast<double>(x), static_cast<double>(y));
  const Eigen::Vector2d rim = Eigen::Vector2d::Constant(steps.position_m);  // of rounding
  return {corner - rim, corner + Eigen::Vector2d::Constant(steps.tile_m()) + rim};
}

std::string pack_head(const SmapHead& head) {
  BitWriter out;
  PutFields fields{out};
  SmapSteps steps = head.steps;
  steps.visit(fields);
  out.put(std::string_view(head.frame));
  out.put(head.classes.size(), 32);
  for (const SmapClass& c : head.classes) {
    out.put(static_cast<std::uint64_t>(c.shape), kShapeBits);
    out.put(std::string_view(c.name));
  }
  out.put(head.tiles.size(), 32);
  std::vector<std::int64_t> column(head.tiles.size());
  for (const auto member : kColumns) {
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = head.tiles[i].*member;
    write_column(out, column);
  }
  return out.finish();
}

SmapHead unpack_head(std::string_view bytes) {
  BitReader in{std::string(bytes)};
  SmapHead head;
  TakeFields fields{in};
  head.steps.visit(fields);
  head.steps = core::checked(head.steps, "steps");
  head.frame = take_name(in);
  const std::uint64_t classes = in.take(32);
  if (classes > kMostClasses) throw Error("too many classes");
  for (std::uint64_t i = 0; i < classes; ++i) {
    const auto shape = static_cast<Shape>(in.take(kShapeBits));
    head.classes.push_back({take_name(in), shape});
  }
  const std::uint64_t tiles = in.take(32);
  if (tiles > in.bits_left()) throw Error("its content ends too early");
  head.tiles.resize(tiles);
  for (const auto member : kColumns) {
    const std::vector<std::int64_t> column = read_column(in, tiles);
    for (std::size_t i = 0; i < column.size(); ++i) head.tiles[i].*member = column[i];
  }
  for (const SmapTile& tile : head.tiles) check(tile, head.steps);
  return head;
}

std::string word(std::uint32_t value) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = kWord; i-- > 0;)
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

std::string framed(std::uint32_t version, std::string_view content) {
  return std::string(kSmapMagic) + word(version) +
         word(static_cast<std::uint32_t>(content.size())) + std::string(content) +
         word(checksum(content));
}

std::uint32_t version_of(std::string_view frame) {
  if (frame.size() < kFrameBytes || !frame.starts_with(kSmapMagic)) {
    throw Error(fmt::format("{} bytes, expected a .smap file", frame.size()));
  }
  return word_at(frame, kSmapMagic.size());
}

std::size_t bytes_of(std::string_view frame) {
  (void)version_of(frame);
  return kFrameBytes + word_at(frame, kFrameBytes - kWord) + kWord;
}

std::string_view content_of(std::string_view frame) {
  const std::size_t expected = bytes_of(frame);
  if (frame.size() != expected) {
    throw Error(fmt::format("{} bytes, expected {} (cut?)", frame.size(), expected));
  }
  const std::string_view content = frame.substr(kFrameBytes, expected - kFrameBytes - kWord);
  if (checksum(content) != word_at(frame, expected - kWord)) {
    throw Error("wrong checksum, the file is damaged");
  }
  return content;
}

}  // namespace saker::objects
