#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "saker/lidar/beam_sharpness.h"

namespace saker::lidar {

struct RingCones {
  SensorPose pose;   ///< about which each ring is a cone
  float spread = 0;  ///< median distance of sines of elevation from their ring's mean
};

/// Gauss-Newton on the points' sines of elevation, less their ring's mean, with Cauchy's weights,
/// from 36 starts (x ±1, z −2.5 … 3 m). Cost: 0.05 s.
/// \param rings  ring number of each point, in any order of height
/// \return nothing where the rings are not thin about any pose, or not much thinner than about the
///         recording's own origin
[[nodiscard]] std::optional<RingCones> fit_ring_cones(const std::vector<Eigen::Vector3f>& points,
                                                      const std::vector<std::uint16_t>& rings);

}  // namespace saker::lidar
