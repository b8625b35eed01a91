#include "saker/odometry/motion_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "made_imu.h"
#include "made_world.h"

namespace saker::odometry {
namespace {

using testing::steady;

const Matrix6d kKnown = 1e-6 * Matrix6d::Identity();

SE3 along_x(double x) {
  SE3 T = SE3::Identity();
  T.translation() << x, 0, 0;
  return T;
}

/// Registered at 10 Hz along the motion, without an inertial unit.
MotionModel following(const testing::Motion& motion, int scans) {
  MotionModel model({});
  model.start(0, motion(0));
  for (int i = 1; i <= scans; ++i) {
    const Time now = from_seconds(0.1 * i);
    model.accept(model.predict(now, {}), motion(now), kKnown);
  }
  return model;
}

const testing::Motion kStraight = [](Time t) { return along_x(6 * to_seconds(t)); };

/// A steady twist: forward and to the left.
const testing::Motion kTurning = [](Time t) {
  Vector6d twist;
  twist << 0, 0, 0.8, 5, 0, 0;
  return core::se3_exp(twist * to_seconds(t));
};

TEST(MotionModel, AtFirstExpectsNoMotionAndAnySpeed) {
  MotionModel model({});
  model.start(0, along_x(3));
  const Prediction prediction = model.predict(from_seconds(0.1), {});
  EXPECT_TRUE(prediction.prior.T_odom_lidar.isApprox(along_x(3)));
  const MotionConfig c;
  EXPECT_NEAR(std::sqrt(prediction.prior.covariance(3, 3)),
              std::hypot(0.1 * c.initial_speed_mps, 0.01 * c.acceleration_mps2), 1e-9);
  EXPECT_NEAR(std::sqrt(prediction.prior.covariance(2, 2)),
              std::hypot(0.1 * c.initial_rate_rps, 0.01 * c.angular_acceleration_rps2), 1e-9);
  EXPECT_FALSE(prediction.inertial.has_value());
}

TEST(MotionModel, GoesOnWithTheTwistOfTheLastTwoScans) {
  for (const testing::Motion& motion : {kStraight, kTurning}) {
    const Time next = from_seconds(0.4);
    const Prediction prediction = following(motion, 3).predict(next, {});
    EXPECT_LT((motion(next).inverse() * prediction.prior.T_odom_lidar).translation().norm(), 1e-9);
    EXPECT_NEAR(prediction.seconds, 0.1, 1e-9);
  }
}

TEST(MotionModel, KnowsLessTheLongerItPredicts) {
  const MotionModel model = following(kStraight, 3);
  double last = 0;
  for (const double seconds : {0.35, 0.4, 0.6, 1.0}) {
    const Matrix6d P = model.predict(from_seconds(seconds), {}).prior.covariance;
    EXPECT_LT((P - P.transpose()).norm(), 1e-12);
    EXPECT_GT(P.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
    EXPECT_GT(P(3, 3), last) << seconds;
    last = P(3, 3);
  }
}

TEST(MotionModel, AccelerationMovesItByItsSquareOfTime) {
  const double seconds = 0.5;
  const Matrix6d P =
      following(kStraight, 3).predict(from_seconds(0.3 + seconds), {}).prior.covariance;
  const double expected = MotionConfig().acceleration_mps2 * seconds * seconds;
  EXPECT_NEAR(std::sqrt(P(3, 3)), expected, 0.01 * expected);
}

TEST(MotionModel, OverALongGapItGoesOnForAWhileAndIsAnywhereThatItMayHaveFlownTo) {
  const MotionConfig config;
  const Prediction prediction = following(kStraight, 3).predict(from_seconds(60.3), {});
  EXPECT_NEAR(prediction.seconds, 60, 1e-9);
  EXPECT_NEAR(prediction.prior.T_odom_lidar.translation().x(), 6 * (0.3 + config.max_coast_s),
              1e-6);
  EXPECT_NEAR(std::sqrt(prediction.prior.covariance(3, 3)), 60 * config.initial_speed_mps, 1e-6);
}

TEST(MotionModel, WhereTheClockMayHaveSteppedTheUsualIntervalIsOfferedToo) {
  const MotionModel model = following(kStraight, 60);
  EXPECT_FALSE(model.predict_stepped(from_seconds(6.1), {}).has_value());
  const auto stepped = model.predict_stepped(from_seconds(16), {});
  ASSERT_TRUE(stepped.has_value());
  EXPECT_NEAR(stepped->seconds, 0.1, 1e-9);
  EXPECT_NEAR(stepped->prior.T_odom_lidar.translation().x(), 6 * 6.1, 1e-6);
  EXPECT_FALSE(model.predict_stepped(from_seconds(16), steady(6, 16)).has_value());
}

TEST(MotionModel, TheInertialUnitBridgesScansThatAreNotRegistered) {
  MotionModel model({});
  model.start(0, along_x(0));
  Time now = 0;
  for (int i = 0; i < 10; ++i) {
    now += 100'000'000;
    model.accept(model.predict(now, steady(0.1 * i, 0.1 * (i + 1))), along_x(0), kKnown);
  }
  const Eigen::Vector3d forward(1, 0, 0);
  const auto imu = steady(1, 4, testing::kUp + forward);
  Matrix6d sum = Matrix6d::Zero();
  Prediction last;
  for (int i = 0; i < 30; ++i) {
    last = model.predict(now += 100'000'000, imu);
    ASSERT_TRUE(last.inertial.has_value());
    sum += last.motion_covariance;
    model.coast(last);
  }
  EXPECT_NEAR(last.prior.T_odom_lidar.translation().x(), 0.5 * 3 * 3, 0.1);
  EXPECT_NEAR(last.seconds, 3, 1e-9);
  EXPECT_NEAR(std::sqrt(sum(3, 3)), std::sqrt(last.prior.covariance(3, 3)), 0.02);
}

TEST(MotionModel, WithoutRegistrationGoesOnForAWhileAndThenStands) {
  MotionModel model = following(kStraight, 3);
  Time now = from_seconds(0.3);
  for (int i = 0; i < 5; ++i) model.coast(model.predict(now += 100'000'000, {}));
  EXPECT_NEAR(model.T_odom_lidar().translation().x(), 6 * 0.8, 1e-6);
  for (int i = 0; i < 10; ++i) model.coast(model.predict(now += 100'000'000, {}));
  const double stood = model.T_odom_lidar().translation().x();
  model.coast(model.predict(now += 100'000'000, {}));
  EXPECT_EQ(model.T_odom_lidar().translation().x(), stood);
}

TEST(MotionModel, EachScanThatIsMissedMakesItLessSure) {
  MotionModel model = following(kStraight, 3);
  Time now = from_seconds(0.3);
  double last = model.predict(now + 100'000'000, {}).prior.covariance(3, 3);
  for (int i = 0; i < 4; ++i) {
    model.coast(model.predict(now += 100'000'000, {}));
    const double next = model.predict(now + 100'000'000, {}).prior.covariance(3, 3);
    EXPECT_GT(next, last) << i;
    last = next;
  }
}

TEST(MotionModel, AfterAGapWithoutInertialUnitTheTurnInTheScanIsNotKnown) {
  const MotionModel model = following(kStraight, 10);
  const Time span = from_seconds(0.1);
  const Prediction soon = model.predict(from_seconds(1.1), {});
  EXPECT_TRUE(model.half_sweep_covariance(soon, span).isZero());
  const Prediction late = model.predict(from_seconds(4), {});
  const double sd_rad = std::sqrt(model.half_sweep_covariance(late, span)(0, 0));
  EXPECT_NEAR(sd_rad, 0.05 * MotionConfig{}.initial_rate_rps, 1e-9);
  EXPECT_TRUE(model.half_sweep_covariance(late, 0).isZero());
}

TEST(MotionModel, LearnsTheUsualInterval) {
  MotionModel model({});
  model.start(0, along_x(0));
  for (int i = 1; i <= 60; ++i) {
    model.accept(model.predict(from_seconds(0.05 * i), {}), along_x(0), kKnown);
  }
  EXPECT_NEAR(model.usual_interval_s(), 0.05, 0.001);
}

/// Registered at 10 Hz with readings between; stands, then accelerates.
TEST(MotionModel, FollowsTheInertialUnitWhereItCoversTheMotion) {
  MotionModel model({});
  model.start(0, along_x(0));
  Time now = 0;
  for (int i = 0; i < 10; ++i) {
    const auto imu = steady(0.1 * i, 0.1 * (i + 1));
    const Prediction prediction = model.predict(now += 100'000'000, imu);
    ASSERT_TRUE(prediction.inertial.has_value());
    model.accept(prediction, along_x(0), kKnown);
  }
  const Eigen::Vector3d forward(4, 0, 0);
  const auto ahead = steady(1, 1.2, testing::kUp + forward);
  const Prediction by_unit = model.predict(from_seconds(1.2), ahead);
  const Prediction by_twist = model.predict(from_seconds(1.2), {});
  EXPECT_NEAR(by_unit.prior.T_odom_lidar.translation().x(), 0.5 * 4 * 0.2 * 0.2, 0.01);
  EXPECT_NEAR(by_twist.prior.T_odom_lidar.translation().x(), 0, 1e-6);
  EXPECT_LT(by_unit.prior.covariance(3, 3), by_twist.prior.covariance(3, 3));
  EXPECT_LE(by_unit.motion_covariance(3, 3), by_unit.prior.covariance(3, 3));
}

TEST(MotionModel, AHoleInTheReadingsIsPredictedWithoutThem) {
  const auto imu = steady(0.3, 0.32);
  EXPECT_FALSE(following(kStraight, 3).predict(from_seconds(0.5), imu).inertial.has_value());
}

TEST(MotionModel, SweepOfASteadyTwistBringsAPointToOnePlace) {
  const MotionModel model = following(kTurning, 3);
  const Time middle = from_seconds(0.4), span = 100'000'000;
  const Prediction prediction = model.predict(middle, {});
  const Sweep sweep = model.sweep(prediction, kTurning(middle), span, {});
  const Eigen::Vector3d seen = kTurning(middle) * Eigen::Vector3d(10, 2, 1);
  for (const std::int32_t offset : {-100'000'000, -70'000'000, -20'000'000, 0}) {
    const SE3 T_odom_now = kTurning(middle + span / 2 + offset);
    const Eigen::Vector3d measured = T_odom_now.inverse() * seen;
    const Eigen::Vector3f deskewed = sweep.deskewed(measured.cast<float>(), offset);
    EXPECT_LT((deskewed - Eigen::Vector3f(10, 2, 1)).norm(), 1e-3f) << offset;
  }
}

TEST(MotionModel, AScanWithoutTimesIsNotDeskewed) {
  const MotionModel model = following(kTurning, 3);
  const Prediction prediction = model.predict(from_seconds(0.4), {});
  const Eigen::Vector3f point(10, 2, 1);
  EXPECT_EQ(model.sweep(prediction, kTurning(from_seconds(0.4)), 0, {}).deskewed(point, -1), point);
  EXPECT_EQ(model.sweep_before(kTurning(from_seconds(0.4)), 0.1, 0, {}).deskewed(point, -1), point);
}

TEST(MotionModel, SweepBeforeIsThatOfTheMotionToTheNextScan) {
  MotionModel model({});
  model.start(0, along_x(0));
  const Sweep sweep = model.sweep_before(along_x(0.6), 0.1, 100'000'000, {});
  EXPECT_NEAR(sweep.T_reference_stamp().translation().x(), 0.3, 1e-9);
}

}  // namespace
}  // namespace saker::odometry
