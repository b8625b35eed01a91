#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "saker/objects/object_map.h"
#include "saker/objects/smap_head.h"

/// The first part of a tile: class, probability and model of its objects in whole steps, as columns
/// in Rice's code. Objects stand in the order of a Morton curve through the tile, so that a place
/// costs no more than the gap to the one before: log2(area an object / step²) + 1.5 bits. Ground
/// heights are differences to the nearest of the objects just before; sizes, tilts and headings
/// stand for themselves.
namespace saker::objects {

/// An object in whole steps. `shape` of a cuboid: length, width, height, heading, two tilts; of a
/// cylinder: radius, height, two tilts.
struct CoarseObject {
  std::int64_t x = 0, y = 0, z = 0;
  std::int64_t object_class = 0, probability = 0;
  std::array<std::int64_t, 6> shape{};
};

/// Throws Error on a model that no file can hold: not finite, too far, too large, or of another
/// shape than its class has.
[[nodiscard]] CoarseObject coarse(const MapObject& object, const ClassTable& table,
                                  const SmapSteps& steps);

/// The tile that a place lies in (both coordinates in steps of position).
[[nodiscard]] inline std::int64_t tile_of(std::int64_t place, const SmapSteps& steps) {
  return place >> steps.tile_bits;
}

/// Place along the Morton curve: the bits of both, interleaved. 32 bits of each count.
[[nodiscard]] std::uint64_t morton(std::int64_t x, std::int64_t y);

/// \param objects of one tile, along the curve
[[nodiscard]] std::string pack_geometry(std::span<const CoarseObject> objects,
                                        std::span<const SmapClass> classes, const SmapSteps& steps);

/// Throws Error on everything that is no valid object.
[[nodiscard]] std::vector<CoarseObject> unpack_geometry(std::string bytes, const SmapTile& tile,
                                                        const SmapHead& head);

[[nodiscard]] double probability_of(const CoarseObject& object, const SmapSteps& steps);

/// Throws Error where the model is too far or too large.
[[nodiscard]] Model model_of(const CoarseObject& object, Shape shape, const SmapSteps& steps);

}  // namespace saker::objects
