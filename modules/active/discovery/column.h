#pragma once

#include <Eigen/Core>

#include "saker/active/views/occupancy_view.h"
#include "saker/objects/object_map.h"

/// What stands on the ground at a place.
///
/// Reads the map (objects and local ground, `world`) and the occupancy block (`odom`). Method: the
/// cells at three heights that any vehicle fills. Cost: linear in the mapped objects.
namespace saker::active {

enum class Standing {
  unknown,
  nothing,    ///< free up to a vehicle's height
  something,  ///< occupied, by nothing that is mapped
  mapped,     ///< a mapped object
};

/// Height of the ground there, `world`, m: of the nearest mapped local ground; without any that of
/// the place of take-off, 0.
[[nodiscard]] double ground_height(const objects::ObjectMap* map, const Eigen::Vector2d& place);

/// \param place of a column, `world`; \param map null: none yet.
[[nodiscard]] Standing standing_at(const Eigen::Vector2d& place, const OccupancyView& block,
                                   const objects::ObjectMap* map);

}  // namespace saker::active
