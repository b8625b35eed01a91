#include "saker/odometry/sweep.h"

#include <gtest/gtest.h>

#include "made_imu.h"

namespace saker::odometry {
namespace {

constexpr Time kSpan = 100'000'000;

Vector6d twist() {
  Vector6d twist;
  twist << 0.4, -0.3, 1.2, 5, -2, 0.5;  // rad/s, m/s
  return twist;
}

Sweep twisting() { return Sweep::twisting({twist()}, kSpan); }

const Eigen::Vector3f kPoint(10, -4, 2);

/// Of a point that lies at `kPoint` when the lidar is in the middle of the scan.
Eigen::Vector3f measured_at(std::int32_t offset_ns) {
  const SE3 T_middle_now =
      core::se3_exp(twist() * (to_seconds(offset_ns) + 0.5 * to_seconds(kSpan)));
  return (T_middle_now.inverse() * kPoint.cast<double>()).cast<float>();
}

TEST(Sweep, OfALidarThatStoodStillMovesNoPoint) {
  EXPECT_EQ(Sweep().deskewed(kPoint, -50'000'000), kPoint);
  EXPECT_TRUE(Sweep().T_reference_stamp().isApprox(SE3::Identity()));
}

TEST(Sweep, BringsAStandingPointToOnePlaceWheneverItWasMeasured) {
  const Sweep sweep = twisting();
  for (std::int32_t offset = -kSpan; offset <= 0; offset += 1'700'000) {
    EXPECT_LT((sweep.deskewed(measured_at(offset), offset) - kPoint).norm(), 1e-4) << offset;
  }
}

TEST(Sweep, LeavesAPointOfTheMiddleWhereItIs) {
  EXPECT_LT((twisting().deskewed(kPoint, -kSpan / 2) - kPoint).norm(), 1e-5);
}

TEST(Sweep, KnowsTheStampsPose) {
  const SE3 expected = core::se3_exp(twist() * (0.5 * to_seconds(kSpan)));
  EXPECT_TRUE(twisting().T_reference_stamp().isApprox(expected, 1e-12));
}

TEST(Sweep, ReferredToTheStampLeavesItsLastPointWhereItIs) {
  const Sweep at_stamp = twisting().referred_to_stamp();
  EXPECT_LT((at_stamp.deskewed(kPoint, 0) - kPoint).norm(), 1e-5);
  EXPECT_TRUE(at_stamp.T_reference_stamp().isApprox(SE3::Identity()));
  const Eigen::Isometry3f T_middle_stamp = twisting().T_reference_stamp().cast<float>();
  for (const std::int32_t offset : {-90'000'000, -31'000'000}) {
    const Eigen::Vector3f by_middle = twisting().deskewed(kPoint, offset);
    EXPECT_LT((T_middle_stamp * at_stamp.deskewed(kPoint, offset) - by_middle).norm(), 1e-4);
  }
}

TEST(Sweep, OffsetsOutsideTheScanCountAsItsEnds) {
  const Sweep sweep = twisting();
  EXPECT_EQ(sweep.deskewed(kPoint, -2 * kSpan), sweep.deskewed(kPoint, -kSpan));
  EXPECT_EQ(sweep.deskewed(kPoint, 5'000'000), sweep.deskewed(kPoint, 0));
}

TEST(Sweep, ByTheGyroscopeIsThatByTheSameTwist) {
  Vector6d turning = Vector6d::Zero();
  turning.head<3>() << 0.2, 0.5, -1;
  const auto imu = testing::steady(-0.05, 0.2, testing::kUp, turning.head<3>());
  const RotationTrack track = RotationTrack::integrated(imu, 0, kSpan, Eigen::Vector3d::Zero());
  const Sweep by_gyroscope = Sweep::rotating(track, {}, kSpan);
  const Sweep by_twist = Sweep::twisting({turning}, kSpan);
  for (const std::int32_t offset : {-100'000'000, -60'000'000, -5'000'000}) {
    EXPECT_LT((by_gyroscope.deskewed(kPoint, offset) - by_twist.deskewed(kPoint, offset)).norm(),
              1e-4);
  }
}

TEST(Sweep, WithoutTurningMovesPointsByTheVelocity) {
  const RotationTrack still =
      RotationTrack::integrated(testing::steady(-0.05, 0.2), 0, kSpan, Eigen::Vector3d::Zero());
  const Sweep sweep = Sweep::rotating(still, {{8, 0, 0}, {0, 0, 40}}, kSpan);
  const Eigen::Vector3f at_stamp = sweep.deskewed(kPoint, 0);
  EXPECT_LT((at_stamp - kPoint - Eigen::Vector3f(0.4f, 0, 0.05f)).norm(), 1e-4);
  const Eigen::Vector3f at_begin = sweep.deskewed(kPoint, -kSpan);
  EXPECT_LT((at_begin - kPoint - Eigen::Vector3f(-0.4f, 0, 0.05f)).norm(), 1e-4);
}

TEST(Sweep, KeepsPointsThatAreNotFinite) {
  lidar::Scan scan;
  scan.points = {kPoint, Eigen::Vector3f::Constant(NAN)};
  scan.offset_ns = {-kSpan / 2, -10};
  const auto points = twisting().deskewed(scan);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_LT((points[0] - kPoint).norm(), 1e-5);
  EXPECT_TRUE(points[1].array().isNaN().all());
}

TEST(SpanOf, IsTheTimeOfTheFirstPointToTheStamp) {
  lidar::Scan scan;
  scan.points.assign(3, kPoint);
  scan.offset_ns = {-40'000'000, -90'000'000, 0};
  EXPECT_EQ(Sweep::span_of(scan), 90'000'000);
  scan.offset_ns = {-2'000'000'000, 0, 0};
  EXPECT_EQ(Sweep::span_of(scan), kNanosecondsPerSecond) << "at most a second";
  scan.offset_ns = {0, 0, 5};
  EXPECT_EQ(Sweep::span_of(scan), 0);
}

TEST(SpanOf, WithoutTimesIsNone) {
  lidar::Scan scan;
  EXPECT_EQ(Sweep::span_of(scan), 0);
  scan.points.assign(3, kPoint);
  scan.offset_ns = {-10, -5};
  EXPECT_EQ(Sweep::span_of(scan), 0) << "not one a point";
}

}  // namespace
}  // namespace saker::odometry
