#pragma once

#include <array>

#include "detection/footprint.h"
#include "detection/interval.h"
#include "detection/vehicle.h"

namespace saker::detection {

/// The places that do not stand out of a face that was looked at, by more than `stands_out_m`: what
/// does is not the vehicle's, or a mirror. Of a face that nobody looked at, what stands out may be
/// all that was seen.
[[nodiscard]] std::vector<Eigen::Vector2d> within(const Footprint& footprint,
                                                  const std::vector<Eigen::Vector2d>& places,
                                                  const Sight& sight, const VehicleConfig& config);

/// The footprint with each edge where it likely is. Of a face that no sensor looked at, what stands
/// out farthest; seen over the vehicle that is its upper edge, some way back from the lower part.
[[nodiscard]] Footprint as_seen(const Footprint& footprint, const Sight& sight,
                                const SetbackConfig& config);

struct FootprintEdge : Edge {
  double hidden_m = 0;  ///< beyond its noise it may lie farther out; infinite: nothing tells
};

using Edges = std::array<std::array<FootprintEdge, 2>, 2>;  ///< [axis][low, high]

/// Whether beams went through what a vehicle fills: its inner part, or what lies just behind the
/// middle of a side that was looked at, where two that stand beside each other show their ends and
/// nothing of their depth. The footprint's first axis is the length.
[[nodiscard]] bool parted(const Footprint& footprint, const Sight& sight,
                          const VehicleConfig& config);

/// Where the edges of a footprint whose first axis is the length are, and how well that is known.
/// What hides an edge, or loses its points, only takes away: that the vehicle ends there is seen by
/// beams that went through where it would go on. An end that no sensor looked at is hidden behind
/// the roof: it lies in the shadow between what was seen and where beams went through, a front
/// farther out than a tail. Sides are as wide as the roof, whose edge is seen.
/// \param tops of what was seen of the low and the high end of the first axis, m above the ground
[[nodiscard]] Edges edges_of(const Footprint& footprint, const std::array<double, 2>& tops,
                             const Sight& sight, const VehicleNoiseConfig& noise);

}  // namespace saker::detection
