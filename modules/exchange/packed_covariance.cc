#include "saker/exchange/packed_covariance.h"

#include <algorithm>
#include <cmath>

namespace saker::exchange {
namespace {

constexpr double kStepsPerOctave = 8, kLeastOctave = -20;
constexpr double kCorrelationStep = 0.1;  // of atanh
constexpr int kMostSteps = 30;            // ±0.995

double correlation_of(int steps) { return std::tanh(kCorrelationStep * steps); }

int steps_of(double correlation) {
  const double inside = std::clamp(correlation, -0.9999, 0.9999);
  const double steps = std::round(std::atanh(inside) / kCorrelationStep);
  return static_cast<int>(std::clamp<double>(steps, -kMostSteps, kMostSteps));
}

void pack_steps(int steps, CodedWriter& out) {
  out.byte(static_cast<std::uint8_t>(steps + kMostSteps));
}

int unpacked_steps(CodedReader& in) { return std::min(in.byte() - kMostSteps, kMostSteps); }

}  // namespace

std::uint8_t packed_sd(double sd) {
  const double octave = std::log2(std::max(sd, std::exp2(kLeastOctave)));
  const double steps = std::round((octave - kLeastOctave) * kStepsPerOctave);
  return static_cast<std::uint8_t>(std::clamp(steps, 0.0, 255.0));
}

double unpacked_sd(std::uint8_t byte) { return std::exp2(kLeastOctave + byte / kStepsPerOctave); }

/// The rows of the correlation matrix's Cholesky factor are walked with the partial correlations
/// as they will be unpacked, so that their rounding does not add up along a row.
void pack(const Eigen::MatrixXd& covariance, CodedWriter& out) {
  const Eigen::Index rows = covariance.rows();
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  for (const double s : sd) out.byte(packed_sd(s));
  Eigen::MatrixXd L = Eigen::MatrixXd::Identity(rows, rows);
  for (Eigen::Index i = 1; i < rows; ++i) {
    double left = 1;  // of the row's unit length
    for (Eigen::Index j = 0; j < i; ++j) {
      const double scale = sd(i) * sd(j);
      const double correlation = scale > 0 ? covariance(i, j) / scale : 0;
      const double along = (correlation - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
      const int steps = steps_of(along / std::sqrt(left));
      pack_steps(steps, out);
      L(i, j) = correlation_of(steps) * std::sqrt(left);
      left -= L(i, j) * L(i, j);
    }
    L(i, i) = std::sqrt(left);
  }
}

Eigen::MatrixXd unpacked_covariance(int rows, CodedReader& in) {
  Eigen::VectorXd sd(rows);
  for (double& s : sd) s = unpacked_sd(in.byte());
  Eigen::MatrixXd L = Eigen::MatrixXd::Identity(rows, rows);
  for (Eigen::Index i = 1; i < rows; ++i) {
    double left = 1;
    for (Eigen::Index j = 0; j < i; ++j) {
      L(i, j) = correlation_of(unpacked_steps(in)) * std::sqrt(left);
      left -= L(i, j) * L(i, j);
    }
    L(i, i) = std::sqrt(left);
  }
  const Eigen::MatrixXd scaled = sd.asDiagonal() * L;
  return scaled * scaled.transpose();
}

}  // namespace saker::exchange
