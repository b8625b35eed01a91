#include "saker/uncertainty/geometric.h"

#include <gtest/gtest.h>

#include "made_model.h"
#include "saker/core/rng.h"

namespace saker::uncertainty {
namespace {

constexpr double kPi = std::numbers::pi;
const Intervals kIntervals{{2, 5, 9, 14}, 6};

View seen_from(double range, double angle) { return {range, angle, NAN, NAN}; }

/// Bias and covariance change with range and angle; y errs with the rest, as from the left.
GeometricModel::Interval uneven(double range, double angle) {
  const Eigen::Vector4d bias(0.05 * std::cos(angle), 0.04 * std::sin(angle), -0.01 * range, 0.02);
  Eigen::Matrix4d factor = 0.02 * range * Eigen::Matrix4d::Identity();
  factor(1, 0) = 0.01 * std::sin(angle);
  factor(2, 0) = -0.03;
  return made_interval(bias, factor * factor.transpose());
}

GeometricModel uneven_model() { return GeometricModel(made_parts(kIntervals, uneven)); }

Eigen::MatrixXd mirrored(const Eigen::MatrixXd& m) {
  const Eigen::VectorXd parity = mirror(4, 6);
  return parity.asDiagonal() * m * parity.asDiagonal();
}

TEST(GeometricModelTest, InTheMiddleOfAnIntervalSaysWhatWasFittedThere) {
  const GeometricModel model = uneven_model();
  for (int range = 0; range < 3; ++range) {
    for (int sector = 0; sector < 6; ++sector) {
      const double r = kIntervals.range_centre(range), a = kIntervals.sector_centre(sector);
      const auto expected = model.expected(seen_from(r, a));
      EXPECT_TRUE(expected.bias.isApprox(uneven(r, a).bias, 1e-9));
      EXPECT_TRUE(expected.covariance.isApprox(uneven(r, a).covariance, 1e-9));
      EXPECT_FALSE(expected.extrapolated);
    }
  }
}

TEST(GeometricModelTest, FromTheRightSaysTheMirrorImage) {
  const GeometricModel model = uneven_model();
  for (double angle = 0.05; angle < kPi; angle += 0.23) {
    const auto left = model.expected(seen_from(6, angle));
    const auto right = model.expected(seen_from(6, -angle));
    EXPECT_TRUE(right.bias.isApprox(left.bias.cwiseProduct(mirror(4, 6)), 1e-12)) << angle;
    EXPECT_TRUE(right.covariance.isApprox(mirrored(left.covariance), 1e-12)) << angle;
    EXPECT_EQ(right.whole, left.whole) << angle;
  }
}

TEST(GeometricModelTest, StraightAheadAndBehindNothingLeansToASide) {
  const GeometricModel model = uneven_model();
  for (const double angle : {0.0, kPi}) {
    const auto expected = model.expected(seen_from(6, angle));
    EXPECT_NEAR(expected.bias[1], 0, 1e-12);
    for (const int k : {0, 2, 3}) EXPECT_NEAR(expected.covariance(1, k), 0, 1e-12);
  }
}

TEST(GeometricModelTest, CovarianceIsPositiveDefiniteBetweenAnyIntervals) {
  core::Rng rng(2);
  const auto random = [&](double, double) {
    Eigen::Matrix4d factor;
    for (double& value : factor.reshaped()) value = rng.normal(0, 0.5);
    return made_interval(Eigen::Vector4d::Zero(),
                         factor * factor.transpose() + 1e-6 * Eigen::Matrix4d::Identity());
  };
  const GeometricModel model(made_parts(kIntervals, random));
  for (double range = 1; range < 16; range += 0.4) {
    for (double angle = -3.1; angle < 3.1; angle += 0.2) {
      const Eigen::MatrixXd P = model.expected(seen_from(range, angle)).covariance;
      EXPECT_LT((P - P.transpose()).norm(), 1e-12 * P.norm());
      EXPECT_EQ(P.llt().info(), Eigen::Success) << range << " " << angle;
    }
  }
}

TEST(GeometricModelTest, WhereAllIntervalsAgreeSaysTheSameEverywhere) {
  const Eigen::Vector4d bias(0.1, 0, -0.2, 0.3);
  const GeometricModel model(even_parts(bias, 0.04 * Eigen::Matrix4d::Identity()));
  for (const double range : {0.5, 3.0, 11.0, 40.0}) {
    for (const double angle : {-2.0, 0.0, 1.0, 3.0}) {
      const auto expected = model.expected(seen_from(range, angle));
      EXPECT_TRUE(expected.bias.isApprox(bias, 1e-12));
      EXPECT_TRUE(expected.covariance.isApprox(0.04 * Eigen::Matrix4d::Identity(), 1e-12));
    }
  }
}

TEST(GeometricModelTest, WhatWasNotFlownIsExtrapolated) {
  GeometricModel::Parts parts = made_parts(kIntervals, uneven);
  parts.fitted[static_cast<std::size_t>(kIntervals.index(2, 3))].objects = 0;
  const GeometricModel model(parts);
  const auto extrapolated = [&](double range, double angle) {
    return model.expected(seen_from(range, angle)).extrapolated;
  };
  EXPECT_FALSE(extrapolated(6, 1));
  EXPECT_TRUE(extrapolated(1.9, 1));
  EXPECT_TRUE(extrapolated(14.1, 1));
  EXPECT_TRUE(extrapolated(12, kIntervals.sector_centre(3)));
  EXPECT_TRUE(extrapolated(12, -kIntervals.sector_centre(3)));
  EXPECT_FALSE(extrapolated(12, kIntervals.sector_centre(2)));
}

TEST(GeometricModelTest, ShareOfWholeMeasurementsIsAProbability) {
  const GeometricModel model(made_parts(kIntervals, [](double range, double angle) {
    GeometricModel::Interval interval = uneven(range, angle);
    interval.whole = angle < 1 ? 0 : 1;
    return interval;
  }));
  for (double range = 1; range < 16; range += 0.5) {
    for (double angle = -3.1; angle < 3.1; angle += 0.1) {
      const double whole = model.expected(seen_from(range, angle)).whole;
      EXPECT_GT(whole, 0);
      EXPECT_LE(whole, 1);
    }
  }
}

/// Elevation moves the bias, and more of it means more noise.
GeometricModel sloped() {
  GeometricModel::Parts parts = made_parts(kIntervals, [](double range, double angle) {
    GeometricModel::Interval interval = uneven(range, angle);
    interval.covariate_mean = Eigen::VectorXd::Constant(1, 0.3);
    return interval;
  });
  parts.slopes = {{Covariate::elevation, 0.1, Eigen::Vector4d(0.02, 0.01, 0.05, 0), 0.4}};
  return GeometricModel(parts);
}

TEST(GeometricModelTest, AFurtherInputMovesBiasAndCovarianceByItsSpreads) {
  const View at_mean{6, 1, 0.3, NAN}, above{6, 1, 0.4, NAN};
  const auto mean = sloped().expected(at_mean), more = sloped().expected(above);
  const Eigen::Vector4d moved = more.bias - mean.bias;
  EXPECT_TRUE(moved.isApprox(Eigen::Vector4d(0.02, 0.01 * std::sin(1), 0.05, 0), 1e-9));
  EXPECT_TRUE(more.covariance.isApprox(std::exp(0.4) * mean.covariance, 1e-9));
}

TEST(GeometricModelTest, AFurtherInputThatIsUnknownIsAveragedOver) {
  const auto unknown = sloped().expected(seen_from(6, 1));
  const auto mean = sloped().expected({6, 1, 0.3, NAN});
  EXPECT_TRUE(unknown.bias.isApprox(mean.bias, 1e-12));
  EXPECT_TRUE(unknown.covariance.isApprox(mean.covariance, 1e-12));
}

TEST(Mirror, TurnsTheSidewaysErrorOfCuboidsAlone) {
  EXPECT_EQ(mirror(4, 6), Eigen::VectorXd(Eigen::Vector4d(1, -1, 1, 1)));
  EXPECT_EQ(mirror(2, 1), Eigen::VectorXd(Eigen::Vector2d(1, 1)));
}

TEST(ReachOfSlope, OfWhatTheMirrorTurnsVanishesInThePlaneOfSymmetry) {
  const Eigen::VectorXd parity = mirror(4, 6);
  EXPECT_NEAR(reach_of_slope(parity, 0)[1], 0, 1e-12);
  EXPECT_NEAR(reach_of_slope(parity, kPi)[1], 0, 1e-12);
  EXPECT_NEAR(reach_of_slope(parity, kPi / 2)[1], 1, 1e-12);
  EXPECT_EQ(reach_of_slope(parity, -1), reach_of_slope(parity, 1));
  EXPECT_EQ(reach_of_slope(parity, 0.3)[2], 1);
}

}  // namespace
}  // namespace saker::uncertainty
