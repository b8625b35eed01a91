#pragma once

#include "saker/core/text.h"
#include "saker/motion/clearance.h"
#include "saker/occupancy/grid.h"

namespace saker::autonomy {

/// Whether the way straight up is free — reads a block of occupancy (from the collision checker),
/// makes what the take-off waits for.
///
/// Frame: `odom`. The column is as wide as the vehicle and a cell, from above its body to above the
/// height it climbs to. A cell that was never seen is free where the exemption's column over the
/// take-off point states so (motion.clearance.takeoff_radius_m, takeoff_height_m), and nowhere
/// else; one that is occupied is not free, whatever is stated.
struct TakeoffColumn {
  enum class State {
    not_looked,  ///< no block yet
    free,        ///< seen, or stated
    unknown,
    occupied,
  };
  State state = State::not_looked;
  double above_m = NAN;  ///< unknown, occupied: the lowest such cell, over the body's centre

  [[nodiscard]] bool blocked() const { return state > State::free; }
  [[nodiscard]] core::Text text() const;  ///< why it is blocked
};

/// \param body      where it stands; \param height_m  that it climbs
[[nodiscard]] TakeoffColumn look_up(const occupancy::OccupancyGrid& grid,
                                    const Eigen::Vector3d& body, double height_m,
                                    const motion::ClearanceConfig& clearance,
                                    const motion::Exemption& exemption);

}  // namespace saker::autonomy
