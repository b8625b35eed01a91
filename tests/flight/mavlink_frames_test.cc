#include <gtest/gtest.h>

#include <numbers>

#include "flight/mavlink/frames.h"

namespace saker::flight::mavlink {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

TEST(MavlinkFrames, UpIsDownLeftIsNotRightAndForwardStays) {
  EXPECT_EQ(flipped(Vector3d(1, 0, 0)), Vector3d(1, 0, 0));
  EXPECT_EQ(flipped(Vector3d(0, 1, 0)), Vector3d(0, -1, 0));
  EXPECT_EQ(flipped(Vector3d(0, 0, 3)), Vector3d(0, 0, -3));
  EXPECT_EQ(flipped(flipped(Vector3d(1, 2, 3))), Vector3d(1, 2, 3));
}

TEST(MavlinkFrames, ALeftTurnOfOursIsANegativeYawOfTheirs) {
  EXPECT_DOUBLE_EQ(flipped_yaw(kPi / 2), -kPi / 2);
  EXPECT_DOUBLE_EQ(flipped_yaw(kPi), kPi);
  EXPECT_DOUBLE_EQ(flipped_yaw(-kPi), kPi);
  EXPECT_NEAR(flipped_yaw(0.3 + 20 * kPi), -0.3, 1e-12);
}

/// A point of the body is at the same place, whichever way it goes.
TEST(MavlinkFrames, RotationsCommuteWithPoints) {
  for (int i = 0; i < 50; ++i) {
    const Quaterniond q = Quaterniond::UnitRandom();
    const Vector3d p = Vector3d::Random();
    EXPECT_LT((flipped(q * p) - flipped(q) * flipped(p)).norm(), 1e-12);
    EXPECT_LT(flipped(flipped(q)).angularDistance(q), 1e-12);
  }
}

TEST(MavlinkFrames, NoseUpIsAPositivePitchOfTheirsAndRightDownAPositiveRoll) {
  // Nose up: the forward axis points up in our world.
  EXPECT_GT((rotation_of_angles(0, 0.2, 0) * Vector3d::UnitX()).z(), 0.1);
  // Right side down: the left axis points up.
  EXPECT_GT((rotation_of_angles(0.2, 0, 0) * Vector3d::UnitY()).z(), 0.1);
  // A positive yaw of theirs turns right.
  EXPECT_LT((rotation_of_angles(0, 0, 0.2) * Vector3d::UnitX()).y(), -0.1);
}

TEST(MavlinkFrames, QuaternionsOnTheWireAreUnitAndComeBack) {
  for (int i = 0; i < 200; ++i) {
    const Quaterniond q = Quaterniond::UnitRandom();
    const auto wire = wire_quaternion(Quaterniond(q.coeffs() * 1.0004));
    double norm = 0;
    for (const float v : wire) norm += static_cast<double>(v) * static_cast<double>(v);
    EXPECT_NEAR(std::sqrt(norm), 1, 1e-6);
    EXPECT_GE(wire[0], 0);
    const WireRotation back = rotation_of(wire[0], wire[1], wire[2], wire[3]);
    EXPECT_TRUE(back.valid);
    EXPECT_LT(back.q.angularDistance(flipped(q)), 1e-6);
  }
  EXPECT_FALSE(rotation_of(0, 0, 0, 0).valid);
  EXPECT_FALSE(rotation_of(NAN, 0, 0, 1).valid);
  EXPECT_FALSE(rotation_of(1.1F, 0, 0, 0).valid);
}

/// Against samples: small perturbations of a pose, moved to their frames one by one.
TEST(MavlinkFrames, CovariancesAreThoseOfMovedSamples) {
  const Matrix6d root = Matrix6d::Random() * 1e-4;
  const Matrix6d covariance = root * root.transpose();
  SE3 T = SE3::Identity();
  T.linear() = AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  T.translation() = Vector3d(3, -2, 5);
  Matrix6d moved = Matrix6d::Zero();
  for (int column = 0; column < 6; ++column) {  // columns of the root are a set of samples
    const SE3 off = T * core::se3_exp(root.col(column));
    Vector6d difference;
    difference << flipped(Vector3d(off.translation() - T.translation())),
        core::so3_log(flipped(Quaterniond(T.rotation())).toRotationMatrix().transpose() *
                      flipped(Quaterniond(off.rotation())).toRotationMatrix());
    moved += difference * difference.transpose();
  }
  const auto wire = wire_covariance(covariance, T.rotation());
  std::size_t at = 0;
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column)
      EXPECT_NEAR(static_cast<double>(wire[at++]), moved(row, column), 1e-3 * moved.norm());
}

}  // namespace
}  // namespace saker::flight::mavlink
