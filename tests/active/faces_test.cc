#include "active/faces.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace saker::active {
namespace {

const Eigen::Vector2d kSize(4.5, 1.8);
constexpr double kHidden = 0.25;

/// Of independent faces, 0.05 m each.
Covariance of_faces() {
  const double face = 0.05 * 0.05;
  return Covariance(Eigen::Vector4d(face / 2, face / 2, 2 * face, 2 * face).asDiagonal());
}

Covariance seen_from(double x, double y, double whole = 1) {
  return by_faces(of_faces(), whole, {x, y}, kSize, {.hidden_m = kHidden});
}

/// Variance of the face on that side of an axis.
double face(const Covariance& covariance, int axis, double sign) {
  Eigen::Vector4d a = Eigen::Vector4d::Zero();
  a[axis] = sign;
  a[2 + axis] = 0.5;
  return a.dot(covariance * a);
}

TEST(Faces, ThoseThatAreLookedAtAreKnownAsTheModelSays) {
  const Covariance oblique = seen_from(8, -6);
  EXPECT_NEAR(face(oblique, 0, 1), 0.05 * 0.05, 1e-9);
  EXPECT_NEAR(face(oblique, 1, -1), 0.05 * 0.05, 1e-9);
}

TEST(Faces, ThoseThatAreNotAreKnownLess) {
  const Covariance oblique = seen_from(8, -6);
  const double hidden = 0.05 * 0.05 + kHidden * kHidden;
  EXPECT_NEAR(face(oblique, 0, -1), hidden, 1e-9);
  EXPECT_NEAR(face(oblique, 1, 1), hidden, 1e-9);
}

TEST(Faces, ThoseThatAreNotAreKnownInWindowsThatShowTheWholeBoxAlone) {
  const Covariance seldom = seen_from(8, -6, 0.25);
  EXPECT_NEAR(face(seldom, 0, 1), 0.05 * 0.05, 1e-9);
  EXPECT_NEAR(face(seldom, 0, -1), 4 * 0.05 * 0.05 + kHidden * kHidden, 1e-9);
}

TEST(Faces, FromBesideNeitherEndIsLookedAt) {
  const Covariance beside = seen_from(0, 7);
  EXPECT_GT(face(beside, 0, 1), kHidden * kHidden);
  EXPECT_GT(face(beside, 0, -1), kHidden * kHidden);
}

TEST(Faces, TheFarSideIsHiddenFromBesideAndHardlyFromAnEnd) {
  const auto far_side = [](double x, double y) {
    return face(by_faces(of_faces(), 1, {x, y}, kSize, {.hidden_side_m = kHidden}), 1, -1);
  };
  EXPECT_NEAR(far_side(0, 7), 0.05 * 0.05 + kHidden * kHidden, 1e-9);
  EXPECT_NEAR(far_side(7, 7), 0.05 * 0.05 + kHidden * kHidden / 4, 1e-9);
  EXPECT_LT(far_side(9, 3), 0.05 * 0.05 + kHidden * kHidden / 50);
}

TEST(Faces, ALookFromTheOtherSideTellsMoreThanOneMoreFromThisSide) {
  const Eigen::Matrix4d first = seen_from(8, -6).inverse();
  const Eigen::Matrix4d beside = seen_from(6, -8).inverse(), across = seen_from(-8, 6).inverse();
  EXPECT_GT((first + across).determinant(), 4 * (first + beside).determinant());
}

TEST(Faces, WithoutHiddenOnesAreTheModels) {
  EXPECT_TRUE(by_faces(of_faces(), 1, {8, -6}, kSize, {}).isApprox(of_faces(), 1e-9));
}

}  // namespace
}  // namespace saker::active
