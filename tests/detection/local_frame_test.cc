#include "saker/detection/local_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace saker::detection {
namespace {

/// Through (1, 2, 0.5), rising along x and falling along y.
objects::GroundPlane slope() {
  return {Eigen::Vector3d(-0.2, 0.1, 1).normalized(), {1, 2, 0.5}, 3};
}

const Eigen::Vector3d kPoint(4, -1, 3);

TEST(LocalFrame, IsARightHandedRotation) {
  const Eigen::Matrix3d R = local_frame(slope(), kPoint).linear();
  EXPECT_TRUE((R * R.transpose()).isIdentity(1e-12));
  EXPECT_NEAR(R.determinant(), 1, 1e-12);
}

TEST(LocalFrame, HasItsZAxisAlongTheGroundsNormal) {
  EXPECT_TRUE(local_frame(slope(), kPoint).linear().col(2).isApprox(slope().normal, 1e-12));
}

TEST(LocalFrame, HasItsXAxisAsStraightAheadAsThePlaneAllows) {
  const Eigen::Matrix3d R = local_frame(slope(), kPoint).linear();
  for (double angle = 0.1; angle < 6.2; angle += 0.1) {
    const Eigen::Vector3d in_plane = std::cos(angle) * R.col(0) + std::sin(angle) * R.col(1);
    EXPECT_LT(in_plane.x(), R(0, 0)) << angle;
  }
}

TEST(LocalFrame, HasItsOriginOnTheGroundUnderThePoint) {
  const SE3 T_level_local = local_frame(slope(), kPoint);
  EXPECT_NEAR(slope().height_of(T_level_local.translation()), 0, 1e-12);
  const Eigen::Vector3d in_local = T_level_local.inverse() * kPoint;
  EXPECT_LT((in_local - Eigen::Vector3d(0, 0, slope().height_of(kPoint))).norm(), 1e-12);
}

TEST(LocalFrame, HeightInItIsThatAboveThePlane) {
  const SE3 T_local_level = local_frame(slope(), kPoint).inverse();
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-5, 7, 2)}) {
    EXPECT_NEAR((T_local_level * p).z(), slope().height_of(p), 1e-12);
  }
}

TEST(LocalFrame, OfLevelGroundIsNotTurned) {
  const SE3 T = local_frame({Eigen::Vector3d::UnitZ(), {0, 0, 0.3}, 3}, kPoint);
  EXPECT_TRUE(T.linear().isIdentity(1e-12));
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(4, -1, 0.3), 1e-12));
}

}  // namespace
}  // namespace saker::detection
