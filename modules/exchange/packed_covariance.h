#pragma once

#include <Eigen/Core>

#include "saker/exchange/coded.h"

/// Covariances in few bytes: standard deviations in eighths of an octave (at most 4.5 % off), and
/// canonical partial correlations, their inverse hyperbolic tangent in steps of 0.1. Any partial
/// correlations below 1 make a positive definite matrix, so what is unpacked always is one.
///
/// Source: Lewandowski, Kurowicka, Joe, "Generating random correlation matrices based on vines and
/// extended onion method", 2009 (the Cholesky form).
namespace saker::exchange {

/// Zero variances and those below 1e-12 become the least that there is; the matrix is taken to be
/// finite and symmetric with a diagonal that is not negative.
void pack(const Eigen::MatrixXd& covariance, CodedWriter& out);

/// Of `rows` rows.
[[nodiscard]] Eigen::MatrixXd unpacked_covariance(int rows, CodedReader& in);

/// A standard deviation in one byte: eighths of an octave from 2^-20 to 2^11.9.
[[nodiscard]] std::uint8_t packed_sd(double sd);
[[nodiscard]] double unpacked_sd(std::uint8_t byte);

}  // namespace saker::exchange
