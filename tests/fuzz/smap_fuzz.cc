#include <algorithm>
#include <sstream>

#include "fuzz.h"
#include "saker/objects/map_io.h"
#include "saker/objects/smap_geometry.h"

/// A `.smap` as a whole, both versions, and a part of it; then what is behind its check sums: the
/// first byte chooses which part the rest is.
namespace saker {
namespace {

using namespace objects;
using lidar::fuzz::expect;

const ClassTable kTable;

void read_whole(const std::string& bytes) {
  const ObjectMap map = from_smap(bytes, kTable, "map.smap");
  const ObjectMap again = from_smap(to_smap(map, kTable), kTable, "again.smap");
  expect(again.objects.size() == map.objects.size() && again.ground.size() == map.ground.size());
}

void read_part(const std::string& bytes) {
  std::istringstream in(bytes);
  SmapReader reader(in, "map.smap");
  const Region region(Eigen::Vector2d(-10, -10), Eigen::Vector2d(10, 10));
  for (const MapObject& object : reader.read(kTable, region).map.objects) {
    expect(region.contains(place(object.model).head<2>()));
  }
}

SmapHead made_head() {
  SmapHead head;
  head.frame = "world";
  for (const ObjectClass& c : kTable.classes) head.classes.push_back({c.name, c.shape});
  return head;
}

void read_tile(const std::string& bytes, std::int64_t objects) {
  SmapTile tile;
  tile.objects = objects;
  tile.geometry_bytes = static_cast<std::int64_t>(bytes.size());
  const SmapHead head = made_head();
  for (const CoarseObject& object : unpack_geometry(bytes, tile, head)) {
    const Shape shape = head.classes.at(static_cast<std::size_t>(object.object_class)).shape;
    (void)model_of(object, shape, head.steps);
  }
}

/// Of objects that the geometry gave: a cuboid and a cylinder in turns.
void read_details(const std::string& bytes, std::size_t count) {
  std::vector<Listed<MapObject>> listed(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool cylinder = i % 2 != 0;
    if (cylinder) listed[i].value.model = Cylinder{{1, 2, 3}, {0, 0, 1}, 0.2, 5};
    const auto shaped = std::ranges::find(
        kTable.classes, cylinder ? Shape::cylinder : Shape::cuboid, &ObjectClass::shape);
    listed[i].value.class_id = static_cast<ClassId>(shaped - kTable.classes.begin());
  }
  unpack_details(bytes, kTable, listed);
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  Cursor cursor(input);
  const auto which = cursor.number<std::uint8_t>();
  const std::string bytes(text_of(cursor.take_at_most(input.size())));
  const int count = which / 8;
  switch (which % 8) {
    case 0:
      return read_whole(bytes);
    case 1:
      return read_part(bytes);
    case 2:
      return (void)unpack_head(bytes);
    case 3:
      return (void)unpack_ground(bytes, static_cast<std::size_t>(count));
    case 4:
      return read_details(bytes, static_cast<std::size_t>(count));
    case 5:
      return read_whole(framed(1, bytes));
    default:
      return read_tile(bytes, count);
  }
}

}  // namespace saker
