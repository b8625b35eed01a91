#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "saker/core/error.h"
#include "saker/objects/checksum.h"
#include "saker/objects/object_numbers.h"
#include "saker/objects/smap.h"
#include "saker/objects/smap_details.h"
#include "saker/objects/smap_geometry.h"

namespace saker::objects {
namespace {

constexpr std::size_t kWord = 4;
/// Fewer are not met; so a head that promises more cannot claim memory.
constexpr std::size_t kLeastBytesOfAnObject = 4;
constexpr std::int64_t kLargestId = 2000000000;
/// Places in the list of objects of which the file says none: behind all that it says.
constexpr std::int64_t kBehind = std::int64_t{1} << 40;

/// The classes of a file in the table. Throws Error where one is not there or of another shape.
std::vector<ClassId> ids_of(const std::vector<SmapClass>& classes, const ClassTable& table) {
  std::vector<ClassId> ids;
  for (const SmapClass& c : classes) {
    ids.push_back(table.find(c.name));
    if (table[ids.back()].shape != c.shape) {
      throw Error(fmt::format("class \"{}\" has another shape in the class table", c.name));
    }
  }
  return ids;
}

/// Moves `values` into the order of `places`, which is left as it was.
template <class T>
void sort_by(const std::vector<std::int64_t>& places, std::vector<T>& values) {
  if (std::is_sorted(places.begin(), places.end())) return;
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::size_t i : order) sorted.push_back(std::move(values[i]));
  values = std::move(sorted);
}

/// Objects without identity follow those that have one.
void number_the_others(const std::vector<std::int64_t>& places, std::vector<MapObject>& objects) {
  std::int64_t next = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (places[i] < kBehind) next = std::max<std::int64_t>(next, objects[i].id + 1);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (places[i] < kBehind) continue;
    objects[i].id = static_cast<int>(std::min(next + places[i] - kBehind, kLargestId));
  }
}

}  // namespace

/// What was read so far; `object_places` and `plane_places` say the order of the map's lists.
struct SmapReader::Collected {
  const ClassTable& table;
  const std::vector<ClassId>& ids;
  const Region& region;
  MapRead read;
  std::vector<std::int64_t> object_places = {}, plane_places = {};
};

ObjectMap clipped(ObjectMap map, const Region& region) {
  std::erase_if(map.objects, [&](const MapObject& object) {
    return !region.contains(place(object.model).head<2>());
  });
  std::erase_if(map.ground,
                [&](const GroundPlane& plane) { return !region.contains(plane.point.head<2>()); });
  return map;
}

SmapReader::SmapReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {
  in_.seekg(0, std::ios::end);
  const std::streamoff end = in_.tellg();
  if (!in_ || end < 0) throw Error(fmt::format("cannot read {}", name_));
  size_ = static_cast<std::size_t>(end);
  read_heads();
}

std::string SmapReader::bytes_at(std::size_t at, std::size_t count) {
  if (at > size_ || count > size_ - at) {
    throw Error(fmt::format("{} bytes, too few (cut?)", size_));
  }
  std::string bytes(count, '\0');
  in_.seekg(static_cast<std::streamoff>(at));
  if (!in_.read(bytes.data(), static_cast<std::streamsize>(count))) {
    in_.clear();
    throw Error("cannot be read");
  }
  return bytes;
}

std::string SmapReader::content_at(std::size_t at, std::size_t count) {
  const std::string frame = bytes_at(at, count);
  if (const std::uint32_t version = version_of(frame); version != kSmapVersion) {
    throw Error(fmt::format(".smap version {}, expected 1 or {}", version, kSmapVersion));
  }
  return std::string(content_of(frame));
}

void SmapReader::read_heads() {
  std::string front, fault;
  try {
    const std::size_t count = bytes_of(bytes_at(0, std::min(size_, kFrameBytes)));
    front = content_at(0, count);
    head_ = unpack_head(front);
    begin_ = count;
  } catch (const Error& error) {
    fault = error.what();
  }
  try {
    const std::size_t count = word_at(bytes_at(size_ - kWord, kWord), 0);
    const std::string back = content_at(size_ - kWord - count, count);
    if (fault.empty() && back != front) throw Error("not the one at its front");
    if (fault.empty()) return;
    head_ = unpack_head(back);
    begin_ = count;
    damage_.push_back(fmt::format("{}: its head: {}; the copy at its end was read", name_, fault));
  } catch (const Error& error) {
    if (!fault.empty()) throw Error(fmt::format("{}: {}", name_, fault));
    damage_.push_back(fmt::format("{}: the copy of its head at its end: {}", name_, error.what()));
  }
}

/// Without its checksum.
std::string SmapReader::part_at(std::size_t at, std::int64_t count) {
  if (count < static_cast<std::int64_t>(kWord)) throw Error("no checksum");
  std::string bytes = bytes_at(at, static_cast<std::size_t>(count));
  const std::uint32_t expected = word_at(bytes, 0);
  bytes.erase(0, kWord);
  if (checksum(bytes) != expected) throw Error("wrong checksum");
  return bytes;
}

MapRead SmapReader::read(const ClassTable& table, const Region& region) {
  std::vector<ClassId> ids;
  try {
    ids = ids_of(head_.classes, table);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name_, error.what()));
  }
  Collected all{table, ids, region, {}};
  all.read.map.frame = head_.frame;
  all.read.damage = damage_;
  all.read.map.objects.reserve(std::min(expected_objects(region), size_ / kLeastBytesOfAnObject));
  std::size_t at = begin_;
  std::int64_t objects_before = 0;
  for (const SmapTile& tile : head_.tiles) {
    if (region.intersects(tile.extent(head_.steps))) read_tile(tile, at, objects_before, all);
    at += static_cast<std::size_t>(tile.bytes());
    objects_before += tile.objects;
  }
  number_the_others(all.object_places, all.read.map.objects);
  sort_by(all.object_places, all.read.map.objects);
  sort_by(all.plane_places, all.read.map.ground);
  return std::move(all.read);
}

std::size_t SmapReader::expected_objects(const Region& region) const {
  std::size_t count = 0;
  for (const SmapTile& tile : head_.tiles) {
    if (region.intersects(tile.extent(head_.steps)))
      count += static_cast<std::size_t>(tile.objects);
  }
  return count;
}

/// Runs `read`; what it throws becomes a line that says what is lost.
template <class Read>
bool SmapReader::guarded(const SmapTile& tile, const std::string& loss, Collected& all, Read read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    const Region extent = tile.extent(head_.steps);
    all.read.damage.push_back(
        fmt::format("{}: tile of x {:.0f} … {:.0f} m, y {:.0f} … {:.0f} m: {}; {} lost", name_,
                    extent.min().x(), extent.max().x(), extent.min().y(), extent.max().y(),
                    error.what(), loss));
    return false;
  }
}

void SmapReader::read_tile(const SmapTile& tile, std::size_t begin, std::int64_t objects_before,
                           Collected& all) {
  ++all.read.tiles_decoded;
  std::vector<Listed<MapObject>> objects;
  const bool whole = guarded(tile, fmt::format("{} objects", tile.objects), all,
                             [&] { objects = objects_at(tile, begin, objects_before, all); });
  std::size_t at = begin + static_cast<std::size_t>(tile.geometry_bytes);
  guarded(tile, fmt::format("{} ground planes", tile.planes), all, [&] {
    if (tile.planes == 0) return;
    const auto count = static_cast<std::size_t>(tile.planes);
    for (const auto& [place, plane] : unpack_ground(part_at(at, tile.ground_bytes), count)) {
      if (!all.region.contains(plane.point.head<2>())) continue;
      all.plane_places.push_back(place);
      all.read.map.ground.push_back(plane);
    }
  });
  at += static_cast<std::size_t>(tile.ground_bytes);
  if (whole && tile.detail_bytes > 0) {
    const std::string loss = fmt::format("details of {} objects", tile.objects);
    const bool exact = guarded(tile, loss, all, [&] {
      unpack_details(part_at(at, tile.detail_bytes), all.table, objects);
    });
    if (!exact) objects = objects_at(tile, begin, objects_before, all);
  }
  for (auto& [place_in_list, object] : objects) {
    if (!all.region.contains(place(object.model).head<2>())) continue;
    all.object_places.push_back(place_in_list);
    all.read.map.objects.push_back(std::move(object));
  }
}

std::vector<Listed<MapObject>> SmapReader::objects_at(const SmapTile& tile, std::size_t at,
                                                      std::int64_t objects_before,
                                                      const Collected& all) {
  std::vector<Listed<MapObject>> objects;
  if (tile.objects == 0) return objects;
  objects.reserve(static_cast<std::size_t>(tile.objects));
  for (const CoarseObject& coarse :
       unpack_geometry(part_at(at, tile.geometry_bytes), tile, head_)) {
    const auto listed = static_cast<std::int64_t>(objects.size());
    auto& [place_in_list, object] = objects.emplace_back();
    place_in_list = kBehind + objects_before + listed;
    const auto class_place = static_cast<std::size_t>(coarse.object_class);
    object.class_id = all.ids[class_place];
    object.model = model_of(coarse, head_.classes[class_place].shape, head_.steps);
    object.class_probability =
        spread(probability_of(coarse, head_.steps), object.class_id, all.table);
  }
  return objects;
}

}  // namespace saker::objects
