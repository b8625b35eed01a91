#pragma once

#include <array>
#include <vector>

#include "detection/footprint.h"
#include "detection/vehicle.h"

namespace saker::detection {

/// How well each edge of a footprint was looked at, as standard deviations: [axis][low, high].
/// \param top height of the roof, m
[[nodiscard]] std::array<std::array<double, 2>, 2> edge_sds(
    const Footprint& footprint, double top, const std::vector<Eigen::Vector3d>& sensors,
    const VehicleNoiseConfig& noise);

}  // namespace saker::detection
