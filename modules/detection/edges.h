#pragma once

#include <array>

#include "detection/footprint.h"
#include "detection/vehicle.h"

namespace saker::detection {

/// The footprint with each edge where it likely is. Of a face that no sensor looked at, what stands
/// out farthest; seen over the vehicle that is its upper edge, some way back from the lower part.
[[nodiscard]] Footprint as_seen(const Footprint& footprint, const Sight& sight,
                                const SetbackConfig& config);

using EdgeSds = std::array<std::array<double, 2>, 2>;  ///< m, [axis][low, high]

/// How well each edge of a footprint is known. What hides an edge, or loses its points, only takes
/// away: that the vehicle ends there is seen by beams that went through where it would go on.
[[nodiscard]] EdgeSds edge_sds(const Footprint& footprint, const Sight& sight,
                               const VehicleNoiseConfig& noise);

}  // namespace saker::detection
