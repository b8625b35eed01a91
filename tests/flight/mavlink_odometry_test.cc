#include <gtest/gtest.h>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/odometry_out.h"

namespace saker::flight::mavlink {
namespace {

using Eigen::AngleAxisd, Eigen::Vector3d;

constexpr Time kMs = kNanosecondsPerSecond / 1000;
constexpr Time kHost = 1000 * kNanosecondsPerSecond;  // when the sensor's clock was zero

/// The body on its way along x at 1 m/s, nose to the left by 0.4 rad.
VehicleOdometry at(Time stamp) {
  VehicleOdometry odometry;
  odometry.stamp = stamp;
  odometry.T_odom_body.linear() = AngleAxisd(0.4, Vector3d::UnitZ()).toRotationMatrix();
  odometry.T_odom_body.translation() = Vector3d(to_seconds(stamp), 2, 3);
  odometry.velocity = Vector3d(1, 0, 0);
  odometry.angular_velocity = Vector3d(0.1, 0.2, 0.3);
  odometry.covariance = Matrix6d::Identity() * 1e-4;
  odometry.status = VehicleOdometryStatus::ok;
  return odometry;
}

class MavlinkOdometry : public ::testing::Test {
 protected:
  OdometryOut::Result hear(const VehicleOdometry& odometry) {
    return out_.hear(odometry, kHost + odometry.stamp + 5 * kMs);
  }
  /// 100 Hz until `end`.
  int fly(Time begin, Time end) {
    int sent = 0;
    for (Time t = begin; t < end; t += 10 * kMs) sent += hear(at(t)).message.has_value();
    return sent;
  }

  OdometryOut out_;
};

TEST_F(MavlinkOdometry, OfAHundredASecondThirtyToFortyGoOut) {
  const int sent = fly(10 * kMs, 10 * kNanosecondsPerSecond + 10 * kMs);
  EXPECT_GE(sent, 300);
  EXPECT_LE(sent, 400);
}

TEST_F(MavlinkOdometry, WhatLaySomewhereIsBelievedAndDoesNotGoOut) {
  const auto odometry = at(20 * kMs);
  EXPECT_FALSE(out_.hear(odometry, kHost + 45 * kMs, false).message);
  EXPECT_TRUE(out_.good(kHost + 45 * kMs));
  EXPECT_TRUE(hear(at(30 * kMs)).message);
}

TEST_F(MavlinkOdometry, AResetGoesOutThoughItLaySomewhere) {
  (void)hear(at(20 * kMs));
  auto odometry = at(30 * kMs);
  odometry.reset_counter = 1;
  EXPECT_TRUE(out_.hear(odometry, kHost + 55 * kMs, false).message);
}

TEST_F(MavlinkOdometry, SaysPlaceInFrdVelocityInTheBodyAndWhatTheAutopilotsAccept) {
  const auto result = hear(at(20 * kMs));
  ASSERT_TRUE(result.message);
  const Odometry& m = *result.message;
  EXPECT_EQ(m.frame_id, 20);
  EXPECT_EQ(m.child_frame_id, 12);
  EXPECT_EQ(m.estimator_type, 3);
  EXPECT_EQ(m.quality, 100);
  EXPECT_NEAR(m.x, 0.02, 1e-6);
  EXPECT_NEAR(m.y, -2, 1e-6);
  EXPECT_NEAR(m.z, -3, 1e-6);
  // Along x with the nose to the left: forward, and to the right.
  EXPECT_NEAR(m.vx, std::cos(0.4), 1e-6);
  EXPECT_NEAR(m.vy, std::sin(0.4), 1e-6);
  EXPECT_NEAR(m.yawspeed, -0.3, 1e-6);
  EXPECT_NEAR(2 * std::atan2(m.q[3], m.q[0]), -0.4, 1e-6);
  EXPECT_NEAR(m.pose_covariance[0], 1e-4, 1e-9);
  EXPECT_EQ(m.time_usec, static_cast<std::uint64_t>((kHost + 25 * kMs) / 1000));
  EXPECT_TRUE(encode(m));
}

TEST_F(MavlinkOdometry, PredictedIsOfLessQualityAndLostIsNotSent) {
  auto odometry = at(20 * kMs);
  odometry.status = VehicleOdometryStatus::predicted;
  EXPECT_EQ(hear(odometry).message->quality, 50);
  odometry = at(100 * kMs);
  odometry.status = VehicleOdometryStatus::lost;
  EXPECT_TRUE(out_.good(kHost + 100 * kMs));
  EXPECT_FALSE(hear(odometry).message);
  EXPECT_FALSE(out_.good(kHost + 105 * kMs));
}

TEST_F(MavlinkOdometry, WhatIsNoNumberOrOutOfRangeIsRefused) {
  const auto refused = [&](auto change) {
    VehicleOdometry odometry = at(50 * kMs);
    change(odometry);
    const long before = out_.counters().refused;
    return !hear(odometry).message && out_.counters().refused == before + 1;
  };
  EXPECT_TRUE(refused([](auto& o) { o.T_odom_body.translation().x() = NAN; }));
  EXPECT_TRUE(refused([](auto& o) { o.velocity.y() = NAN; }));
  EXPECT_TRUE(refused([](auto& o) { o.velocity.y() = 40; }));
  EXPECT_TRUE(refused([](auto& o) { o.covariance(3, 4) = NAN; }));
  EXPECT_TRUE(refused([](auto& o) { o.angular_velocity.z() = INFINITY; }));
  EXPECT_TRUE(refused([](auto& o) { o.T_odom_body.translation().z() = 2e4; }));
  EXPECT_TRUE(refused([](auto& o) { o.stamp = 0; }));
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto&) {}));  // the same stamp again
}

TEST_F(MavlinkOdometry, IsGoodUntilItIsAFifthOfASecondOld) {
  fly(10 * kMs, 1000 * kMs);
  const Time last = kHost + 995 * kMs;
  EXPECT_TRUE(out_.good(last + 199 * kMs));
  EXPECT_FALSE(out_.good(last + 201 * kMs));
}

TEST_F(MavlinkOdometry, StampsThatStandAreNoOdometry) {
  fly(10 * kMs, 1000 * kMs);
  Time now = kHost + 995 * kMs;
  for (int i = 0; i < 30; ++i) {
    now += 10 * kMs;
    EXPECT_FALSE(out_.hear(at(990 * kMs), now).message);
  }
  EXPECT_FALSE(out_.good(now));
}

TEST_F(MavlinkOdometry, AJumpWithoutAResetIsALie) {
  fly(10 * kMs, 1000 * kMs);
  auto odometry = at(1000 * kMs);
  odometry.T_odom_body.translation().y() += 3;
  const auto result = hear(odometry);
  EXPECT_FALSE(result.message);
  EXPECT_FALSE(out_.good(kHost + 1005 * kMs));
  EXPECT_EQ(out_.counters().lies, 1);
  fly(1010 * kMs, 1900 * kMs);  // the jump back is a lie, too
  EXPECT_FALSE(out_.good(kHost + 1900 * kMs));
  fly(1900 * kMs, 2100 * kMs);
  EXPECT_TRUE(out_.good(kHost + 2100 * kMs));
}

/// The autopilot would fly the jump back.
TEST_F(MavlinkOdometry, AfterALieNothingIsSentUntilItIsTrustedAndThenItIsAReset) {
  fly(10 * kMs, 1000 * kMs);
  const auto jumped = [](Time stamp) {
    auto odometry = at(stamp);
    odometry.T_odom_body.translation().y() += 3;
    return odometry;
  };
  int sent = 0;
  for (Time t = 1000 * kMs; t < 2000 * kMs; t += 10 * kMs)
    sent += hear(jumped(t)).message.has_value();
  EXPECT_EQ(sent, 0);
  const auto first = hear(jumped(2010 * kMs));
  ASSERT_TRUE(first.message);
  EXPECT_EQ(first.message->reset_counter, 1);
  EXPECT_EQ(hear(jumped(2040 * kMs)).message->reset_counter, 1);
}

TEST_F(MavlinkOdometry, APlaceThatStandsWhileItSaysItMovesIsFrozen) {
  fly(10 * kMs, 1000 * kMs);
  const auto place = at(990 * kMs).T_odom_body;
  for (Time t = 1000 * kMs; t < 1300 * kMs; t += 10 * kMs) {
    auto odometry = at(t);
    odometry.T_odom_body = place;
    (void)hear(odometry);
  }
  EXPECT_FALSE(out_.good(kHost + 1300 * kMs));
}

TEST_F(MavlinkOdometry, AResetIsCountedSentAtOnceAndMovesSetpointsToTheSamePlace) {
  fly(10 * kMs, 1000 * kMs);
  auto odometry = at(1000 * kMs);
  odometry.reset_counter = 1;
  SE3 T_new_old = SE3::Identity();
  T_new_old.linear() = AngleAxisd(0.3, Vector3d::UnitZ()).toRotationMatrix();
  T_new_old.translation() = Vector3d(5, -4, 1);
  odometry.T_odom_body = T_new_old * odometry.T_odom_body;
  odometry.velocity = T_new_old.linear() * odometry.velocity;
  const auto result = hear(odometry);
  ASSERT_TRUE(result.message);
  EXPECT_EQ(result.message->reset_counter, 1);
  ASSERT_TRUE(result.reset);
  EXPECT_NEAR(result.reset->yaw, 0.3, 1e-9);
  EXPECT_TRUE(result.reset->T_new_old.isApprox(T_new_old, 1e-3));
  EXPECT_TRUE(out_.good(kHost + 1010 * kMs));
  EXPECT_EQ(out_.counters().lies, 0);
}

TEST_F(MavlinkOdometry, AnExecutiveThatBeginsAnewIsAReset) {
  fly(5000 * kMs, 6000 * kMs);
  const auto result = out_.hear(at(10 * kMs), kHost + 6100 * kMs);
  EXPECT_TRUE(result.reset);
  ASSERT_TRUE(result.message);
  EXPECT_EQ(result.message->reset_counter, 1);
}

}  // namespace
}  // namespace saker::flight::mavlink
