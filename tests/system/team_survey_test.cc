#include "tools/saker/mission/team_survey.h"

#include <gtest/gtest.h>

namespace saker::tools {
namespace {

TEST(Surveyed, ErrsAsMuchAsItsCovarianceSays) {
  const autonomy::SurveyConfig config{.place_sd_m = 0.2, .heading_sd_deg = 3};
  SE3 T_base_world = SE3::Identity();
  T_base_world.translation() = Eigen::Vector3d(4, -2, 1);
  T_base_world.rotate(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()));
  constexpr int kTries = 2000;
  double nees = 0;
  for (int i = 0; i < kTries; ++i) {
    const slam::PosePrior prior = surveyed(T_base_world, config, core::Rng(7).fork(i));
    const Vector6d error = core::se3_log(prior.pose.inverse() * T_base_world);
    EXPECT_NEAR(error.head<2>().norm(), 0, 1e-9);
    nees += error.tail<4>().cwiseAbs2().cwiseQuotient(prior.covariance.diagonal().tail<4>()).sum();
  }
  EXPECT_NEAR(nees / (4 * kTries), 1, 0.1);
}

}  // namespace
}  // namespace saker::tools
