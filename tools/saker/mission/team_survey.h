#pragma once

#include "saker/autonomy/team_config.h"
#include "saker/core/rng.h"

namespace saker::tools {

/// Where a robot took off, in base, as surveyed: wrong as far as the configuration says.
/// \param T_base_world as it is
[[nodiscard]] slam::PosePrior surveyed(const SE3& T_base_world,
                                       const autonomy::SurveyConfig& config, core::Rng rng);

}  // namespace saker::tools
