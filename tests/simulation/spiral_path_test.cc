#include "saker/simulation/mission/spiral_path.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "saker/simulation/world/world.h"

namespace saker::simulation {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
const Eigen::Vector2d kCar(2.3, 0.9);

SE3 car_pose() { return placed(3, -2, 0.5, 0.7); }

SpiralPath path_of(std::uint64_t seed, const SpiralConfig& config = {}) {
  core::Rng rng(seed);
  return {config, car_pose(), kCar, rng};
}

Eigen::Vector3d seen_from_car(const SpiralPath& path, double t) {
  return car_pose().inverse() * path.pose(t).translation();
}

TEST(SpiralPath, ManyFlightsShowEveryAngleAtEveryRange) {
  std::set<std::pair<int, int>> seen;  // 2 m, an eighth of a turn
  for (std::uint64_t seed = 0; seed < 90; ++seed) {
    const SpiralPath path = path_of(seed);
    for (double t = 0; t < 24; t += 0.1) {
      const Eigen::Vector3d p = seen_from_car(path, t);
      const double angle = std::atan2(p.y(), p.x()) + kTurn / 2;
      seen.emplace(static_cast<int>(p.head<2>().norm() / 2), static_cast<int>(8 * angle / kTurn));
    }
  }
  for (int range = 2; range < 9; ++range) {
    for (int angle = 0; angle < 8; ++angle) EXPECT_TRUE(seen.contains({range, angle})) << range;
  }
  for (const int side : {1, 2, 5, 6}) EXPECT_TRUE(seen.contains({1, side})) << side;
}

TEST(SpiralPath, StaysWithinItsLimits) {
  const SpiralConfig config;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SpiralPath path = path_of(seed);
    for (double t = 0; t < 24; t += 0.1) {
      const Eigen::Vector3d p = seen_from_car(path, t);
      const Eigen::Vector2d outside = (p.head<2>().cwiseAbs() - kCar).cwiseMax(0.0);
      EXPECT_GT(outside.norm(), 0.2 * config.nearest_m);  // an ellipse nears the corners
      EXPECT_LT(p.head<2>().norm(), config.farthest_m + kCar.x() - kCar.y());
      EXPECT_GE(p.z(), config.lowest_m);
      EXPECT_LE(p.z(), config.highest_m);
    }
  }
}

TEST(SpiralPath, FliesAsAMultirotorOfAMission) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SpiralPath path = path_of(seed);
    for (double t = 0; t < 24; t += 0.1) {
      const SE3 T = path.pose(t);
      const Eigen::Vector3d step = path.pose(t + 0.01).translation() - T.translation();
      EXPECT_LT(step.norm() / 0.01, 3.5);
      EXPECT_LT(std::abs(step.z()) / 0.01, 1.2);
      EXPECT_GT(T.linear()(2, 2), std::cos(20 * kTurn / 360));
    }
  }
}

TEST(SpiralPath, BeginsAndEndsHovering) {
  const SpiralPath path = path_of(3);
  EXPECT_LT((path.pose(1.4).translation() - path.pose(0).translation()).norm(), 1e-6);
  EXPECT_LT((path.pose(24).translation() - path.pose(22.6).translation()).norm(), 1e-6);
  EXPECT_GT((path.pose(24).translation() - path.pose(0).translation()).norm(), 5);
}

TEST(SpiralPath, HeightDoesNotFollowFromRange) {
  double low = 1e9, high = 0;
  for (std::uint64_t seed = 0; seed < 90; ++seed) {
    const SpiralPath path = path_of(seed);
    for (double t = 0; t < 24; t += 0.1) {
      const Eigen::Vector3d p = seen_from_car(path, t);
      if (std::abs(p.head<2>().norm() - 8) > 0.5) continue;
      low = std::min(low, p.z());
      high = std::max(high, p.z());
    }
  }
  EXPECT_LT(low, 2.0);
  EXPECT_GT(high, 3.6);
}

/// Derivatives of the place by central differences.
struct Motion {
  Eigen::Vector3d velocity, acceleration;
};

Motion motion_at(const SpiralPath& path, double t) {
  constexpr double kStep = 0.01;
  const Eigen::Vector3d before = path.pose(t - kStep).translation();
  const Eigen::Vector3d now = path.pose(t).translation();
  const Eigen::Vector3d after = path.pose(t + kStep).translation();
  return {(after - before) / (2 * kStep), (after - 2 * now + before) / (kStep * kStep)};
}

TEST(SpiralPath, NeitherPlaceNorVelocityNorAccelerationJumps) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const SpiralPath path = path_of(seed);
    Eigen::Vector3d place = path.pose(-0.5).translation();
    Motion before = motion_at(path, -0.5);
    for (double t = -0.48; t < 24.5; t += 0.02) {
      const Motion now = motion_at(path, t);
      EXPECT_LT((path.pose(t).translation() - place).norm(), 0.12) << t;
      EXPECT_LT((now.velocity - before.velocity).norm(), 0.15) << t;
      EXPECT_LT((now.acceleration - before.acceleration).norm(), 0.35) << t;
      place = path.pose(t).translation();
      before = now;
    }
  }
}

/// How far beyond the car's outline the ellipse through p reaches.
double gap_of(const Eigen::Vector2d& p) {
  double low = 0, high = 50;
  while (high - low > 1e-6) {
    const double gap = 0.5 * (low + high);
    const Eigen::Vector2d axes = kCar.array() + gap;
    (p.cwiseQuotient(axes).norm() > 1 ? low : high) = gap;
  }
  return low;
}

TEST(SpiralPath, TheGapToTheObjectGrowsOrShrinksAllTheWay) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SpiralPath path = path_of(seed);
    const auto range = [&](double t) { return gap_of(seen_from_car(path, t).head<2>()); };
    const double way = range(24) > range(0) ? 1 : -1;
    EXPECT_GT(way * (range(18) - range(6)), 0) << seed;
    EXPECT_GT(way * (range(24) - range(12)), 0) << seed;
  }
}

TEST(SpiralPath, GoesBothWaysAroundAndInAndOut) {
  int left = 0, outwards = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const SpiralPath path = path_of(seed);
    const Eigen::Vector3d a = seen_from_car(path, 11), b = seen_from_car(path, 11.2);
    left += a.x() * b.y() - a.y() * b.x() > 0;
    outwards += seen_from_car(path, 24).norm() > seen_from_car(path, 0).norm();
  }
  EXPECT_NEAR(left, 30, 14);
  EXPECT_NEAR(outwards, 30, 14);
}

TEST(SpiralPath, TheSameSeedIsTheSameFlight) {
  EXPECT_TRUE(path_of(3).pose(7.7).isApprox(path_of(3).pose(7.7)));
  EXPECT_FALSE(path_of(3).pose(7.7).isApprox(path_of(4).pose(7.7)));
}

TEST(SpiralPath, IsTheSameFlightWhereverTheObjectStands) {
  core::Rng a(5), b(5);
  const SpiralConfig config;
  const SE3 T = placed(40, -9, 2, 2.2);
  const SpiralPath here(config, SE3::Identity(), kCar, a), there(config, T, kCar, b);
  for (double t = 0; t < 24; t += 1.1)
    EXPECT_LT((there.pose(t).translation() - T * here.pose(t).translation()).norm(), 1e-9);
}

}  // namespace
}  // namespace saker::simulation
