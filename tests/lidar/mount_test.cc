#include "saker/lidar/mount.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

TEST(Mount, TurnsByYaw) {
  const SE3 T = mount_pose({{1, 2, 3}, {0, 0, 90}});
  EXPECT_TRUE((T * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(1, 3, 3)));
}

TEST(Mount, TurnsAboutZThenYThenX) {
  const SE3 T = mount_pose({{1, 2, 3}, {90, 0, 90}});
  EXPECT_LT((T * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(1, 3, 3)).norm(), 1e-12);
  EXPECT_LT((T * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(2, 2, 3)).norm(), 1e-12);
}

TEST(Mount, TakesThreeNumbersEach) {
  EXPECT_THROW((void)mount_pose({{1, 2}, {0, 0, 0}}), Error);
  EXPECT_THROW((void)mount_pose({{1, 2, 3}, {0}}), Error);
}

TEST(Mount, PitchIsPositiveWithTheNoseDown) {
  const SE3 T = mount_pose({{0, 0, 0}, {0, 10, 0}});
  EXPECT_LT((T * Eigen::Vector3d::UnitX()).z(), -0.17);
}

TEST(Mount, KeepsLengthsAndHands) {
  const SE3 T = mount_pose({{1, 2, 3}, {31, -12, 170}});
  EXPECT_TRUE((T.linear().transpose() * T.linear()).isIdentity(1e-12));
  EXPECT_NEAR(T.linear().determinant(), 1, 1e-12);
}

}  // namespace
}  // namespace saker::lidar
