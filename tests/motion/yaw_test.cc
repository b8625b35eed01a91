#include "saker/motion/yaw.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/motion/trajectory.h"

namespace saker::motion {
namespace {

constexpr double kStep_s = 0.005;
const LimitsConfig kLimits;
const double kMostRate = kLimits.max_yaw_rate_deg * std::numbers::pi / 180;
const double kMostAcceleration = kLimits.max_yaw_acceleration_deg * std::numbers::pi / 180;

std::vector<Eigen::Vector3d> towards(double heading, double seconds) {
  const Eigen::Vector3d v(std::cos(heading), std::sin(heading), 0);
  return std::vector<Eigen::Vector3d>(static_cast<std::size_t>(seconds / kStep_s), v);
}

std::vector<YawState> yaw_of(const std::vector<Eigen::Vector3d>& velocities, YawState start,
                             std::optional<double> goal) {
  return yaw_along(velocities, kStep_s, start, goal, kLimits);
}

TEST(Yaw, LooksWhereTheMotionGoes) {
  const auto states = yaw_of(towards(2, 10), {0, 0}, {});
  EXPECT_NEAR(states[1000].yaw, 2, 1e-6);
  EXPECT_NEAR(states.back().yaw, 2, 1e-6);
}

TEST(Yaw, TurnsTheShorterWay) {
  const auto states = yaw_of(towards(-3, 10), {3, 0}, {});
  EXPECT_NEAR(states.back().yaw, 2 * std::numbers::pi - 3, 1e-6);
}

TEST(Yaw, BeginsWhereAndAsFastAsTheStart) {
  const auto states = yaw_of(towards(-1, 10), {0.5, 0.8}, {});
  EXPECT_NEAR(states.front().yaw, 0.5, 1e-9);
  EXPECT_NEAR(states.front().yaw_rate, 0.8, 1e-9);
}

TEST(Yaw, EndsAtTheGoalsYawAtRestWithTheMotion) {
  const auto velocities = towards(1, 10);
  const auto states = yaw_of(velocities, {1, 0}, -1.5);
  EXPECT_NEAR(states.back().yaw, -1.5, 1e-6);
  EXPECT_NEAR(states.back().yaw_rate, 0, 1e-9);
  EXPECT_LT(static_cast<double>(states.size() - velocities.size()) * kStep_s, 1);
}

TEST(Yaw, TurnsOnTheSpotWhereThereIsNoMotion) {
  const auto states = yaw_of({Eigen::Vector3d::Zero()}, {0, 0}, 1.0);
  EXPECT_NEAR(states.back().yaw, 1, 1e-6);
}

TEST(Yaw, KeepsItsYawWhereTheMotionIsUpright) {
  const std::vector<Eigen::Vector3d> up(1000, Eigen::Vector3d(0.01, 0, 1));
  EXPECT_NEAR(yaw_of(up, {2, 0}, {}).back().yaw, 2, 1e-9);
}

TEST(Yaw, KeepsRateAndAccelerationWithinLimits) {
  auto velocities = towards(1, 4);
  for (const double heading : {-2.5, 0.3, 3.0, 0.0})
    for (const Eigen::Vector3d& v : towards(heading, 1)) velocities.push_back(v);
  const auto states = yaw_of(velocities, {0, 0}, -3);
  for (std::size_t k = 1; k < states.size(); ++k) {
    EXPECT_LE(std::abs(states[k].yaw_rate), kMostRate + 1e-9);
    EXPECT_LE(std::abs(states[k].yaw_rate - states[k - 1].yaw_rate),
              kMostAcceleration * kStep_s + 1e-9);
    EXPECT_NEAR(states[k].yaw - states[k - 1].yaw,
                0.5 * kStep_s * (states[k].yaw_rate + states[k - 1].yaw_rate), 1e-9);
  }
}

}  // namespace
}  // namespace saker::motion
