#include "saker/motion/speed_profile.h"

#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::motion {
namespace {

const LimitsConfig kLimits;
const Geofence kFence{GeofenceConfig{}};

Curve curve_of(const Waypoints& path) {
  const made::World world({-20, -20, 0}, {20, 20, 10});
  const FreeSpace space(*world.grid(), {}, kFence, {.vehicle = {0, 0, 5}});
  return rounded(path, space, 2, 1);
}

double seconds(const Curve& curve, const std::vector<double>& speeds) {
  double sum = 0;
  for (std::size_t i = 1; i < curve.size(); ++i)
    sum += 2 * (curve[i].s - curve[i - 1].s) / (speeds[i] + speeds[i - 1]);
  return sum;
}

TEST(SpeedProfile, OfALegIsTheFastestThereIs) {
  const Curve curve = curve_of({{0, 0, 5}, {10, 0, 5}});
  const auto speeds = speed_profile(curve, 0, kLimits);
  ASSERT_TRUE(speeds);
  EXPECT_NEAR(seconds(curve, *speeds),
              10 / kLimits.max_speed + kLimits.max_speed / kLimits.max_acceleration, 0.02);
  EXPECT_EQ(speeds->front(), 0);
  EXPECT_EQ(speeds->back(), 0);
}

TEST(SpeedProfile, OfAShortLegNeverReachesTheHighestSpeed) {
  const Curve curve = curve_of({{0, 0, 5}, {1, 0, 5}});
  const auto speeds = speed_profile(curve, 0, kLimits);
  EXPECT_NEAR(seconds(curve, *speeds), 2 * std::sqrt(1 / kLimits.max_acceleration), 0.02);
}

TEST(SpeedProfile, KeepsTheAccelerationAlongAndAcrossWithinItsLimit) {
  const Curve curve = curve_of({{0, 0, 5}, {8, 0, 5}, {8, 8, 6}, {1, 9, 4}, {-9, 0, 5}});
  const auto speeds = speed_profile(curve, 0, kLimits);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double v = (*speeds)[i], before = (*speeds)[i - 1];
    const double along = (v * v - before * before) / (2 * (curve[i].s - curve[i - 1].s));
    const double across = curve[i].curvature * v * v;
    EXPECT_LE(std::hypot(along, across), 1.05 * kLimits.max_acceleration);
    EXPECT_LE(v * std::abs(curve[i].arriving.z()), kLimits.max_climb_speed + 1e-9);
    EXPECT_LE(v, kLimits.max_speed);
  }
}

TEST(SpeedProfile, ClimbsNoFasterThanAllowed) {
  const Curve curve = curve_of({{0, 0, 2}, {0, 0, 8}});
  const auto speeds = speed_profile(curve, 0, kLimits);
  EXPECT_NEAR(*std::max_element(speeds->begin(), speeds->end()), kLimits.max_climb_speed, 1e-9);
}

TEST(SpeedProfile, KeepsTheSpeedOfTheStart) {
  const auto speeds = speed_profile(curve_of({{0, 0, 5}, {10, 0, 5}}), 1.7, kLimits);
  ASSERT_TRUE(speeds);
  EXPECT_EQ(speeds->front(), 1.7);
}

TEST(SpeedProfile, BrakesFromMoreThanTheLimit) {
  const auto speeds = speed_profile(curve_of({{0, 0, 2}, {0, 0, 8}}), 1.3, kLimits);
  ASSERT_TRUE(speeds);
  EXPECT_EQ(speeds->front(), 1.3);
  EXPECT_NEAR((*speeds)[60], kLimits.max_climb_speed, 1e-9);
}

TEST(SpeedProfile, SaysWhenItCannotStopInTime) {
  EXPECT_FALSE(speed_profile(curve_of({{0, 0, 5}, {1, 0, 5}}), 2.5, kLimits));
  EXPECT_TRUE(speed_profile(curve_of({{0, 0, 5}, {1.6, 0, 5}}), 2.5, kLimits));
}

TEST(SpeedProfile, StopsAtAStop) {
  const Curve curve = curve_of({{0, 0, 5}, {8, 0, 5}, {0, 0.1, 5}});
  const auto speeds = speed_profile(curve, 0, kLimits);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (curve[i].stop) {
      EXPECT_EQ((*speeds)[i], 0);
    }
  }
  EXPECT_GT((*speeds)[40], 1);
}

}  // namespace
}  // namespace saker::motion
