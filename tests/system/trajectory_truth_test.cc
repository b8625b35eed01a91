#include "tools/saker/replay/trajectory_truth.h"

#include <gtest/gtest.h>

#include <fstream>

#include "saker/core/error.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

fs::path written(const std::string& text) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path file = fs::path(testing::TempDir()) / (test + ".trajectory.txt");
  std::ofstream(file) << text;
  return file;
}

StampedPose at(double t, double x, double yaw = 0) {
  SE3 T(Eigen::Translation3d(x, 0, 0));
  T.linear() = core::so3_exp({0, 0, yaw});
  return {t, T};
}

autonomy::ScanRecord scan_at(double t) {
  autonomy::ScanRecord scan;
  scan.stamp = from_seconds(t);
  return scan;
}

TEST(ReadTrajectory, RowsAreTimePlaceAndQuaternion) {
  const auto poses =
      read_trajectory(written("1.5 1 2 3 0 0 0.7071067811865476 0.7071067811865476\n"));
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].t, 1.5);
  EXPECT_EQ(poses[0].T_world_lidar.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(core::yaw(poses[0].T_world_lidar.linear()), M_PI / 2, 1e-9);
}

TEST(ReadTrajectory, CommentsAndEmptyLinesAreNoRows) {
  EXPECT_EQ(read_trajectory(written("# t x y z\n\n1 0 0 0 0 0 0 1\n\n")).size(), 1U);
}

TEST(ReadTrajectory, PosesAreInTheOrderOfTime) {
  const auto poses =
      read_trajectory(written("3 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n"));
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].t, 1);
  EXPECT_EQ(poses[2].t, 3);
}

TEST(ReadTrajectory, AQuaternionNeedNotBeOfUnitLength) {
  const auto poses = read_trajectory(written("1 0 0 0 0 0 0 5\n"));
  EXPECT_TRUE(poses.at(0).T_world_lidar.linear().isIdentity(1e-12));
}

TEST(ReadTrajectory, AMissingFileHasNoPoses) {
  EXPECT_TRUE(read_trajectory("/nowhere/trajectory.txt").empty());
}

TEST(ReadTrajectory, AMalformedRowIsNamedByItsLine) {
  const fs::path file = written("# comment\n1 0 0 0 0 0 0 1\n\n2 0 0 zero 0 0 0 1\n");
  try {
    (void)read_trajectory(file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("trajectory.txt:4:"), std::string::npos)
        << error.what();
  }
}

TEST(PoseAt, IsThatOfTheStampToAMillisecond) {
  const std::vector<StampedPose> poses = {at(1, 10), at(2, 20), at(3, 30)};
  ASSERT_NE(pose_at(poses, 2.0009), nullptr);
  EXPECT_EQ(pose_at(poses, 2.0009)->T_world_lidar.translation().x(), 20);
  EXPECT_EQ(pose_at(poses, 1.9991)->t, 2);
  EXPECT_EQ(pose_at(poses, 2.002), nullptr);
  EXPECT_EQ(pose_at(poses, 0), nullptr);
  EXPECT_EQ(pose_at({}, 1), nullptr);
}

TEST(TrajectoryFigures, WhatIsOffByAConstantHasThatError) {
  const std::vector<StampedPose> truth = {at(1, 0), at(2, 1), at(3, 2)};
  const std::vector<autonomy::ScanRecord> scans = {scan_at(1), scan_at(2), scan_at(3)};
  const std::vector<SE3> poses = {at(1, 0.3).T_world_lidar, at(2, 1.3).T_world_lidar,
                                  at(3, 2.3).T_world_lidar};
  const auto figures = trajectory_figures(scans, poses, truth);
  EXPECT_EQ(figures["scans_compared"], 3);
  EXPECT_NEAR(figures["position_rmse_m"].get<double>(), 0.3, 1e-9);
  EXPECT_NEAR(figures["position_max_m"].get<double>(), 0.3, 1e-9);
  EXPECT_NEAR(figures["rotation_rmse_deg"].get<double>(), 0, 1e-9);
}

TEST(TrajectoryFigures, TheGreatestErrorIsThatOfOneScan) {
  const std::vector<StampedPose> truth = {at(1, 0), at(2, 0), at(3, 0), at(4, 0)};
  const std::vector<autonomy::ScanRecord> scans = {scan_at(1), scan_at(2), scan_at(3), scan_at(4)};
  std::vector<SE3> poses(4, SE3::Identity());
  poses[2] = at(3, 0.8).T_world_lidar;
  const auto figures = trajectory_figures(scans, poses, truth);
  EXPECT_NEAR(figures["position_max_m"].get<double>(), 0.8, 1e-9);
  EXPECT_NEAR(figures["position_rmse_m"].get<double>(), 0.4, 1e-9);
}

TEST(TrajectoryFigures, RotationsAreInDegrees) {
  const std::vector<StampedPose> truth = {at(1, 0), at(2, 0)};
  const std::vector<autonomy::ScanRecord> scans = {scan_at(1), scan_at(2)};
  const double turn = 2 * M_PI / 180;
  const std::vector<SE3> poses = {at(1, 0, turn).T_world_lidar, at(2, 0, -turn).T_world_lidar};
  EXPECT_NEAR(trajectory_figures(scans, poses, truth)["rotation_rmse_deg"].get<double>(), 2, 1e-9);
}

TEST(TrajectoryFigures, ScansThatTheTruthDoesNotHaveDoNotCount) {
  const std::vector<StampedPose> truth = {at(1, 0)};
  const std::vector<autonomy::ScanRecord> scans = {scan_at(1), scan_at(1.5)};
  const std::vector<SE3> poses = {SE3::Identity(), at(1.5, 99).T_world_lidar};
  const auto figures = trajectory_figures(scans, poses, truth);
  EXPECT_EQ(figures["scans_compared"], 1);
  EXPECT_EQ(figures["position_max_m"], 0);
}

TEST(TrajectoryFigures, WithoutACommonStampTheyAreNull) {
  EXPECT_TRUE(trajectory_figures({}, {}, {at(1, 0)}).is_null());
}

}  // namespace
}  // namespace saker::tools
