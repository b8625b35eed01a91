#include <gtest/gtest.h>

#include <limits>

#include "made_world.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/odometry/odometry.h"

namespace saker::odometry {
namespace {

using testing::MadeSensor;
using testing::Motion;

constexpr Time kPeriod = 100'000'000;
const Motion kDrive = testing::straight(5);

lidar::Scan seen(int k) { return scan(testing::street(), {}, kDrive, k * kPeriod); }

double error_m(const OdometryEstimate& estimate) {
  const SE3 truth = kDrive(kPeriod).inverse() * kDrive(estimate.stamp);
  return (estimate.T_odom_lidar.translation() - truth.translation()).norm();
}

void expect_finite(const OdometryEstimate& estimate) {
  EXPECT_TRUE(estimate.T_odom_lidar.matrix().allFinite());
  EXPECT_TRUE(estimate.covariance.allFinite());
  EXPECT_TRUE(std::isfinite(estimate.diagnostics.rms_m));
}

/// An odometry that has driven for a second.
class OnTheWay : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int k = 1; k <= 10; ++k) last_ = odometry_.register_scan(seen(k), {});
  }

  /// A bad scan as the 11th: predicted within decimetres; the 12th is registered again.
  void expect_predicted(lidar::Scan bad, OdometryReason reason) {
    bad.stamp = 11 * kPeriod;
    const auto predicted = odometry_.register_scan(bad, {});
    EXPECT_EQ(predicted.status, OdometryStatus::predicted);
    EXPECT_EQ(predicted.reason, reason);
    EXPECT_EQ(predicted.points.size(), bad.points.size());
    EXPECT_LT(error_m(predicted), 0.05);
    EXPECT_GT(predicted.covariance(3, 3), last_.covariance(3, 3));
    expect_finite(predicted);
    const auto next = odometry_.register_scan(seen(12), {});
    EXPECT_EQ(next.status, OdometryStatus::ok);
    EXPECT_LT(error_m(next), 0.03);
  }

  Odometry odometry_{OdometryConfig{}};
  OdometryEstimate last_;
};

TEST(OdometryConfig, AValueOutOfItsBoundsIsAnErrorThatNamesIt) {
  OdometryConfig config;
  config.map.voxel_m = -1;
  try {
    Odometry odometry{config};
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("odometry.map.voxel_m"), std::string::npos);
  }
}

TEST_F(OnTheWay, AnEmptyScanIsPredicted) { expect_predicted({}, OdometryReason::too_few_points); }

TEST_F(OnTheWay, AScanOfNanIsPredicted) {
  lidar::Scan bad = seen(11);
  for (auto& point : bad.points) point.setConstant(NAN);
  expect_predicted(bad, OdometryReason::too_few_points);
}

TEST_F(OnTheWay, TenPointsArePredicted) {
  lidar::Scan bad = seen(11);
  bad.rows = bad.columns = 0;
  bad.points.assign(10, Eigen::Vector3f(5, 5, 0));
  bad.offset_ns.assign(10, -1000);
  expect_predicted(bad, OdometryReason::too_few_points);
}

TEST_F(OnTheWay, AScanOfSomewhereElseIsPredicted) {
  core::Rng rng(1);
  lidar::Scan bad = seen(11);
  for (auto& point : bad.points)
    point = Eigen::Vector3d(rng.uniform(-30, 30), rng.uniform(-30, 30), rng.uniform(-30, 30))
                .cast<float>();
  expect_predicted(bad, OdometryReason::no_fit);
}

TEST_F(OnTheWay, InfiniteAndHugePointsAreLeftOut) {
  lidar::Scan scan = seen(11);
  for (std::size_t i = 0; i < scan.points.size(); i += 3)
    scan.points[i].setConstant(i % 2 ? std::numeric_limits<float>::infinity() : 1e30f);
  const auto estimate = odometry_.register_scan(scan, {});
  EXPECT_EQ(estimate.status, OdometryStatus::ok);
  EXPECT_LT(error_m(estimate), 0.03);
  expect_finite(estimate);
}

TEST_F(OnTheWay, AnOldOrRepeatedScanIsRefusedAndChangesNothing) {
  for (const int k : {10, 3}) {
    const auto refused = odometry_.register_scan(seen(k), {});
    EXPECT_EQ(refused.status, OdometryStatus::refused);
    EXPECT_EQ(refused.reason, OdometryReason::not_newer);
    EXPECT_TRUE(refused.T_odom_lidar.isApprox(last_.T_odom_lidar, 0));
    expect_finite(refused);
  }
  Odometry undisturbed{OdometryConfig{}};
  for (int k = 1; k <= 10; ++k) (void)undisturbed.register_scan(seen(k), {});
  EXPECT_EQ(odometry_.register_scan(seen(11), {}).T_odom_lidar.matrix(),
            undisturbed.register_scan(seen(11), {}).T_odom_lidar.matrix());
}

TEST_F(OnTheWay, AGapOfHalfASecondIsBridged) {
  const auto estimate = odometry_.register_scan(seen(15), {});
  EXPECT_EQ(estimate.status, OdometryStatus::ok);
  EXPECT_LT(error_m(estimate), 0.05);
}

TEST_F(OnTheWay, MissingPointTimesAreNoTimes) {
  lidar::Scan scan = seen(11);
  scan.offset_ns.clear();
  const auto estimate = odometry_.register_scan(scan, {});
  EXPECT_NE(estimate.status, OdometryStatus::refused);
  expect_finite(estimate);
}

TEST_F(OnTheWay, ImuSamplesThatAreNotFiniteOrOutOfOrderAreSkipped) {
  auto imu = testing::imu(kDrive, 10 * kPeriod, 11 * kPeriod, Eigen::Vector3d::Zero());
  imu[2].angular_velocity.setConstant(NAN);
  imu[3].acceleration.setConstant(NAN);
  std::swap(imu[5], imu[6]);
  const auto estimate = odometry_.register_scan(seen(11), imu);
  EXPECT_EQ(estimate.status, OdometryStatus::ok);
  EXPECT_LT(error_m(estimate), 0.03);
}

TEST(OdometryStart, AFirstScanOfNothingDefinesTheFrameAndTheMapBeginsLater) {
  Odometry odometry{OdometryConfig{}};
  lidar::Scan empty;
  empty.stamp = kPeriod;
  expect_finite(odometry.register_scan(empty, {}));
  OdometryEstimate estimate;
  for (int k = 2; k <= 20; ++k) {
    estimate = odometry.register_scan(seen(k), {});
    expect_finite(estimate);
  }
  EXPECT_EQ(estimate.status, OdometryStatus::ok);
}

TEST(OdometryStart, LostForLongItBeginsANewMapAndGoesOn) {
  Odometry odometry{OdometryConfig{}};
  for (int k = 1; k <= 10; ++k) (void)odometry.register_scan(seen(k), {});
  // The vehicle is carried to another place while the sensor sees nothing.
  lidar::Scan nothing;
  nothing.stamp = 11 * kPeriod;
  (void)odometry.register_scan(nothing, {});
  const Motion elsewhere = [](Time time) {
    SE3 T = kDrive(time);
    T.translation() += Eigen::Vector3d(53, 2, 1);
    T.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix();
    return T;
  };
  OdometryEstimate estimate;
  for (int k = 40; k <= 60; ++k)
    estimate = odometry.register_scan(scan(testing::street(), {}, elsewhere, k * kPeriod), {});
  EXPECT_EQ(estimate.status, OdometryStatus::ok);
}

}  // namespace
}  // namespace saker::odometry
