#include "saker/odometry/inertial_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "made_imu.h"
#include "made_world.h"
#include "saker/core/rng.h"

namespace saker::odometry {
namespace {

using testing::kUp;
using testing::reading;
using testing::steady;

const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

InertialFilter started(const SE3& T = SE3::Identity(), const Eigen::Vector3d& velocity = kStill,
                       double velocity_sd = 0, const InertialConfig& config = {}) {
  InertialFilter filter(config);
  filter.start(0, T, Matrix6d::Zero(), velocity, velocity_sd);
  return filter;
}

/// A unit that knows its biases.
InertialConfig exact() {
  InertialConfig config;
  config.initial_rate_bias_rps = 1e-6;
  config.initial_acceleration_bias_mps2 = 1e-5;
  config.rate_bias_walk = config.acceleration_bias_walk = 0;
  config.rate_noise = 1e-6;
  return config;
}

SE3 at(double x, double y, double z) {
  SE3 T = SE3::Identity();
  T.translation() << x, y, z;
  return T;
}

TEST(InertialFilter, AtRestStaysWhereItIs) {
  const SE3 T = SE3(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  InertialFilter filter = started(T);
  filter.propagate(steady(0, 2, T.linear().transpose() * kUp), from_seconds(2));
  EXPECT_LT(filter.T_odom_lidar().translation().norm(), 1e-9);
  EXPECT_TRUE(filter.T_odom_lidar().linear().isApprox(T.linear(), 1e-9));
  EXPECT_LT(filter.velocity().norm(), 1e-9);
}

TEST(InertialFilter, UnderASteadyAccelerationCoversHalfOfItsSquareOfTime) {
  const Eigen::Vector3d acceleration(1, -0.5, 0.2), velocity(3, 0, 1);
  InertialFilter filter = started(SE3::Identity(), velocity);
  filter.propagate(steady(0, 2, kUp + acceleration), from_seconds(2));
  EXPECT_LT((filter.velocity() - velocity - 2 * acceleration).norm(), 1e-6);
  EXPECT_LT((filter.T_odom_lidar().translation() - 2 * velocity - 2 * acceleration).norm(), 1e-6);
}

TEST(InertialFilter, FollowsAFlightByItsReadings) {
  const Time begin = from_seconds(1), end = from_seconds(3);
  InertialFilter filter({});
  const SE3 first = testing::weaving(begin);
  const Eigen::Vector3d velocity = (testing::weaving(begin + 1'000'000).translation() -
                                    testing::weaving(begin - 1'000'000).translation()) /
                                   2e-3;
  filter.start(begin, first, Matrix6d::Zero(), velocity, 0.01);
  filter.propagate(testing::imu(testing::weaving, begin, end, kStill), end);
  const SE3 error = testing::weaving(end).inverse() * filter.T_odom_lidar();
  EXPECT_LT(error.translation().norm(), 0.05);
  EXPECT_LT(core::so3_log(error.linear()).norm(), 0.003);
}

TEST(InertialFilter, EndsBetweenTwoSamplesWhereItWasAsked) {
  InertialFilter filter = started();
  filter.propagate(steady(0, 1, kUp, {0, 0, 0.5}), from_seconds(0.555));
  EXPECT_EQ(filter.stamp(), from_seconds(0.555));
  EXPECT_NEAR(core::yaw(filter.T_odom_lidar().linear()), 0.5 * 0.555, 1e-9);
}

TEST(InertialFilter, SamplesThatAreOldOrNotFiniteChangeNothing) {
  InertialFilter filter = started();
  filter.propagate(steady(0, 0.1), from_seconds(0.1));
  const Matrix15d before = filter.covariance();
  filter.propagate(reading(0.05, 9 * kUp, kStill));
  filter.propagate(reading(0.2, Eigen::Vector3d::Constant(NAN), kStill));
  filter.propagate(reading(0.2, kUp, Eigen::Vector3d::Constant(INFINITY)));
  EXPECT_EQ(filter.stamp(), from_seconds(0.1));
  EXPECT_EQ(filter.covariance(), before);
}

TEST(InertialFilter, CovarianceIsSymmetricAndNotNegative) {
  InertialFilter filter = started(SE3::Identity(), {2, 1, 0}, 0.5);
  filter.propagate(steady(0, 3, kUp + Eigen::Vector3d(1, 0, 0), {0.1, 0.2, 0.4}), from_seconds(3));
  const Matrix15d P = filter.covariance();
  EXPECT_LT((P - P.transpose()).norm(), 1e-9 * P.norm());
  EXPECT_GT(P.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
}

TEST(InertialFilter, NoiseOfTheAccelerometerGrowsAsItsIntegrals) {
  const InertialConfig config = exact();
  InertialFilter filter = started(SE3::Identity(), kStill, 0, config);
  filter.propagate(steady(0, 4), from_seconds(4));
  const double density = config.acceleration_noise * config.acceleration_noise;
  EXPECT_NEAR(filter.covariance()(6, 6), density * 4, 0.01 * density * 4);
  EXPECT_NEAR(filter.covariance()(3, 3), density * 64 / 3, 0.01 * density * 64 / 3);
  EXPECT_NEAR(filter.covariance()(3, 6), density * 16 / 2, 0.01 * density * 8);
}

TEST(InertialFilter, AnUnknownTiltMovesItSidewaysAsGravityLeaks) {
  InertialFilter filter(exact());
  Matrix6d tilt = Matrix6d::Zero();
  tilt(0, 0) = 0.01 * 0.01;
  filter.start(0, SE3::Identity(), tilt, kStill, 0);
  filter.propagate(steady(0, 1), from_seconds(1));
  EXPECT_NEAR(std::sqrt(filter.covariance()(7, 7)), 0.01 * 9.80665, 0.005);
  EXPECT_NEAR(std::sqrt(filter.covariance()(4, 4)), 0.005 * 9.80665, 0.005);
}

TEST(InertialFilter, LearnsTheVelocityFromTheNextPlace) {
  InertialFilter filter = started(SE3::Identity(), kStill, 5);
  filter.propagate(steady(0, 0.5), from_seconds(0.5));
  EXPECT_LT((filter.velocity_at(at(1, 0.5, 0)) - Eigen::Vector3d(2, 1, 0)).norm(), 0.05);
  filter.condition(at(1, 0.5, 0), 1e-6 * Matrix6d::Identity());
  EXPECT_LT((filter.velocity() - Eigen::Vector3d(2, 1, 0)).norm(), 0.05);
  EXPECT_LT(std::sqrt(filter.covariance()(6, 6)), 0.2);
}

TEST(InertialFilter, LearnsTheBiasOfTheGyroscopeAtRest) {
  const Eigen::Vector3d bias(0.01, -0.005, 0.015);
  InertialFilter filter = started();
  for (int i = 0; i < 40; ++i) {
    filter.propagate(steady(0.1 * i, 0.1 * (i + 1), kUp, bias), from_seconds(0.1 * (i + 1)));
    filter.correct(SE3::Identity(), 1e-6 * Matrix6d::Identity());
  }
  EXPECT_LT((filter.rate_bias() - bias).norm(), 0.002);
  EXPECT_LT(filter.rate().norm(), 0.002);
  EXPECT_LT(std::sqrt(filter.covariance()(9, 9)), 0.005);
}

TEST(InertialFilter, ConditionedPoseIsTheOneGivenWithItsCovariance) {
  InertialFilter filter = started(SE3::Identity(), {1, 0, 0}, 1);
  filter.propagate(steady(0, 0.2), from_seconds(0.2));
  const Matrix6d covariance = 4e-4 * Matrix6d::Identity();
  filter.condition(at(0.25, 0, 0), covariance);
  EXPECT_TRUE(filter.T_odom_lidar().isApprox(at(0.25, 0, 0)));
  EXPECT_TRUE(filter.pose_covariance().isApprox(covariance, 1e-6));
}

TEST(InertialFilter, CorrectionLiesBetweenPredictionAndMeasurementByTheirVariances) {
  InertialFilter filter(exact());
  filter.start(0, at(0, 0, 0), 0.04 * Matrix6d::Identity(), kStill, 0);
  filter.correct(at(0.5, 0, 0), 0.01 * Matrix6d::Identity());
  EXPECT_NEAR(filter.T_odom_lidar().translation().x(), 0.4, 1e-9);
  EXPECT_NEAR(filter.pose_covariance()(3, 3), 0.04 * 0.01 / 0.05, 1e-9);
}

TEST(InertialFilter, AJumpOfTheFrameLeavesTheBodysVelocity) {
  InertialFilter filter = started(SE3::Identity(), {3, 0, 0}, 0.1);
  filter.propagate(steady(0, 0.1), from_seconds(0.1));
  const Eigen::Vector3d in_body = filter.T_odom_lidar().linear().transpose() * filter.velocity();
  SE3 T = at(10, 20, 0);
  T.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  filter.jump(T, 0.01 * Matrix6d::Identity());
  EXPECT_LT((T.linear().transpose() * filter.velocity() - in_body).norm(), 1e-9);
  EXPECT_NEAR(filter.velocity().y(), 3, 1e-3);
  EXPECT_TRUE(filter.pose_covariance().isApprox(0.01 * Matrix6d::Identity()));
}

TEST(InertialFilter, AFixedPoseIsExactAndLeavesTheRest) {
  InertialFilter filter = started(SE3::Identity(), kStill, 0.3);
  filter.propagate(steady(0, 0.5), from_seconds(0.5));
  const double velocity = filter.covariance()(6, 6);
  filter.fix_pose();
  EXPECT_TRUE(filter.pose_covariance().isZero());
  EXPECT_EQ(filter.covariance()(6, 6), velocity);
}

TEST(InertialFilter, OverAGapItGoesOnStraightAndKnowsLittle) {
  const InertialConfig config;
  InertialFilter filter = started(SE3::Identity(), {4, 0, 0}, 0);
  filter.coast(from_seconds(0.5));
  EXPECT_NEAR(filter.T_odom_lidar().translation().x(), 2, 1e-9);
  EXPECT_GE(std::sqrt(filter.covariance()(6, 6)), 0.5 * config.unknown_acceleration_mps2);
  EXPECT_GE(std::sqrt(filter.covariance()(0, 0)), 0.5 * config.unknown_rate_rps);
  EXPECT_NEAR(std::sqrt(filter.covariance()(3, 3)),
              0.25 * config.unknown_acceleration_mps2 / std::sqrt(3.0), 0.01);
}

TEST(InertialFilter, StartedAgainKeepsWhatItKnowsOfTheBiases) {
  InertialFilter filter = started();
  for (int i = 0; i < 20; ++i) {
    filter.propagate(steady(0.1 * i, 0.1 * (i + 1), kUp, {0, 0, 0.02}),
                     from_seconds(0.1 * (i + 1)));
    filter.correct(SE3::Identity(), 1e-6 * Matrix6d::Identity());
  }
  const Eigen::Vector3d bias = filter.rate_bias();
  EXPECT_GT(bias.z(), 0.01);
  filter.start(from_seconds(2), at(1, 2, 3), Matrix6d::Zero(), kStill, 1);
  EXPECT_EQ(filter.rate_bias(), bias);
  EXPECT_LT(std::sqrt(filter.covariance()(11, 11)), 0.01);
  EXPECT_TRUE(filter.pose_covariance().isZero());
}

Matrix6d isotropic(double sd) { return sd * sd * Matrix6d::Identity(); }

TEST(InertialFilter, APlaceThatErrsAsExpectedSurprisesByThree) {
  InertialFilter filter({});
  filter.start(0, at(1, 2, 3), isotropic(0.3), kStill, 0);
  core::Rng rng(1);
  double sum = 0;
  constexpr int kPlaces = 2000;
  for (int i = 0; i < kPlaces; ++i) {
    const SE3 measured = at(1 + rng.normal(0, 0.5), 2 + rng.normal(0, 0.5), 3 + rng.normal(0, 0.5));
    sum += filter.surprise(measured, isotropic(0.4)).square;
  }
  EXPECT_NEAR(sum / kPlaces, 3, 0.2);
}

TEST(InertialFilter, AfterItsDoubtTheStateAllowsForWhatWasSeen) {
  InertialFilter filter({});
  filter.start(0, SE3::Identity(), isotropic(0.1), kStill, 0.2);
  const auto surprise = filter.surprise(at(0.5, 0, 0), isotropic(0.1));
  const double speed_variance = filter.covariance()(6, 6);
  filter.doubt(surprise, isotropic(0.1));
  const double place = filter.pose_covariance().bottomRightCorner<3, 3>().trace();
  EXPECT_NEAR(place, 0.25 - 0.03, 1e-12);
  EXPECT_NEAR(filter.covariance()(6, 6) / speed_variance, place / 0.03, 1e-9);
}

TEST(InertialFilter, DoubtNeverMakesSurerAndHasAnEnd) {
  InertialFilter filter({});
  filter.start(0, SE3::Identity(), isotropic(0.1), kStill, 0.2);
  const Matrix15d before = filter.covariance();
  filter.doubt(filter.surprise(at(0.01, 0, 0), isotropic(0.1)), isotropic(0.1));
  EXPECT_EQ(filter.covariance(), before);
  filter.doubt(filter.surprise(at(1000, 0, 0), isotropic(0.1)), isotropic(0.1));
  EXPECT_TRUE(filter.covariance().isApprox(100 * before));
}

}  // namespace
}  // namespace saker::odometry
