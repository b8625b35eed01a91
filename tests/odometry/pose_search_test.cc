#include "saker/odometry/pose_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_world.h"
#include "saker/core/error.h"

namespace saker::odometry {
namespace {

/// A map of the street as seen from its origin, and the points of a scan taken there.
struct Seen {
  VoxelMap map{VoxelMapConfig{}};
  std::vector<Eigen::Vector3d> points;
};

Seen street_seen() {
  const testing::Motion still = [](Time) {
    SE3 T = SE3::Identity();
    T.translation().z() = 2;
    return T;
  };
  Seen seen;
  testing::MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  for (int i = 1; i <= 5; ++i) {
    const lidar::Scan scan = testing::scan(testing::street(), sensor, still, i * 100'000'000);
    seen.points.clear();
    for (const Eigen::Vector3f& p : scan.points)
      if (p.allFinite()) seen.points.push_back(p.cast<double>());
    seen.map.insert(seen.points, scan.stamp);
  }
  return seen;
}

PosePrior prior_at(const Eigen::Vector3d& place, double heading, double sd_m, double sd_rad) {
  PosePrior prior;
  prior.T_odom_lidar.translation() = place;
  prior.T_odom_lidar.linear() =
      Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(sd_rad * sd_rad), Eigen::Vector3d::Constant(sd_m * sd_m);
  variance.head<2>().setConstant(1e-6);
  variance[5] = std::min(variance[5], 0.01);  // heights are known better
  prior.covariance = variance.asDiagonal();
  return prior;
}

TEST(PoseSearch, IsWorthwhileWhereThePriorLeavesMoreOpenThanAStep) {
  const PoseSearchConfig config;
  const PoseSearch search(config);
  const double enough_m = 1.1 * config.step_m / config.reach_sd;
  const double enough_rad = 1.1 * config.step_rad / config.reach_sd;
  EXPECT_FALSE(search.worthwhile(prior_at({0, 0, 0}, 0, 0.05, 0.001)));
  EXPECT_TRUE(search.worthwhile(prior_at({0, 0, 0}, 0, enough_m, 0.001)));
  EXPECT_TRUE(search.worthwhile(prior_at({0, 0, 0}, 0, 0.05, enough_rad)));
}

TEST(PoseSearch, CoversAPriorThatLeavesNoMoreOpenThanItsLimits) {
  const PoseSearchConfig config;
  const PoseSearch search(config);
  const double most_m = config.most_m / config.reach_sd,
               most_rad = config.most_rad / config.reach_sd;
  EXPECT_TRUE(search.covers(prior_at({0, 0, 0}, 0, 0.9 * most_m, 0.9 * most_rad)));
  EXPECT_FALSE(search.covers(prior_at({0, 0, 0}, 0, 1.1 * most_m, 0.01)));
  EXPECT_FALSE(search.covers(prior_at({0, 0, 0}, 0, 0.1, 1.1 * most_rad)));
}

TEST(PoseSearch, OneOfTheStartsIsNearTheTruthWhereThePriorIsMetresOff) {
  Seen seen = street_seen();
  const PoseSearch search({});
  for (const auto& [off, heading] : {std::pair{Eigen::Vector3d(1.3, -0.7, 0.1), 0.0},
                                     std::pair{Eigen::Vector3d(-2, 1, 0), 0.1}}) {
    const auto starts = search.starts(seen.points, prior_at(off, heading, 1.2, 0.05), seen.map);
    const bool near = std::any_of(starts.begin(), starts.end(), [](const SE3& T) {
      return T.translation().norm() < 0.7 && core::so3_log(T.linear()).norm() < 0.08;
    });
    EXPECT_TRUE(near) << off.transpose();
  }
}

TEST(PoseSearch, NoMoreStartsThanAreKeptAndNoneNextToAnother) {
  Seen seen = street_seen();
  PoseSearchConfig config;
  config.kept = 3;
  const auto starts =
      PoseSearch(config).starts(seen.points, prior_at({1, 0, 0}, 0, 1, 0.001), seen.map);
  ASSERT_EQ(starts.size(), 3U);
  for (std::size_t a = 0; a < starts.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT((starts[a].translation() - starts[b].translation()).cwiseAbs().maxCoeff(),
                1.5 * config.step_m);
}

TEST(PoseSearch, AHugeUncertaintyIsSearchedWithinTheLimits) {
  Seen seen = street_seen();
  PoseSearchConfig config;
  config.most_poses = 200;
  config.points = 50;
  for (const SE3& start :
       PoseSearch(config).starts(seen.points, prior_at({0, 0, 0}, 0, 1e4, 3), seen.map)) {
    EXPECT_LT(start.translation().cwiseAbs().maxCoeff(), 2 * config.most_m);
  }
}

TEST(PoseSearch, NoPointsGiveNoBetterPlace) {
  VoxelMap empty{VoxelMapConfig{}};
  EXPECT_NO_THROW((void)PoseSearch({}).starts({}, prior_at({0, 0, 0}, 0, 1, 0.1), empty));
}

}  // namespace
}  // namespace saker::odometry
