#include <gtest/gtest.h>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/setpoint_out.h"

namespace saker::flight::mavlink {
namespace {

using Eigen::Vector3d;

constexpr Time kMs = kNanosecondsPerSecond / 1000;
constexpr Time kNow = 100 * kNanosecondsPerSecond;
constexpr std::uint16_t kVelocityIgnored = 0x38, kAccelerationIgnored = 0x1C0;
const Place kHere{{1, 2, 3}, 0.5};

Setpoint made(Time stamp) {
  Setpoint setpoint;
  setpoint.stamp = stamp;
  setpoint.expiry = stamp + 200 * kMs;
  setpoint.position = {1, 2, 3};
  setpoint.velocity = {0.5, 0.25, -0.125};
  setpoint.acceleration = {0.1, 0.2, 0.3};
  setpoint.yaw = 0.7;
  setpoint.yaw_rate = 0;
  return setpoint;
}

TEST(MavlinkSetpoint, SaysPlaceVelocityAccelerationAndYawInNed) {
  const auto m = to_message(made(kNow), kNow);
  EXPECT_EQ(m.coordinate_frame, 1);
  EXPECT_EQ(m.type_mask, 0x800);  // as flown
  EXPECT_FLOAT_EQ(m.x, 1);
  EXPECT_FLOAT_EQ(m.y, -2);
  EXPECT_FLOAT_EQ(m.z, -3);
  EXPECT_FLOAT_EQ(m.vz, 0.125F);
  EXPECT_FLOAT_EQ(m.afy, -0.2F);
  EXPECT_FLOAT_EQ(m.yaw, -0.7F);
}

/// A mask that ignores the velocity while it gives an acceleration stops ArduPilot silently.
TEST(MavlinkSetpoint, WithoutAVelocityThereIsNoAcceleration) {
  for (int known = 0; known < 8; ++known) {
    Setpoint setpoint = made(kNow);
    if (known & 1) setpoint.velocity.setConstant(NAN);
    if (known & 2) setpoint.acceleration.setConstant(NAN);
    if (known & 4) setpoint.yaw = NAN;
    const auto m = to_message(setpoint, kNow);
    if (m.type_mask & kVelocityIgnored) {
      EXPECT_EQ(m.type_mask & kAccelerationIgnored, kAccelerationIgnored);
    }
    EXPECT_EQ((m.type_mask & 0x400) != 0, (known & 4) != 0);
    EXPECT_TRUE(encode(m));
  }
}

TEST(MavlinkSetpoint, WhatIsNoPlaceIsOldOrExpiredIsRefused) {
  SetpointOut out;
  const auto refused = [&](auto change) {
    Setpoint setpoint = made(kNow);
    change(setpoint);
    return !out.hear(setpoint, kNow);
  };
  EXPECT_TRUE(refused([](auto& s) { s.position.x() = NAN; }));
  EXPECT_TRUE(refused([](auto& s) { s.position.x() = 2e4; }));
  EXPECT_TRUE(refused([](auto& s) { s.velocity.x() = NAN; }));  // some of it, but not all
  EXPECT_TRUE(refused([](auto& s) { s.velocity.x() = 60; }));
  EXPECT_TRUE(refused([](auto& s) { s.yaw = NAN; }));
  EXPECT_TRUE(refused([](auto& s) { s.expiry = kNow; }));
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_TRUE(refused([](auto&) {}));  // the same again
  EXPECT_EQ(out.counters().refused, 7);
}

TEST(MavlinkSetpoint, AtItsExpiryAStopGoesOutWhereTheVehicleIsAndStays) {
  SetpointOut out;
  ASSERT_TRUE(out.hear(made(kNow), kNow));
  EXPECT_FLOAT_EQ(out.tick(kHere, kNow + 199 * kMs, kNow).vx, 0.5);
  const Place there{{4, 5, 6}, -0.2};
  auto stop = out.tick(there, kNow + 201 * kMs, kNow);
  EXPECT_TRUE(out.stopped());
  EXPECT_FLOAT_EQ(stop.x, 4);
  EXPECT_FLOAT_EQ(stop.vx, 0);
  EXPECT_FLOAT_EQ(stop.yaw, 0.2F);
  EXPECT_EQ(stop.type_mask, 0x800);
  stop = out.tick(kHere, kNow + 900 * kMs, kNow);
  EXPECT_FLOAT_EQ(stop.x, 4);  // not where it drifts to
  EXPECT_EQ(out.counters().expired, 1);
  ASSERT_TRUE(out.hear(made(kNow + 1000 * kMs), kNow + 1000 * kMs));
  EXPECT_FLOAT_EQ(out.tick(kHere, kNow + 1001 * kMs, kNow).vx, 0.5);
  EXPECT_FALSE(out.stopped());
}

TEST(MavlinkSetpoint, AnExpiryFarAwayIsNotBelieved) {
  SetpointOut out;
  Setpoint setpoint = made(kNow);
  setpoint.expiry = kNow + 3600 * kNanosecondsPerSecond;
  ASSERT_TRUE(out.hear(setpoint, kNow));
  EXPECT_TRUE(out.fresh(kNow + 499 * kMs));
  EXPECT_FALSE(out.fresh(kNow + 501 * kMs));
}

TEST(MavlinkSetpoint, AResetMovesWhatIsHeldInTheSameTick) {
  OdometryReset reset;
  reset.T_new_old.translation() = Vector3d(10, 0, 0);
  SetpointOut out;
  ASSERT_TRUE(out.hear(made(kNow), kNow));
  out.follow(reset, kNow + 10 * kMs);
  EXPECT_FLOAT_EQ(out.tick(kHere, kNow + 20 * kMs, kNow).x, 11);
  out.stop(kHere);
  out.follow(reset, kNow + 20 * kMs);
  EXPECT_FLOAT_EQ(out.tick(kHere, kNow + 30 * kMs, kNow).x, 11);
  EXPECT_FALSE(out.hear(made(kNow + 5 * kMs), kNow + 40 * kMs));  // made before the reset
  EXPECT_TRUE(out.hear(made(kNow + 45 * kMs), kNow + 46 * kMs));
}

TEST(MavlinkSetpoint, AClimbRisesAtItsSpeedAndHoldsItsHeight) {
  SetpointOut out;
  out.climb(kHere, 2, kNow);
  const auto down = [&](double z, Time t) {
    return out.tick({{1, 2, z}, 0.5}, kNow + t, kNow + t).z;
  };
  EXPECT_FLOAT_EQ(down(3, 0), -3);
  EXPECT_FLOAT_EQ(down(3.9, 1000 * kMs), -4);
  EXPECT_TRUE(out.hear(made(kNow + 1100 * kMs), kNow + 1100 * kMs));
  EXPECT_FLOAT_EQ(down(4.4, 1500 * kMs), -4.5);  // the executive's do not break it off
  EXPECT_TRUE(out.climbing());
  EXPECT_FLOAT_EQ(down(4.9, 2100 * kMs), -5);
  EXPECT_FALSE(out.climbing());
  EXPECT_FLOAT_EQ(down(5, 2200 * kMs), -5);
}

}  // namespace
}  // namespace saker::flight::mavlink
