#include "saker/active/belief/belief.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "saker/core/rng.h"

namespace saker::active {
namespace {

using Eigen::Matrix4d;

Matrix4d random_covariance(core::Rng& rng) {
  Matrix4d root;
  for (double& x : root.reshaped()) x = 0.3 * rng.normal();
  return root * root.transpose() + 0.01 * Matrix4d::Identity();
}

/// Of a view that looks at all faces.
Information open_view(const Matrix4d& covariance) {
  return information_of({Covariance(covariance)}, 0);
}

/// Of a random view to which random faces are hidden.
Information random_view(core::Rng& rng) {
  Measured measured{Covariance(random_covariance(rng))};
  for (double& hidden : measured.hidden) hidden = rng.uniform() < 0.5 ? 0 : 0.3 * rng.uniform();
  return information_of(measured, 0);
}

TEST(Belief, FollowsThePapersRecursionInClosedForm) {
  const double prior = 0.25, noise = 0.04;
  Belief belief(prior * Matrix4d::Identity(), Matrix4d::Zero());
  for (int views = 1; views <= 5; ++views) {
    belief.add(open_view(noise * Matrix4d::Identity()));
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
  belief.add(open_view(a));
  belief.add(open_view(b));
  const Matrix4d expected = (prior.inverse() + a.inverse() + b.inverse()).inverse() + common;
  EXPECT_TRUE(belief.covariance().isApprox(expected, 1e-9));
  EXPECT_NEAR(belief.entropy(), 0.5 * std::log(expected.determinant()), 1e-9);
}

TEST(Belief, NeverFallsBelowWhatIsCommon) {
  const Matrix4d common = 0.01 * Matrix4d::Identity();
  Belief belief(Matrix4d::Identity(), common);
  for (int view = 0; view < 1000; ++view) belief.add(open_view(0.01 * Matrix4d::Identity()));
  EXPECT_GT(belief.entropy(), 0.5 * std::log(common.determinant()));
  EXPECT_NEAR(belief.entropy(), 0.5 * std::log(common.determinant()), 0.01);
}

TEST(Belief, MostGainIsTheGainWhereNothingIsCommonAndMoreOtherwise) {
  core::Rng rng(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix4d prior = random_covariance(rng);
    const Information view = open_view(random_covariance(rng));
    Belief plain(prior, Matrix4d::Zero()), shared(prior, random_covariance(rng));
    const double plain_before = plain.entropy(), shared_before = shared.entropy();
    const double most = shared.most_gain(view);
    plain.add(view);
    shared.add(view);
    EXPECT_NEAR(most, plain_before - plain.entropy(), 1e-9);
    EXPECT_GE(most, shared_before - shared.entropy() - 1e-9);
  }
}

TEST(Belief, MostGainIsNoLessThanTheGainWhereFacesAreHidden) {
  core::Rng rng(4);
  for (int trial = 0; trial < 100; ++trial) {
    Belief belief(random_covariance(rng), random_covariance(rng));
    belief.add(random_view(rng));
    const Information view = random_view(rng);
    const double before = belief.entropy(), most = belief.most_gain(view);
    belief.add(view);
    EXPECT_GE(most, before - belief.entropy() - 1e-9);
  }
}

/// Against all that is measured at once, written down in one matrix.
TEST(Belief, WhatHidesAFaceIsTheSameInAllViews) {
  const double noise = 0.01, hidden = 0.09;  // m²
  Belief belief(1e4 * Matrix4d::Identity(), Matrix4d::Zero());
  Measured measured{Covariance(noise * Matrix4d::Identity())};
  measured.hidden[0] = std::sqrt(hidden);
  const int views = 7;
  for (int view = 0; view < views; ++view) belief.add(information_of(measured, 0));
  const Eigen::Vector4d front(0.5, 0, 1, 0);  // of [x, y, length, width], 1 m farther out
  const Matrix4d expected =
      noise / views * Matrix4d::Identity() + hidden * front * front.transpose();
  EXPECT_TRUE(belief.covariance().isApprox(expected, 1e-3));
}

TEST(Belief, KnownToACovarianceFurtherHiddenViewsTellOnlyWhatTheyAverage) {
  const Matrix4d map = 0.04 * Matrix4d::Identity();
  Measured hidden{Covariance(1e-6 * Matrix4d::Identity())};
  hidden.hidden << 0.2, 0.2, 0.2, 0.2;
  Belief belief(Matrix4d::Identity(), Matrix4d::Zero());
  EXPECT_TRUE(belief.known_to(Covariance(map)).covariance().isApprox(map, 1e-9));
  belief.add(information_of(hidden, 0));
  belief = belief.known_to(Covariance(map));
  EXPECT_TRUE(belief.covariance().isApprox(map, 1e-9));
  belief.add(information_of(hidden, 0));
  EXPECT_TRUE(belief.covariance().isApprox(map, 1e-3)) << "the same view again";
  belief.add(open_view(0.04 * Matrix4d::Identity()));
  EXPECT_TRUE(belief.covariance().isApprox(0.5 * map, 1e-3)) << "one that looks at all faces";
}

TEST(Belief, MostGainShrinksAsMoreIsKnown) {
  core::Rng rng(3);
  for (int trial = 0; trial < 100; ++trial) {
    Belief belief(random_covariance(rng), Matrix4d::Zero());
    const Information view = random_view(rng);
    const double before = belief.most_gain(view);
    belief.add(random_view(rng));
    EXPECT_LE(belief.most_gain(view), before + 1e-12);
  }
}

TEST(Belief, OfACylinderNeitherGainsNorLosesBySizesThatItLacks) {
  const Covariance prior = 0.25 * Eigen::Matrix2d::Identity();
  Belief belief(prior, Covariance(0 * prior));
  EXPECT_NEAR(belief.entropy(), std::log(0.25), 1e-12);
  belief.add(information_of({Covariance(0.04 * Eigen::Matrix2d::Identity())}, 0));
  EXPECT_NEAR(belief.entropy(), std::log(1 / (1 / 0.25 + 1 / 0.04)), 1e-12);
}

TEST(Belief, DriftIsNoiseOfThePlaceAlone) {
  const Matrix4d information =
      information_of({Covariance(0.04 * Matrix4d::Identity())}, 0.05).topLeftCorner<4, 4>();
  const Eigen::Vector4d expected(1 / 0.09, 1 / 0.09, 1 / 0.04, 1 / 0.04);
  EXPECT_TRUE(information.isApprox(Matrix4d(expected.asDiagonal()), 1e-12));
}

}  // namespace
}  // namespace saker::active
