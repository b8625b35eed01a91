#include "saker/odometry/column_search.h"

#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::odometry {
namespace {

SE3 pose(double x, double y, double heading) {
  SE3 T = SE3::Identity();
  T.translation() << x, y, 2;
  T.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

/// A street in which no house is as long as another.
testing::MadeWorld uneven_street() {
  testing::MadeWorld world;
  const double lengths[] = {7, 12, 9, 14, 6, 11, 8, 13, 10, 6.5, 12.5, 9.5};
  double x = -60;
  for (const double length : lengths) {
    world.boxes.push_back({{x, 8 + 0.3 * length, 0}, {x + length, 16, 8}});
    world.boxes.push_back({{x - 3, -16, 0}, {x + length - 3, -7 - 0.2 * length, 8}});
    world.boxes.push_back({{x + 2, 4, 0}, {x + 2 + 0.4 * length, 5.8, 1.6}});
    x += length;
  }
  return world;
}

std::vector<Eigen::Vector3d> seen_from(const testing::MadeWorld& world, const SE3& T) {
  testing::MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const lidar::Scan scan = testing::scan(
      world, sensor, [&](Time) { return T; }, 100'000'000);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& p : scan.points)
    if (p.allFinite()) points.push_back(p.cast<double>());
  return points;
}

/// Seen from three places along the street.
VoxelMap map_of(const testing::MadeWorld& world) {
  VoxelMap map{VoxelMapConfig{}};
  for (const double x : {-20.0, 0.0, 20.0}) {
    std::vector<Eigen::Vector3d> points = seen_from(world, pose(x, 0, 0));
    for (Eigen::Vector3d& p : points) p = pose(x, 0, 0) * p;
    map.insert(points, 100'000'000);
  }
  return map;
}

PosePrior prior_at(const SE3& T, double sd_m, double sd_rad) {
  PosePrior prior{T};
  Vector6d sd;
  sd << Eigen::Vector3d::Constant(sd_rad), Eigen::Vector3d::Constant(sd_m);
  prior.covariance = sd.cwiseProduct(sd).asDiagonal();
  return prior;
}

class ColumnSearchTest : public ::testing::Test {
 protected:
  const testing::MadeWorld world = uneven_street();
  const VoxelMap map = map_of(world);
  const SE3 truth = pose(9, 1, 1.9);
  const std::vector<Eigen::Vector3d> points = seen_from(world, truth);
};

TEST_F(ColumnSearchTest, TheBestStartIsTheTruthThirtyMetresAndTwoRadiansFromThePrior) {
  const std::vector<SE3> starts =
      ColumnSearch({}).starts(points, prior_at(pose(-21, 4, 0), 20, 1.5), map);
  ASSERT_FALSE(starts.empty());
  const SE3 off = truth.inverse() * starts.front();
  EXPECT_LT(off.translation().norm(), 1.2);
  EXPECT_LT(core::so3_log(off.linear()).norm(), 0.1);
}

TEST_F(ColumnSearchTest, ATiltOfTheSensorIsNoHindrance) {
  SE3 tilted = truth;
  tilted.linear() = truth.linear() * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX());
  const std::vector<SE3> starts =
      ColumnSearch({}).starts(seen_from(world, tilted), prior_at(pose(-21, 4, 0), 20, 1.5), map);
  ASSERT_FALSE(starts.empty());
  EXPECT_LT((starts.front().translation() - truth.translation()).norm(), 1.2);
}

TEST_F(ColumnSearchTest, NothingIsSearchedBeyondWhatThePriorLeavesOpen) {
  const SE3 from = pose(-21, 4, 1.9);
  const double sd_m = 2, cell_m = map.voxel_m();
  const ColumnSearchConfig config;
  const std::vector<SE3> starts =
      ColumnSearch(config).starts(points, prior_at(from, sd_m, 0.01), map);
  ASSERT_FALSE(starts.empty());
  for (const SE3& start : starts) {
    const Eigen::Vector3d off = start.translation() - from.translation();
    EXPECT_LE(off.head<2>().cwiseAbs().maxCoeff(), config.reach_sd * sd_m + cell_m);
  }
}

TEST_F(ColumnSearchTest, StartsAreApart) {
  const auto starts = ColumnSearch({}).starts(points, prior_at(truth, 10, 0.001), map);
  ASSERT_EQ(std::ssize(starts), ColumnSearchConfig{}.kept);
  for (std::size_t a = 0; a < starts.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_GT((starts[a].translation() - starts[b].translation()).cwiseAbs().maxCoeff(),
                3 * map.voxel_m());
}

TEST_F(ColumnSearchTest, WhereItMayNotLookAtAllPlacesItFindsNone) {
  ColumnSearchConfig config;
  config.most_scored = 100;
  EXPECT_TRUE(ColumnSearch(config).starts(points, prior_at(truth, 1e6, 10), map).empty());
}

TEST_F(ColumnSearchTest, WithoutColumnsThereIsNoStart) {
  const PosePrior prior = prior_at(truth, 10, 1);
  EXPECT_TRUE(ColumnSearch({}).starts({}, prior, map).empty());
  EXPECT_TRUE(ColumnSearch({}).starts(points, prior, VoxelMap(VoxelMapConfig{})).empty());
  const std::vector<Eigen::Vector3d> ground =
      seen_from({.boxes = {}, .ground = true}, pose(0, 0, 0));
  EXPECT_TRUE(ColumnSearch({}).starts(ground, prior, map).empty());
  PosePrior unknown = prior;
  unknown.covariance.setConstant(NAN);
  EXPECT_TRUE(ColumnSearch({}).starts(points, unknown, map).empty());
}

}  // namespace
}  // namespace saker::odometry
