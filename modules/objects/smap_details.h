#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "saker/objects/object_map.h"

/// The other parts of a tile, in Rice's code as well: what a map's JSON says to six decimals.
/// Ground planes; and of its objects, in the order of the geometry, place in the list of the map,
/// identity, history (observations, returns), exact class probability and model, and covariance.
namespace saker::objects {

/// Something of a map and its place in the map's list.
template <class T>
struct Listed {
  std::int64_t place = 0;
  T value;
};

[[nodiscard]] std::string pack_ground(std::span<const Listed<GroundPlane>> planes);
[[nodiscard]] std::vector<Listed<GroundPlane>> unpack_ground(std::string bytes, std::size_t count);

[[nodiscard]] std::string pack_details(std::span<const Listed<const MapObject*>> objects);

/// Replaces what the geometry said of `objects`. Throws Error on everything that is no valid
/// object, and may then have replaced some of it.
void unpack_details(std::string bytes, const ClassTable& table,
                    std::span<Listed<MapObject>> objects);

}  // namespace saker::objects
