#include "saker/motion/retiming.h"

#include <gtest/gtest.h>

#include "made_world.h"
#include "saker/motion/speed_profile.h"

namespace saker::motion {
namespace {

const LimitsConfig kLimits;
const Geofence kFence{GeofenceConfig{}};

Trajectory timed(const MotionState& start, Waypoints path) {
  const made::World world({-20, -20, 0}, {20, 20, 10});
  const FreeSpace space(*world.grid(), {}, kFence, {.vehicle = {0, 0, 5}});
  const MotionState departure = after_first_window(start, kLimits);
  path.insert(path.begin(), departure.position);
  const Curve curve = rounded(path, space, 2, 1);
  const auto speeds = speed_profile(curve, departure.velocity.norm(), kLimits);
  return retimed(start, 0, curve, *speeds, {}, kLimits);
}

const Waypoints kZigzag{{8, 0, 5}, {8, 8, 6}, {1, 9, 4}, {-9, 0, 5}};

TEST(Retiming, BoundsTheJerk) {
  const Trajectory t = timed(made::resting_at({0, 0, 5}), kZigzag);
  for (std::size_t k = 1; k < t.states.size(); ++k) {
    const Eigen::Vector3d change = t.states[k].acceleration - t.states[k - 1].acceleration;
    EXPECT_LE(change.norm() / t.step_s, 1.05 * kLimits.max_jerk);
  }
}

TEST(Retiming, StaysWithinTwoCentimetresOfTheCurve) {
  const MotionState start = made::resting_at({0, 0, 5});
  const Trajectory t = timed(start, {{9, 0, 5}, {9, 9, 5}});  // an arc of 2 m around (7, 2)
  for (const MotionState& s : t.states) {
    const Eigen::Vector2d p = s.position.head<2>();
    const double off = p.x() > 7 && p.y() < 2 ? std::abs((p - Eigen::Vector2d(7, 2)).norm() - 2)
                                              : std::min(std::abs(p.y()), std::abs(p.x() - 9));
    EXPECT_LT(off, 0.02);
  }
}

TEST(Retiming, LeavesTheFirstWindowAsItsAccelerationSays) {
  MotionState start = made::resting_at({1, 2, 3});
  start.velocity = {1, 0.5, 0};
  start.acceleration = {0, 1, -0.5};
  const MotionState after = after_first_window(start, kLimits);
  const double half_s = 0.5 * kLimits.smoothing_s();
  EXPECT_TRUE(after.velocity.isApprox(start.velocity + half_s * start.acceleration, 1e-9));
  // The mean of t² over the window is taken off, so that the mean of the motion is the start.
  const double t2 = half_s * half_s - half_s * half_s / 3;
  const Eigen::Vector3d expected =
      start.position + half_s * start.velocity + 0.5 * t2 * start.acceleration;
  EXPECT_TRUE(after.position.isApprox(expected, 1e-5));
}

TEST(Retiming, FollowsAStartInMotionWithoutAStep) {
  MotionState start = made::resting_at({0, 0, 5}, 1);
  start.velocity = {1.5, 0, 0.2};
  start.acceleration = {0.5, 0.5, 0};
  const MotionState after = after_first_window(start, kLimits);
  const Eigen::Vector3d on = after.position + 2 * after.velocity.normalized();
  const Trajectory t = timed(start, {on, {8, 8, 6}});
  const MotionState &first = t.states[0], &second = t.states[1];
  const Eigen::Vector3d step = 0.5 * t.step_s * (first.acceleration + second.acceleration);
  EXPECT_LT((second.velocity - first.velocity - step).norm(), 2e-3);
  EXPECT_LT((second.acceleration - first.acceleration).norm(), 1.05 * kLimits.max_jerk * t.step_s);
}

TEST(Retiming, EndsExactlyAtTheCurvesEnd) {
  const Trajectory t = timed(made::resting_at({0, 0, 5}), kZigzag);
  EXPECT_EQ(t.states.back().position, kZigzag.back());
}

}  // namespace
}  // namespace saker::motion
