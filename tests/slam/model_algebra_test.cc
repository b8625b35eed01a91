#include "saker/slam/model_algebra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "saker/core/rng.h"

namespace saker::slam {
namespace {

using objects::Cuboid;
using objects::Cylinder;

Cuboid car(double yaw, double length = 4.4, double width = 1.8) {
  return {core::se3_exp((Vector6d() << 0, 0, yaw, 5, 2, 0.7).finished()), {length, width, 1.5}};
}

Cylinder trunk() { return {{7, -3, 0.2}, Eigen::Vector3d(0.1, -0.05, 1).normalized(), 0.17, 3}; }

Vector9d cuboid_step() {
  return (Vector9d() << 0.1, -0.05, 0.3, 0.4, -0.2, 0.1, 0.3, -0.2, 0.1).finished();
}

TEST(ModelAlgebra, DifferenceUndoesStep) {
  const Vector6d step = (Vector6d() << 0.4, -0.2, 0.1, 0.1, -0.05, 0.03).finished();
  EXPECT_LT((difference(moved(car(1), cuboid_step()), car(1)) - cuboid_step()).norm(), 1e-12);
  EXPECT_LT((difference(moved(trunk(), step), trunk()) - step).norm(), 1e-12);
}

TEST(ModelAlgebra, HeadingIsTurnedToTheNearest) {
  constexpr double kPi = std::numbers::pi;
  EXPECT_EQ(nearest_turn(car(0.2), car(0.1)), 0);
  EXPECT_EQ(nearest_turn(car(0.1 + kPi), car(0)), 2);
  EXPECT_EQ(nearest_turn(car(-0.9 * kPi), car(0.9 * kPi)), 0);
}

TEST(ModelAlgebra, QuarterTurnBringsTheHeadingWithinAnEighth) {
  for (double yaw = -3.1; yaw < 3.1; yaw += 0.2) {
    const Cuboid near = turned(car(yaw), nearest_turn(car(yaw), car(0.4)));
    const double left = core::yaw(near.pose.linear().transpose() * car(0.4).pose.linear());
    EXPECT_LE(std::abs(left), std::numbers::pi / 4 + 1e-9) << yaw;
  }
}

TEST(ModelAlgebra, TurnedCuboidFillsTheSameSpace) {
  const Cuboid a = car(0.3);
  for (int quarters = 0; quarters < 4; ++quarters) {
    const Cuboid b = turned(a, quarters);
    for (const Eigen::Vector3d& corner :
         {Eigen::Vector3d(2.1, 0.8, 0), Eigen::Vector3d(-2.1, -0.8, 0)}) {
      EXPECT_TRUE(on_footprint(b, a.pose * corner)) << quarters;
    }
    EXPECT_FALSE(on_footprint(b, a.pose * Eigen::Vector3d(0, 1.1, 0))) << quarters;
    EXPECT_TRUE(turned(b, 4 - quarters).pose.isApprox(a.pose, 1e-12));
  }
}

TEST(ModelAlgebra, OverlapOfFootprintsIsTheirSharedAreaOfTheSmallerOne) {
  const auto at = [](double x, double y, double yaw) {
    Cuboid placed = car(0);
    placed.pose = SE3(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    placed.pose.translation() = Eigen::Vector3d(x, y, 0.7);
    return placed;
  };
  const Eigen::Vector2d size = car(0).size.head<2>();
  EXPECT_NEAR(footprint_overlap(at(5, 2, 0), at(5, 2, 0)), 1, 1e-12);
  EXPECT_NEAR(footprint_overlap(at(0, 0, 0), at(size.x() / 4, size.y() / 2, 0)), 0.375, 1e-12);
  const double crossed = size.y() / size.x();  // they share a square
  EXPECT_NEAR(footprint_overlap(at(5, 2, 0), at(5, 2, std::numbers::pi / 2)), crossed, 1e-12);
  EXPECT_EQ(footprint_overlap(at(0, 0, 0), at(0, size.y() + 0.01, 0)), 0);
  EXPECT_NEAR(footprint_overlap(at(0, 0, 0), at(1, 1, 0.6)),
              footprint_overlap(at(1, 1, 0.6), at(0, 0, 0)), 1e-12);
}

/// The covariance turns with the frame: the same step of the same box has the same distance.
TEST(ModelAlgebra, TurnKeepsTheMahalanobisDistance) {
  Matrix9d A;
  for (int i = 0; i < 81; ++i) A(i / 9, i % 9) = std::sin(1.0 + 3 * i);
  const Gaussian measured{car(0.3), A * A.transpose() + Matrix9d::Identity()};
  const Model other = moved(car(0.3), cuboid_step());
  const auto distance = [](const Gaussian& g, const Model& m) {
    const Eigen::VectorXd step = difference(m, g.model);
    return step.dot(g.covariance.llt().solve(step));
  };
  for (int quarters = 1; quarters < 4; ++quarters) {
    const Model turned_other = turned(std::get<Cuboid>(other), quarters);
    EXPECT_NEAR(distance(turned(measured, quarters), turned_other), distance(measured, other),
                1e-9);
  }
}

TEST(ModelAlgebra, FrontEvidenceTurnsWithTheFrame) {
  const Cuboid a = car(0);
  for (int quarters = 0; quarters < 4; ++quarters) {
    const Eigen::Vector2d front = turned(Eigen::Vector2d(1, 0), quarters);
    const Eigen::Vector3d direction =
        turned(a, quarters).pose.linear() * Eigen::Vector3d(front.x(), front.y(), 0);
    EXPECT_TRUE(direction.isApprox(a.pose.linear().col(0), 1e-9)) << quarters;
  }
}

TEST(ModelAlgebra, EndVariancesAreThoseOfCentreLessAndPlusHalfTheSize) {
  Matrix9d covariance = Matrix9d::Identity();
  const double low = 0.04, high = 0.25;  // independent ends along y
  covariance(4, 4) = 0.25 * (low + high);
  covariance(4, 7) = covariance(7, 4) = 0.5 * (high - low);
  covariance(7, 7) = low + high;
  EXPECT_TRUE(end_variances(covariance, 1).isApprox(Eigen::Vector2d(low, high)));
}

TEST(ModelAlgebra, AnEndIsMadeWorseKnownAndTheOtherStays) {
  Eigen::MatrixXd covariance = 0.3 * Matrix9d::Identity();
  raise_end_variances(covariance, 0, {0.01, 0.8});
  EXPECT_TRUE(end_variances(covariance, 0).isApprox(Eigen::Vector2d(0.375, 0.8)));
  EXPECT_TRUE(end_variances(covariance, 1).isApprox(Eigen::Vector2d(0.375, 0.375)));
  EXPECT_EQ(covariance.llt().info(), Eigen::Success);
}

TEST(ModelAlgebra, FusionIsTheInformationWeightedMean) {
  const Matrix9d covariance = 0.04 * Matrix9d::Identity();
  const Model b = moved(car(0), 1e-3 * cuboid_step());
  const Gaussian both = fused({car(0), covariance}, {b, 3 * covariance});
  EXPECT_LT((difference(both.model, car(0)) - 0.25e-3 * cuboid_step()).norm(), 1e-9);
  EXPECT_LT((both.covariance - 0.75 * covariance).norm(), 1e-12);
}

/// Sampled: the covariance of a measurement that is carried by an uncertain motion.
void expect_sampled_covariance(const Gaussian& in_a, const SE3& T_b_a, const Matrix6d& motion) {
  const Gaussian in_b = transformed(T_b_a, motion, in_a);
  const Eigen::Index size = in_a.covariance.rows();
  const Eigen::MatrixXd L = in_a.covariance.llt().matrixL(), M = motion.llt().matrixL();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  core::Rng rng(3);
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::VectorXd step =
        L * Eigen::VectorXd::NullaryExpr(size, [&] { return rng.normal(); });
    const Vector6d jolt = M * Vector6d::NullaryExpr([&] { return rng.normal(); });
    const Model sample = objects::transformed(T_b_a * core::se3_exp(jolt), moved(in_a.model, step));
    const Eigen::VectorXd error = difference(sample, in_b.model);
    sum += error * error.transpose() / kSamples;
  }
  EXPECT_LT((sum - in_b.covariance).norm(), 0.05 * in_b.covariance.norm());
}

TEST(ModelAlgebra, CovarianceIsCarriedWithTheMotionsOwn) {
  const SE3 T = core::se3_exp((Vector6d() << 0.2, -0.1, 1.2, 1, 2, 0.3).finished());
  Matrix6d motion = 1e-4 * Matrix6d::Identity();
  motion(0, 3) = motion(3, 0) = 4e-5;
  Vector9d sd;
  sd << 0.02, 0.01, 0.05, 0.1, 0.05, 0.03, 0.2, 0.1, 0.05;
  expect_sampled_covariance({car(0.4), Matrix9d(sd.cwiseAbs2().asDiagonal())}, T, motion);
  Vector6d cylinder_sd;
  cylinder_sd << 0.05, 0.02, 0.04, 0.03, 0.01, 0.02;
  expect_sampled_covariance({trunk(), Matrix6d(cylinder_sd.cwiseAbs2().asDiagonal())}, T, motion);
}

TEST(ModelAlgebra, WhatIsNotFiniteOrNotPositiveIsNotValid) {
  const Matrix9d good = Matrix9d::Identity();
  EXPECT_TRUE(valid({car(0), good}));
  EXPECT_FALSE(valid({car(0), Eigen::MatrixXd()}));
  EXPECT_FALSE(valid({car(0), -good}));
  EXPECT_FALSE(valid({car(0), std::numeric_limits<double>::quiet_NaN() * good}));
  EXPECT_FALSE(valid({car(0, -1), good}));
  EXPECT_FALSE(valid({Cuboid{}, good}));
  EXPECT_FALSE(valid({trunk(), good}));
  EXPECT_FALSE(valid({Cylinder{}, Matrix6d(Matrix6d::Identity())}));
}

}  // namespace
}  // namespace saker::slam
