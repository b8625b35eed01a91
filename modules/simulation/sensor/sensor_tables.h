#pragma once

#include "saker/simulation/sensor/sensor_model.h"

namespace saker::simulation {

/// `count` beams evenly from `highest` down to `lowest`.
[[nodiscard]] std::vector<BeamAngle> even_beams(int count, double highest_deg, double lowest_deg);

/// The published angles, the highest beam first.
[[nodiscard]] std::vector<BeamAngle> hdl64_angles();
[[nodiscard]] std::vector<BeamAngle> vlp32c_angles();
[[nodiscard]] std::vector<BeamAngle> vls128_angles();
[[nodiscard]] std::vector<BeamAngle> pandar40_angles();
[[nodiscard]] std::vector<BeamAngle> pandar40p_angles();
[[nodiscard]] std::vector<BeamAngle> pandar64_angles();
[[nodiscard]] std::vector<BeamAngle> pandar128_angles();
[[nodiscard]] std::vector<BeamAngle> qt64_angles();

}  // namespace saker::simulation
