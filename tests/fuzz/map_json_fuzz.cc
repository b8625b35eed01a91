#include "fuzz.h"
#include "saker/objects/map_io.h"

/// An object map's JSON: what can be read can be written, and read again.
namespace saker {

void lidar::fuzz::run(ByteView input) {
  static const objects::ClassTable table;
  const objects::ObjectMap map = objects::from_json(std::string(text_of(input)), table, "map.json");
  const objects::ObjectMap again =
      objects::from_json(objects::to_json(map, table), table, "again.json");
  expect(again.objects.size() == map.objects.size() && again.ground.size() == map.ground.size());
}

}  // namespace saker
