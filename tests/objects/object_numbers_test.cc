#include "saker/objects/object_numbers.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numeric>

#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::objects {
namespace {

Cuboid cuboid(core::Rng& rng) {
  Vector6d tangent;
  for (double& value : tangent) value = rng.normal(0, 2);
  return {core::se3_exp(tangent), {rng.uniform(1, 9), rng.uniform(1, 3), rng.uniform(1, 4)}};
}

Eigen::MatrixXd covariance(Eigen::Index size, core::Rng& rng) {
  const Eigen::MatrixXd factor =
      Eigen::MatrixXd::NullaryExpr(size, size, [&] { return rng.normal(0, 0.1); });
  return factor * factor.transpose();
}

MapObject object_of(const Model& model, const Eigen::MatrixXd& covariance) {
  MapObject object;
  object.class_id = 1;
  object.model = model;
  object.covariance = covariance;
  return object;
}

TEST(ObjectNumbers, OfACuboidMakeItAgain) {
  core::Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    const Cuboid before = cuboid(rng);
    const Cuboid after = cuboid_of(numbers(before));
    EXPECT_TRUE(after.pose.isApprox(before.pose, 1e-12));
    EXPECT_EQ(after.size, before.size);
  }
}

TEST(ObjectNumbers, OfACylinderMakeItAgain) {
  const Cylinder before{{1, 2, 3}, Eigen::Vector3d(0.1, -0.2, 1).normalized(), 0.2, 4};
  const Cylinder after = cylinder_of(numbers(before));
  EXPECT_EQ(after.root, before.root);
  EXPECT_TRUE(after.axis.isApprox(before.axis, 1e-12));
  EXPECT_EQ(after.radius, before.radius);
  EXPECT_EQ(after.height, before.height);
}

TEST(ObjectNumbers, ARotationHasOneQuaternionOfBoth) {
  core::Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    const CuboidNumbers values = numbers(cuboid(rng));
    EXPECT_GE(values[6], 0) << "w";
    EXPECT_NEAR(values.segment<4>(3).norm(), 1, 1e-12);
  }
}

TEST(ObjectNumbers, RotationsAndAxesAreNormalised) {
  CuboidNumbers doubled = numbers(Cuboid{SE3::Identity(), {4, 2, 1}});
  doubled.segment<4>(3) *= 2;
  EXPECT_TRUE(cuboid_of(doubled).pose.linear().isIdentity(1e-12));
  CylinderNumbers longer = numbers(Cylinder{{0, 0, 0}, {0, 0, 1}, 0.1, 2});
  longer.segment<3>(3) *= 5;
  EXPECT_NEAR(cylinder_of(longer).axis.norm(), 1, 1e-12);
}

TEST(ObjectNumbers, AreRoundedToAMicrometre) {
  EXPECT_DOUBLE_EQ(rounded(1.23456749), 1.234567);
  EXPECT_DOUBLE_EQ(rounded(-1.2345678), -1.234568);
  EXPECT_FALSE(std::signbit(rounded(-1e-9))) << "no negative zero";
  EXPECT_EQ(rounded(rounded(0.1 + 0.2)), rounded(0.3));
  EXPECT_THROW((void)rounded(NAN), Error);
  EXPECT_THROW((void)rounded(INFINITY), Error);
}

TEST(ObjectNumbers, KeepDeviationsAndWhatPlaceAndSizeShare) {
  core::Rng rng(3);
  for (int i = 0; i < 20; ++i) {
    const MapObject object = object_of(cuboid(rng), covariance(9, rng));
    const CovarianceNumbers values = covariance_numbers(object);
    ASSERT_EQ(values.size(), 15);
    const Eigen::MatrixXd again = covariance_of(object.model, values);
    EXPECT_TRUE(again.diagonal().isApprox(object.covariance.diagonal(), 1e-12));
    for (const int a : {3, 4, 6, 7}) {
      for (const int b : {3, 4, 6, 7}) {
        EXPECT_NEAR(again(a, b), object.covariance(a, b), 1e-12) << a << " " << b;
      }
    }
    EXPECT_GT(again.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12);
  }
}

TEST(ObjectNumbers, OfACylinderKeepWhatXAndYShare) {
  core::Rng rng(4);
  const MapObject object = object_of(Cylinder{}, covariance(6, rng));
  const CovarianceNumbers values = covariance_numbers(object);
  ASSERT_EQ(values.size(), 7);
  const Eigen::MatrixXd again = covariance_of(object.model, values);
  EXPECT_NEAR(again(0, 1), object.covariance(0, 1), 1e-12);
  EXPECT_EQ(again(2, 5), 0);
}

TEST(ObjectNumbers, OfACovarianceThatIsNoneAreStillCorrelations) {
  Matrix9d wrong = Matrix9d::Identity();
  wrong(3, 4) = wrong(4, 3) = 5;
  wrong(8, 8) = -1;
  wrong(6, 6) = 0;
  const CovarianceNumbers values = covariance_numbers(object_of(Cuboid{}, wrong));
  EXPECT_LE(values.tail(6).cwiseAbs().maxCoeff(), 1);
  EXPECT_EQ(values[8], 0);
  EXPECT_TRUE(values.allFinite());
}

TEST(ObjectNumbers, ACovarianceThatIsNotFiniteIsNone) {
  EXPECT_FALSE(has_covariance(object_of(Cuboid{}, {})));
  EXPECT_FALSE(has_covariance(object_of(Cuboid{}, Matrix9d::Constant(NAN))));
  EXPECT_TRUE(has_covariance(object_of(Cuboid{}, Matrix9d::Identity())));
}

TEST(ObjectNumbers, WhatAFileDoesNotSayIsSpreadOverTheOtherClasses) {
  const ClassTable table;
  const std::vector<double> all = spread(0.8, 1, table);
  ASSERT_EQ(all.size(), 5u);
  EXPECT_EQ(all[1], 0.8);
  EXPECT_NEAR(all[0], 0.05, 1e-12);
  EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 1, 1e-12);
  MapObject object = object_of(Cuboid{}, {});
  EXPECT_EQ(probability_of(object), 1) << "nobody doubts it";
  object.class_probability = all;
  EXPECT_EQ(probability_of(object), 0.8);
}

}  // namespace
}  // namespace saker::objects
