#pragma once

#include <Eigen/Geometry>

#include "saker/core/config.h"
#include "saker/motion/clearance.h"
#include "saker/motion/trajectory.h"
#include "saker/occupancy/grid.h"

namespace saker::motion {

struct VerdictConfig {
  double step_m = 0.05;
  double clearance_reach_m = 3;
  int max_samples = 20000;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("step_m", step_m, {0.005, 0.05}, "m",
            "between looks along a trajectory: a fifth of a cell sees every corner");
    v.field("clearance_reach_m", clearance_reach_m, {0.5, 20}, "m",
            "greater clearances read as it");
    v.field("max_samples", max_samples, {100, 1e6}, "",
            "looks at one trajectory, 1 km at 5 cm; what comes after is not cleared");
  }
};

/// The box of everything between `now` and the end of a trajectory that is not empty.
[[nodiscard]] Eigen::AlignedBox3d remaining_box(const Trajectory& trajectory, Time now);

/// Whether the rest of a trajectory may be flown: from `now` to its end, the body keeps radius and
/// margin from every cell that is occupied, and from every one that was never seen and is not
/// exempt; what is outside of the grid was never seen.
///
/// Distances are exact, to the surfaces of cells. Where the vehicle, or the trajectory at `now`, is
/// nearer than the margin already, the body keeps the radius alone within the vehicle's ball, and
/// from cells that are nearer than that what there is (ClearanceConfig::leaving_m), so that it can
/// leave. Frames: all `odom`. Cost: some µs a sample of 5 cm, and a distance field of the grid.
/// Never throws.
/// \param grid the map around `remaining_box`
[[nodiscard]] Verdict check(const Trajectory& trajectory, Time now,
                            const occupancy::OccupancyGrid& grid, const Exemption& exemption,
                            const ClearanceConfig& clearance, const VerdictConfig& config);

}  // namespace saker::motion
