#include "saker/detection/motion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "saker/core/rng.h"

namespace saker::detection {
namespace {

constexpr double kDirection = 0.3;  // of the long side

/// Front and one side of a vehicle over ten scans of 0.1 s, the last one at the origin.
std::vector<TimedPoint> seen(const Eigen::Vector2d& velocity, double seconds_a_scan = 0.1) {
  core::Rng rng(5);
  std::vector<TimedPoint> points;
  const Eigen::Rotation2Dd turn(kDirection);
  for (int scan = 0; scan < 10; ++scan) {
    const double seconds = seconds_a_scan * (scan - 9);
    for (int i = 0; i < 80; ++i) {
      const bool side = rng.chance(0.7);
      const Eigen::Vector2d on(side ? rng.uniform(-2.2, 2.2) : 2.2,
                               side ? 0.9 : rng.uniform(-0.9, 0.9));
      const Eigen::Vector2d noise(rng.normal(0, 0.02), rng.normal(0, 0.02));
      const Eigen::Vector2d at = turn * Eigen::Vector2d(on + noise) + seconds * velocity;
      points.push_back({at.cast<float>(), static_cast<float>(seconds)});
    }
  }
  return points;
}

Eigen::Vector2d along(double speed) {
  return speed * Eigen::Vector2d(std::cos(kDirection), std::sin(kDirection));
}

Eigen::Vector2d across(double speed) {
  return speed * Eigen::Vector2d(-std::sin(kDirection), std::cos(kDirection));
}

Motion motion_of(const std::vector<TimedPoint>& points, double direction = kDirection) {
  return estimate_motion(points, direction, {});
}

TEST(Motion, AlongOrAcrossTheLongSideIsFound) {
  for (const double speed : {-15.0, -6.0, 3.0, 8.0, 20.0}) {
    for (const Eigen::Vector2d& velocity : {along(speed), across(speed)}) {
      const Motion motion = motion_of(seen(velocity));
      EXPECT_TRUE(motion.moving) << velocity.transpose();
      EXPECT_LT((motion.velocity - velocity).norm(), 0.8) << velocity.transpose();
    }
  }
}

TEST(Motion, OfWhatStandsIsExactlyZero) {
  const Motion motion = motion_of(seen(Eigen::Vector2d::Zero()));
  EXPECT_FALSE(motion.moving);
  EXPECT_EQ(motion.velocity, Eigen::Vector2d::Zero());
}

TEST(Motion, SlowerThanAChangeOfViewIsTakenForStanding) {
  EXPECT_FALSE(motion_of(seen(along(0.4))).moving);
}

TEST(Motion, IsNotKnownOverTooShortATime) {
  EXPECT_TRUE(motion_of(seen(along(12), 0.03)).moving);
  EXPECT_FALSE(motion_of(seen(along(12), 0.02)).moving) << "0.18 s";
}

TEST(Motion, OfNothingOrOnePointIsNone) {
  EXPECT_FALSE(motion_of({}).moving);
  EXPECT_FALSE(motion_of({{{1, 2}, -0.5f}}).moving);
}

TEST(Motion, IsTheSameWhereverTheVehicleIs) {
  std::vector<TimedPoint> points = seen(along(7));
  const Motion before = motion_of(points);
  for (TimedPoint& p : points) p.position += Eigen::Vector2f(40.3f, -17.9f);
  const Motion after = motion_of(points);
  EXPECT_TRUE(after.moving);
  EXPECT_LT((after.velocity - before.velocity).norm(), 0.6);
}

TEST(Motion, TurnsWithTheVehicle) {
  for (const double angle : {0.7, 2.4, -1.1}) {
    const Eigen::Rotation2Dd turn(angle);
    std::vector<TimedPoint> points = seen(along(7));
    for (TimedPoint& p : points) p.position = turn.cast<float>() * p.position;
    const Motion motion = motion_of(points, kDirection + angle);
    EXPECT_TRUE(motion.moving) << angle;
    EXPECT_LT((motion.velocity - turn * along(7)).norm(), 0.8) << angle;
  }
}

TEST(Motion, WhereTimeRunsBackwardsIsTheOppositeOne) {
  std::vector<TimedPoint> points = seen(along(7));
  for (TimedPoint& p : points) p.seconds = -0.9f - p.seconds;
  EXPECT_LT((motion_of(points).velocity + along(7)).norm(), 0.8);
}

TEST(Motion, IsNotMadeUpWhereTheSensorPassesAlongAParkedVehicle) {
  std::vector<TimedPoint> points = seen(Eigen::Vector2d::Zero());
  std::erase_if(points, [](const TimedPoint& p) {
    const double at = along(1).dot(p.position.cast<double>());
    return p.seconds < -0.45f ? at > 0.5 : at < -0.5;  // first its rear, then its front
  });
  EXPECT_FALSE(motion_of(points).moving);
}

TEST(Motion, OfEveryTenthPointIsThatOfAll) {
  MotionConfig few;
  few.most_points = 80;
  const Motion motion = estimate_motion(seen(along(9)), kDirection, few);
  EXPECT_TRUE(motion.moving);
  EXPECT_LT((motion.velocity - along(9)).norm(), 1.1);
}

}  // namespace
}  // namespace saker::detection
