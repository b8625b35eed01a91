#pragma once

#include <map>
#include <optional>
#include <vector>

#include "flight/bus/channels.h"
#include "saker/objects/measurement.h"
#include "saker/objects/object_map.h"

/// Objects ↔ `_OBJECTS` and `_DETECTIONS`: what people on the ground look at, one datagram each. Of
/// a covariance only standard deviations travel, of the class probabilities only the largest; a
/// whole map travels as `_EXCHANGE`.
namespace saker::flight {

/// Nothing where it is no object.
[[nodiscard]] map_object_t to_lcm(const objects::MapObject& object);
/// \param classes  entries of the class table; what is not the class's probability is shared by the
/// others.
[[nodiscard]] std::optional<objects::MapObject> from_lcm(const map_object_t& message, int classes);

/// Nearest first, as many as fit.
[[nodiscard]] detections_t to_lcm(const objects::Detections& detections);
/// Ground and covariance are left out.
[[nodiscard]] std::optional<objects::Detections> from_lcm(const detections_t& message, int classes);

/// Chooses what to send of a map that grows: what is gone, then what changed, then what was not
/// sent for longest, so that a listener that came late or lost some has the whole map after a
/// while.
class MapSender {
 public:
  [[nodiscard]] object_map_t next(const objects::ObjectMap& map, Time now);

 private:
  struct Sent {
    long cycle = 0;  // when it was last sent; 0: never
    int observations = 0;
    int farewells = 0;  // how often it was said to be gone
  };

  std::map<int, Sent> sent_;  // by id; as long as the map, and those that are going
  long cycle_ = 0;
};

/// The map as a listener has it: merges a message. At most `most` objects are kept; false when the
/// message is wrong or there was no room.
bool merge(const object_map_t& message, int classes, std::size_t most, objects::ObjectMap& map);

}  // namespace saker::flight
