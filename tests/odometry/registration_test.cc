#include "saker/odometry/registration.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "saker/core/rng.h"

namespace saker::odometry {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Points of the faces x = 0.3, y = 0.3 and z = 0.3 of a room's corner, as many as asked for.
Points faces(std::initializer_list<int> axes, double noise, std::uint64_t seed) {
  core::Rng rng(seed);
  Points points;
  for (const int axis : axes) {
    for (int i = 0; i < 4000; ++i) {
      Eigen::Vector3d p(rng.uniform(0.4, 5), rng.uniform(0.4, 5), rng.uniform(0.4, 5));
      p[axis] = 0.3 + rng.normal(0, noise);
      points.push_back(p);
    }
  }
  return points;
}

VoxelMap map_of(const Points& points) {
  VoxelMap map(VoxelMapConfig{});
  map.insert(points, 0);
  return map;
}

SE3 offset(double angle, const Eigen::Vector3d& translation) {
  SE3 T = SE3(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 2) / 3));
  T.translation() = translation;
  return T;
}

/// Every so many, seen from T.
Points scan(const Points& world, const SE3& T, std::size_t stride = 9) {
  Points points;
  for (std::size_t i = 0; i < world.size(); i += stride) points.push_back(T.inverse() * world[i]);
  return points;
}

PosePrior prior(double sd) { return {SE3::Identity(), sd * sd * Matrix6d::Identity()}; }

RegistrationResult aligned(const Points& points, const PosePrior& prior, VoxelMap map,
                           double gate_m = 1) {
  return Registration({}).align(points, prior, prior.T_odom_lidar, map, gate_m);
}

double distance(const SE3& a, const SE3& b) { return core::se3_log(a.inverse() * b).norm(); }

TEST(Registration, FindsThePoseFromWhichACornerWasSeen) {
  const Points world = faces({0, 1, 2}, 0, 1);
  for (const SE3& T : {offset(0, {0.1, 0.05, -0.08}), offset(0.03, {-0.05, 0.1, 0.02})}) {
    const RegistrationResult result = aligned(scan(world, T), prior(1), map_of(world));
    EXPECT_LT(distance(result.T_odom_lidar, T), 2e-3);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(result.rms_m, 0.005);
  }
}

/// Two smooth walls and the ground, as a sensor with noise leaves them in the map.
TEST(Registration, NoiseOfSmoothWallsHoldsNothingAlongThem) {
  core::Rng rng(8);
  const auto hall = [&] {
    Points points;
    for (int i = 0; i < 30000; ++i) {
      const double x = rng.uniform(-20, 20), noise = rng.normal(0, 0.02);
      if (i % 3 == 0) points.emplace_back(x, 4.3 + noise, rng.uniform(0, 5));
      if (i % 3 == 1) points.emplace_back(x, -4.3 + noise, rng.uniform(0, 5));
      if (i % 3 == 2) points.emplace_back(x, rng.uniform(-4, 4), 0.3 + noise);
    }
    return points;
  };
  const RegistrationResult result =
      aligned(scan(hall(), SE3::Identity(), 7), prior(0.5), map_of(hall()));
  EXPECT_GT(std::sqrt(result.held_covariance(3, 3)), 0.4);   // of the prior's 0.5
  EXPECT_LT(std::sqrt(result.held_covariance(4, 4)), 0.02);  // across
  EXPECT_LT(result.T_odom_lidar.translation().tail<2>().norm(), 0.01);
}

TEST(Registration, AWallAcrossHoldsAlongToo) {
  const RegistrationResult result = aligned(scan(faces({0, 1, 2}, 0.02, 6), SE3::Identity()),
                                            prior(0.5), map_of(faces({0, 1, 2}, 0.02, 7)));
  for (int i = 3; i < 6; ++i) EXPECT_LT(std::sqrt(result.held_covariance(i, i)), 0.02);
}

TEST(Registration, RmsIsTheNoiseOfTheScan) {
  const RegistrationResult result = aligned(scan(faces({0, 1, 2}, 0.02, 3), SE3::Identity()),
                                            prior(1), map_of(faces({0, 1, 2}, 0, 2)));
  EXPECT_NEAR(result.rms_m, 0.02, 0.005);
}

TEST(Registration, IsTheSameAFewVoxelsFartherOn) {
  const Points world = faces({0, 1, 2}, 0, 4);
  const SE3 T = offset(0.02, {0.06, 0, 0.05});
  const RegistrationResult here = aligned(scan(world, T), prior(1), map_of(world));
  const Eigen::Vector3d shift(12, -6, 3);  // of voxels of 0.6 m
  Points moved = world;
  for (Eigen::Vector3d& p : moved) p += shift;
  PosePrior start = prior(1);
  start.T_odom_lidar.translation() = shift;
  RegistrationResult there = aligned(scan(world, T), start, map_of(moved));
  there.T_odom_lidar.translation() -= shift;
  EXPECT_LT(distance(there.T_odom_lidar, here.T_odom_lidar), 1e-4);
}

TEST(Registration, WhatThePlanesLeaveOpenThePriorDecides) {
  const Points ground = faces({2}, 0, 5);
  const SE3 T = offset(0, {0.2, 0.1, 0.1});
  const RegistrationResult result = aligned(scan(ground, T), prior(0.3), map_of(ground));
  EXPECT_NEAR(result.T_odom_lidar.translation().z(), 0.1, 1e-3);
  EXPECT_NEAR(result.T_odom_lidar.translation().x(), 0, 1e-3) << "as the prior says";
  EXPECT_NEAR(result.covariance(3, 3), 0.09, 0.005);
  EXPECT_NEAR(result.covariance(4, 4), 0.09, 0.005);
  EXPECT_LT(result.covariance(5, 5), 1e-3);
}

TEST(Registration, WithoutAMapThePoseIsThePrior) {
  VoxelMap empty(VoxelMapConfig{});
  const Points points = scan(faces({0, 1, 2}, 0, 6), SE3::Identity());
  const RegistrationResult result = aligned(points, prior(0.2), empty);
  EXPECT_EQ(result.inliers, 0);
  EXPECT_LT(distance(result.T_odom_lidar, SE3::Identity()), 1e-12);
  EXPECT_TRUE(result.covariance.isApprox(0.04 * Matrix6d::Identity(), 1e-9));
  EXPECT_FALSE(Registration({}).trustworthy(result, points.size()));
}

TEST(Registration, OutliersOnNoPlaneMoveItLittle) {
  const Points world = faces({0, 1, 2}, 0, 7);
  const SE3 T = offset(0.01, {0.05, 0.03, 0});
  Points points = scan(world, T);
  const std::size_t clean = points.size();
  core::Rng rng(8);
  for (std::size_t i = 0; i < clean / 4; ++i) {  // up to 0.3 m before a face
    points.push_back(points[i] + Eigen::Vector3d(rng.uniform(0, 0.3), rng.uniform(0, 0.3), 0.1));
  }
  EXPECT_LT(distance(aligned(points, prior(1), map_of(world)).T_odom_lidar, T), 0.01);
}

TEST(Registration, WhatLiesOnPlanesSeenEarlyIsCountedApart) {
  const Points early = faces({0, 1}, 0, 9), late = faces({2}, 0, 10);
  VoxelMap map = map_of(early);
  map.insert(late, 100);
  Points points = scan(early, SE3::Identity());
  const auto of_early = static_cast<double>(points.size());
  for (const Eigen::Vector3d& point : scan(late, SE3::Identity())) points.push_back(point);
  const auto all = static_cast<double>(points.size());
  Registration registration({});
  const auto result = registration.align(points, prior(0.1), SE3::Identity(), map, 1, 100);
  EXPECT_GT(result.inliers, 0.8 * all);  // edges are on no plane
  EXPECT_NEAR(result.established / static_cast<double>(result.inliers), of_early / all, 0.02);
}

TEST(Registration, CovarianceIsSymmetricAndPositiveAndCoversTheErrors) {
  const VoxelMap map = map_of(faces({0, 1, 2}, 0.01, 9));
  double squared = 0;
  constexpr int kRuns = 25;
  for (int run = 0; run < kRuns; ++run) {
    const Points points = scan(faces({0, 1, 2}, 0.02, 100 + run), SE3::Identity(), 40);
    const RegistrationResult result = aligned(points, prior(1), map);
    EXPECT_LT((result.covariance - result.covariance.transpose()).norm(), 1e-12);
    EXPECT_GT(result.covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
    const Vector6d error = core::se3_log(result.T_odom_lidar);
    squared += error.dot(result.covariance.ldlt().solve(error)) / (6 * kRuns);
  }
  EXPECT_LT(squared, 1.5);
  EXPECT_GT(squared, 0.01);
}

TEST(Registration, DeviationIsCountedInThePriorsStandardDeviations) {
  const Points world = faces({0, 1, 2}, 0, 10);
  const SE3 T = offset(0, {0.12, 0, 0});
  const RegistrationResult result = aligned(scan(world, T), prior(0.1), map_of(world));
  EXPECT_NEAR(result.deviation_sd, 1.2 / std::sqrt(6.0), 0.03);
}

TEST(Registration, IsTrustedWhereItFitsAndNowhereElse) {
  const Points world = faces({0, 1, 2}, 0, 11);
  const Points points = scan(world, SE3::Identity());
  const Registration registration({});
  const RegistrationConfig config;
  const RegistrationResult good = aligned(points, prior(1), map_of(world));
  EXPECT_TRUE(registration.trustworthy(good, points.size()));
  const auto refused = [&](auto spoil) {
    RegistrationResult result = good;
    spoil(result);
    return !registration.trustworthy(result, points.size());
  };
  EXPECT_TRUE(refused([&](auto& r) { r.inliers = config.min_inliers - 1; }));
  EXPECT_TRUE(refused([&](auto& r) { r.rms_m = 1.01 * config.max_rms_m; }));
  EXPECT_TRUE(refused([&](auto& r) { r.deviation_sd = 1.01 * config.max_deviation_sd; }));
  EXPECT_TRUE(refused([&](auto& r) { r.covariance(2, 2) = NAN; }));
  EXPECT_FALSE(registration.trustworthy(good, 1000 * points.size())) << "a small share of them";
}

TEST(Registration, NeedsAsManyPointsAsInliers) {
  const auto least = static_cast<std::size_t>(RegistrationConfig().min_inliers);
  EXPECT_TRUE(Registration({}).enough(least));
  EXPECT_FALSE(Registration({}).enough(least - 1));
}

}  // namespace
}  // namespace saker::odometry
