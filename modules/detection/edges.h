#pragma once

#include <array>

#include "detection/footprint.h"
#include "detection/vehicle.h"

namespace saker::detection {

using EdgeSds = std::array<std::array<double, 2>, 2>;  ///< m, [axis][low, high]

/// How well each edge of a footprint is known. What hides an edge, or loses its points, only takes
/// away: that the vehicle ends there is seen by beams that went through where it would go on.
[[nodiscard]] EdgeSds edge_sds(const Footprint& footprint, const Sight& sight,
                               const VehicleNoiseConfig& noise);

}  // namespace saker::detection
