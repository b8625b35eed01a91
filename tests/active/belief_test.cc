#include "active/belief.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/rng.h"

namespace saker::active {
namespace {

using Eigen::Matrix4d;

Matrix4d random_covariance(core::Rng& rng) {
  Matrix4d root;
  for (double& x : root.reshaped()) x = 0.3 * rng.normal();
  return root * root.transpose() + 0.01 * Matrix4d::Identity();
}

TEST(Belief, FollowsThePapersRecursionInClosedForm) {
  const double prior = 0.25, noise = 0.04;
  Belief belief(prior * Matrix4d::Identity(), Matrix4d::Zero());
  for (int views = 1; views <= 5; ++views) {
    belief.add(Matrix4d::Identity() / noise);
    const double variance = 1 / (1 / prior + views / noise);
    EXPECT_TRUE(belief.covariance().isApprox(variance * Matrix4d::Identity(), 1e-12));
    EXPECT_NEAR(belief.entropy(), 2 * std::log(variance), 1e-12);
  }
}

TEST(Belief, OfFullMatricesIsTheInverseOfTheSumOfInverses) {
  core::Rng rng(1);
  const Matrix4d prior = random_covariance(rng), a = random_covariance(rng),
                 b = random_covariance(rng), common = random_covariance(rng);
  Belief belief(prior, common);
  belief.add(a.inverse());
  belief.add(b.inverse());
  const Matrix4d expected = (prior.inverse() + a.inverse() + b.inverse()).inverse() + common;
  EXPECT_TRUE(belief.covariance().isApprox(expected, 1e-9));
  EXPECT_NEAR(belief.entropy(), 0.5 * std::log(expected.determinant()), 1e-9);
}

TEST(Belief, NeverFallsBelowWhatIsCommon) {
  const Matrix4d common = 0.01 * Matrix4d::Identity();
  Belief belief(Matrix4d::Identity(), common);
  for (int view = 0; view < 1000; ++view) belief.add(100 * Matrix4d::Identity());
  EXPECT_GT(belief.entropy(), 0.5 * std::log(common.determinant()));
  EXPECT_NEAR(belief.entropy(), 0.5 * std::log(common.determinant()), 0.01);
}

TEST(Belief, MostGainIsTheGainWhereNothingIsCommonAndMoreOtherwise) {
  core::Rng rng(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix4d prior = random_covariance(rng), view = random_covariance(rng).inverse();
    Belief plain(prior, Matrix4d::Zero()), shared(prior, random_covariance(rng));
    const double plain_before = plain.entropy(), shared_before = shared.entropy();
    const double most = shared.most_gain(view);
    plain.add(view);
    shared.add(view);
    EXPECT_NEAR(most, plain_before - plain.entropy(), 1e-9);
    EXPECT_GE(most, shared_before - shared.entropy() - 1e-9);
  }
}

TEST(Belief, MostGainShrinksAsMoreIsKnown) {
  core::Rng rng(3);
  for (int trial = 0; trial < 100; ++trial) {
    Belief belief(random_covariance(rng), Matrix4d::Zero());
    const Matrix4d view = random_covariance(rng).inverse();
    const double before = belief.most_gain(view);
    belief.add(random_covariance(rng).inverse());
    EXPECT_LE(belief.most_gain(view), before + 1e-12);
  }
}

TEST(Belief, OfACylinderNeitherGainsNorLosesBySizesThatItLacks) {
  const Covariance prior = 0.25 * Eigen::Matrix2d::Identity();
  Belief belief(prior, Covariance(0 * prior));
  EXPECT_NEAR(belief.entropy(), std::log(0.25), 1e-12);
  belief.add(information_of(Eigen::Matrix2d(0.04 * Eigen::Matrix2d::Identity()), 0));
  EXPECT_NEAR(belief.entropy(), std::log(1 / (1 / 0.25 + 1 / 0.04)), 1e-12);
}

TEST(Belief, DriftIsNoiseOfThePlaceAlone) {
  const Matrix4d information = information_of(Matrix4d(0.04 * Matrix4d::Identity()), 0.05);
  const Eigen::Vector4d expected(1 / 0.09, 1 / 0.09, 1 / 0.04, 1 / 0.04);
  EXPECT_TRUE(information.isApprox(Matrix4d(expected.asDiagonal()), 1e-12));
}

}  // namespace
}  // namespace saker::active
