#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include "saker/core/config.h"
#include "saker/core/error.h"
#include "saker/objects/checksum.h"
#include "saker/objects/object_numbers.h"
#include "saker/objects/smap.h"
#include "saker/objects/smap_details.h"
#include "saker/objects/smap_geometry.h"

namespace saker::objects {
namespace {

/// Where an object or a plane stands in the file.
struct Entry {
  std::uint64_t tile;     ///< along the curve
  std::uint64_t in_tile;  ///< along the curve; planes stand in the order of the map
  std::uint32_t index;    ///< in the map
  bool plane;

  bool operator<(const Entry& other) const {
    return std::tie(tile, plane, in_tile, index) <
           std::tie(other.tile, other.plane, other.in_tile, other.index);
  }
};

std::string part(const std::string& bytes) { return word(checksum(bytes)) + bytes; }

std::int64_t length(const std::string& bytes) { return static_cast<std::int64_t>(bytes.size()); }

class Packer {
 public:
  Packer(const ObjectMap& map, const ClassTable& table, SmapContent content, const SmapSteps& steps)
      : map_(map), content_(content) {
    head_.steps = core::checked(steps, "smap");
    head_.frame = map.frame;
    coarse_.reserve(map.objects.size());
    std::vector<bool> used(static_cast<std::size_t>(table.size()));
    for (const MapObject& object : map.objects) {
      coarse_.push_back(coarse(object, table, steps));
      used[object.class_id] = true;
    }
    list_classes(table, used);
  }

  std::string pack() {
    const std::vector<Entry> entries = sorted_entries();
    std::string tiles;
    for (std::size_t i = 0; i < entries.size();) {
      std::size_t end = i;
      while (end < entries.size() && entries[end].tile == entries[i].tile) ++end;
      tiles += pack_tile(std::span(entries).subspan(i, end - i));
      i = end;
    }
    const std::string head = framed(kSmapVersion, pack_head(head_));
    return head + tiles + head + word(static_cast<std::uint32_t>(head.size()));
  }

 private:
  /// Those that occur, so that a reader needs to know no others.
  void list_classes(const ClassTable& table, const std::vector<bool>& used) {
    std::vector<std::int64_t> place_of(used.size(), -1);
    for (std::size_t id = 0; id < used.size(); ++id) {
      if (!used[id]) continue;
      place_of[id] = static_cast<std::int64_t>(head_.classes.size());
      head_.classes.push_back({table.classes[id].name, table.classes[id].shape});
    }
    for (CoarseObject& object : coarse_) {
      object.object_class = place_of[static_cast<std::size_t>(object.object_class)];
    }
  }

  [[nodiscard]] std::int64_t in_steps(double coordinate) const {
    if (!(std::abs(coordinate) <= kFarthest_m)) {
      throw Error(fmt::format("object map: ground at {}, expected {} … {}", coordinate,
                              -kFarthest_m, kFarthest_m));
    }
    return std::llround(coordinate / head_.steps.position_m);
  }

  /// Tiles on the other side of zero come first: the sign bit is turned.
  [[nodiscard]] std::uint64_t along_curve(std::int64_t x, std::int64_t y) const {
    constexpr std::int64_t kHalf = std::int64_t{1} << 31;
    return morton(tile_of(x, head_.steps) + kHalf, tile_of(y, head_.steps) + kHalf);
  }

  std::vector<Entry> sorted_entries() const {
    std::vector<Entry> entries;
    entries.reserve(coarse_.size() + map_.ground.size());
    const std::int64_t inside = (std::int64_t{1} << head_.steps.tile_bits) - 1;
    for (std::uint32_t i = 0; i < coarse_.size(); ++i) {
      const CoarseObject& o = coarse_[i];
      entries.push_back({along_curve(o.x, o.y), morton(o.x & inside, o.y & inside), i, false});
    }
    for (std::uint32_t i = 0; i < map_.ground.size(); ++i) {
      const Eigen::Vector3d& at = map_.ground[i].point;
      entries.push_back({along_curve(in_steps(at.x()), in_steps(at.y())), 0, i, true});
    }
    std::sort(entries.begin(), entries.end());
    return entries;
  }

  std::string pack_tile(std::span<const Entry> entries) {
    std::vector<CoarseObject> objects;
    std::vector<Listed<const MapObject*>> exact;
    std::vector<Listed<GroundPlane>> planes;
    for (const Entry& entry : entries) {
      if (entry.plane) {
        planes.push_back({entry.index, map_.ground[entry.index]});
        continue;
      }
      objects.push_back(coarse_[entry.index]);
      exact.push_back({entry.index, &map_.objects[entry.index]});
    }
    SmapTile tile = placed_tile(objects, planes);
    std::string bytes;
    if (!objects.empty()) {
      bytes = part(pack_geometry(objects, head_.classes, head_.steps));
      tile.geometry_bytes = length(bytes);
    }
    if (!planes.empty()) bytes += part(pack_ground(planes));
    tile.ground_bytes = length(bytes) - tile.geometry_bytes;
    if (!objects.empty() && content_ == SmapContent::everything) bytes += part(pack_details(exact));
    tile.detail_bytes = length(bytes) - tile.geometry_bytes - tile.ground_bytes;
    head_.tiles.push_back(tile);
    return bytes;
  }

  [[nodiscard]] SmapTile placed_tile(const std::vector<CoarseObject>& objects,
                                     const std::vector<Listed<GroundPlane>>& planes) const {
    const std::int64_t x =
        objects.empty() ? in_steps(planes.front().value.point.x()) : objects.front().x;
    const std::int64_t y =
        objects.empty() ? in_steps(planes.front().value.point.y()) : objects.front().y;
    return {.x = tile_of(x, head_.steps),
            .y = tile_of(y, head_.steps),
            .objects = static_cast<std::int64_t>(objects.size()),
            .planes = static_cast<std::int64_t>(planes.size())};
  }

  const ObjectMap& map_;
  SmapContent content_;
  SmapHead head_;
  std::vector<CoarseObject> coarse_;
};

}  // namespace

std::string pack_smap(const ObjectMap& map, const ClassTable& table, SmapContent content,
                      const SmapSteps& steps) {
  return Packer(map, table, content, steps).pack();
}

}  // namespace saker::objects
