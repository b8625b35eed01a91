#include "saker/active/belief/faces.h"

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

Measured seen_from(double x, double y, double whole = 1) {
  return by_faces(of_faces(), whole, {x, y}, kSize,
                  {.hidden_end_m = kHidden, .hidden_side_m = kHidden});
}

/// Variance of the face on that side of an axis.
double face(const Covariance& covariance, int axis, double sign) {
  Eigen::Vector4d a = Eigen::Vector4d::Zero();
  a[axis] = sign;
  a[2 + axis] = 0.5;
  return a.dot(covariance * a);
}

Belief after(const std::vector<Measured>& views) {
  Belief belief(10 * Eigen::Matrix4d::Identity(), Eigen::Matrix4d::Zero());
  for (const Measured& view : views) belief.add(information_of(view, 0));
  return belief;
}

TEST(Faces, ThoseThatAreLookedAtAreKnownAsTheModelSaysAndTheOthersHidden) {
  const Measured oblique = seen_from(8, -6);
  EXPECT_TRUE(oblique.covariance.isApprox(of_faces(), 1e-9));
  EXPECT_EQ(oblique.hidden[0], 0);  // front
  EXPECT_EQ(oblique.hidden[1], kHidden);
  EXPECT_NEAR(oblique.hidden[2], 0.36 * kHidden, 1e-9);  // left
  EXPECT_EQ(oblique.hidden[3], 0);
}

TEST(Faces, ThoseThatAreNotAreKnownInWindowsThatShowTheWholeBoxAlone) {
  const Measured seldom = seen_from(8, -6, 0.25);
  EXPECT_NEAR(face(seldom.covariance, 0, 1), 0.05 * 0.05, 1e-9);
  EXPECT_NEAR(face(seldom.covariance, 0, -1), 4 * 0.05 * 0.05, 1e-9);
}

TEST(Faces, FromBesideNeitherEndIsLookedAtAndTheFarSideIsHidden) {
  EXPECT_EQ(seen_from(0, 7).hidden, Eigen::Vector4d(kHidden, kHidden, 0, kHidden));
}

TEST(Faces, FromAnEndTheSidesAreHardlyHidden) { EXPECT_LT(seen_from(9, 3).hidden[3], kHidden / 9); }

TEST(Faces, ManyLooksFromOneSideDoNotTellWhereTheHiddenEndIs) {
  const Belief behind = after(std::vector<Measured>(1000, seen_from(-8, 6)));
  EXPECT_NEAR(face(Covariance(behind.covariance()), 0, 1), kHidden * kHidden, 1e-3);
  EXPECT_LT(face(Covariance(behind.covariance()), 0, -1), 1e-4);
}

TEST(Faces, ALookFromTheOtherSideTellsMoreThanOneMoreFromThisSide) {
  const Measured first = seen_from(8, -6), beside = seen_from(6, -8), across = seen_from(-8, 6);
  EXPECT_LT(after({first, across}).entropy(), after({first, beside}).entropy() - 1);
}

TEST(Faces, WithoutHiddenOnesAreTheModels) {
  const Measured measured = by_faces(of_faces(), 1, {8, -6}, kSize, {});
  EXPECT_TRUE(measured.covariance.isApprox(of_faces(), 1e-9));
  EXPECT_EQ(measured.hidden, Eigen::Vector4d::Zero());
}

}  // namespace
}  // namespace saker::active
