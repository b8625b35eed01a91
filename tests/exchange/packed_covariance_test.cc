#include "saker/exchange/packed_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "made_measurement.h"

namespace saker::exchange {
namespace {

Eigen::MatrixXd there_and_back(const Eigen::MatrixXd& covariance) {
  Statistics writers, readers;
  CodedWriter out(writers);
  pack(covariance, out);
  const std::string bytes = out.finish();
  CodedReader in(bytes, readers);
  const Eigen::MatrixXd back = unpacked_covariance(static_cast<int>(covariance.rows()), in);
  EXPECT_TRUE(in.done());
  return back;
}

TEST(PackedCovariance, StandardDeviationsAreRightToFivePercentAndTheMatrixIsPositiveDefinite) {
  core::Rng rng(1);
  for (int round = 0; round < 500; ++round) {
    const int rows = rng.chance(0.5) ? 6 : 9;
    const Eigen::MatrixXd covariance = some_covariance(rng, rows);
    const Eigen::MatrixXd back = there_and_back(covariance);
    EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(back).info(), Eigen::Success);
    for (int i = 0; i < rows; ++i) {
      EXPECT_NEAR(std::sqrt(back(i, i) / covariance(i, i)), 1, 0.045);
    }
  }
}

/// What a merged graph weighs: the squared length of an error in units of its sd.
TEST(PackedCovariance, WeighsErrorsAsTheOriginalWithinAFifth) {
  core::Rng rng(2);
  double ratio = 0;
  constexpr int kRounds = 500;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd covariance = some_covariance(rng, 6);
    const Eigen::MatrixXd back = there_and_back(covariance);
    ratio += (back.inverse() * covariance).trace() / 6 / kRounds;  // mean NEES a degree of freedom
  }
  EXPECT_NEAR(ratio, 1, 0.2);
}

/// Where sums of partial correlations do not hide it.
TEST(PackedCovariance, TwoNumbersCorrelationIsRightToATwentieth) {
  for (int percent = -99; percent <= 99; ++percent) {
    const double correlation = 0.01 * percent;
    const Eigen::Matrix2d back =
        there_and_back((Eigen::Matrix2d() << 1, correlation, correlation, 1).finished());
    EXPECT_NEAR(back(0, 1) / std::sqrt(back(0, 0) * back(1, 1)), correlation, 0.05);
  }
}

TEST(PackedCovariance, AnyBytesGiveASymmetricFiniteMatrix) {
  core::Rng rng(3);
  for (int round = 0; round < 5000; ++round) {
    std::string bytes(40, '\0');
    for (char& byte : bytes) byte = static_cast<char>(rng.index(256));
    Statistics statistics;
    CodedReader in(bytes, statistics);
    const Eigen::MatrixXd back = unpacked_covariance(9, in);
    ASSERT_TRUE(back.allFinite());
    ASSERT_TRUE(back.isApprox(back.transpose()));
    ASSERT_GT(back.diagonal().minCoeff(), 0);
  }
}

TEST(PackedCovariance, DoesNotDependOnTheUnit) {
  core::Rng rng(4);
  const Eigen::MatrixXd covariance = some_covariance(rng, 6);
  const Eigen::MatrixXd eightfold = there_and_back(64 * covariance);  // whole octaves of the sd
  EXPECT_TRUE(eightfold.isApprox(64 * there_and_back(covariance), 1e-9));
}

TEST(PackedCovariance, OfWhatIsPackedAlreadyNothingIsLost) {
  core::Rng rng(5);
  for (int round = 0; round < 20; ++round) {
    const Eigen::MatrixXd once = there_and_back(some_covariance(rng, 9));
    EXPECT_TRUE(there_and_back(once).isApprox(once, 1e-6)) << round;
  }
}

TEST(PackedCovariance, AVarianceOfZeroBecomesTheLeastThereIs) {
  const Eigen::MatrixXd back = there_and_back(Eigen::MatrixXd::Zero(6, 6));
  EXPECT_TRUE(back.isDiagonal(1e-20));
  EXPECT_NEAR(std::sqrt(back(0, 0)), std::exp2(-20), 1e-12);
}

TEST(PackedSd, IsRightToFivePercentFromAMicrometreToAKilometre) {
  for (double sd = 1e-6; sd < 1e3; sd *= 1.07) {
    EXPECT_NEAR(unpacked_sd(packed_sd(sd)) / sd, 1, 0.045) << sd;
  }
}

TEST(PackedSd, RisesWithItsByteAndEveryByteIsItsOwn) {
  for (int byte = 0; byte < 256; ++byte) {
    const double sd = unpacked_sd(static_cast<std::uint8_t>(byte));
    EXPECT_EQ(packed_sd(sd), byte);
    if (byte > 0) {
      EXPECT_GT(sd, unpacked_sd(static_cast<std::uint8_t>(byte - 1)));
    }
  }
}

TEST(PackedSd, WhatIsBeyondItsEndsIsTheEnd) {
  EXPECT_EQ(packed_sd(0), 0);
  EXPECT_EQ(packed_sd(1e-30), 0);
  EXPECT_EQ(packed_sd(1e30), 255);
}

}  // namespace
}  // namespace saker::exchange
