#include "tools/saker/mission/team_survey.h"

namespace saker::tools {

slam::PosePrior surveyed(const SE3& T_base_world, const autonomy::SurveyConfig& config,
                         core::Rng rng) {
  const Matrix6d covariance = autonomy::covariance_of(config);
  const Vector6d sd = covariance.diagonal().cwiseSqrt();
  Vector6d error;
  // The level's error is the robot's own, in its `world`: the survey adds none.
  error << 0, 0, rng.normal(0, sd[2]), rng.normal(0, sd[3]), rng.normal(0, sd[4]),
      rng.normal(0, sd[5]);
  return {T_base_world * core::se3_exp(error), covariance};
}

}  // namespace saker::tools
