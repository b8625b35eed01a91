#include "exchange/packed_covariance.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace saker::exchange {
namespace {

constexpr double kStepsPerOctave = 8, kLeastOctave = -20;
constexpr double kCorrelationStep = 0.2;  // of atanh
constexpr int kMostSteps = 15;            // ±0.995
constexpr int kStepBits = 5;              // sign and number of steps

/// Bits one after another, the lowest of a byte first.
class BitWriter {
 public:
  explicit BitWriter(ByteWriter& out) : out_(out) {}
  ~BitWriter() {
    if (count_ > 0) out_.byte(byte_);
  }
  void bits(unsigned value, int count) {
    for (int i = 0; i < count; ++i) {
      byte_ = static_cast<std::uint8_t>(byte_ | (value >> i & 1) << count_);
      if (++count_ < 8) continue;
      out_.byte(byte_);
      byte_ = 0;
      count_ = 0;
    }
  }

 private:
  ByteWriter& out_;
  std::uint8_t byte_ = 0;
  int count_ = 0;
};

class BitReader {
 public:
  explicit BitReader(ByteReader& in) : in_(in) {}
  [[nodiscard]] unsigned bits(int count) {
    unsigned value = 0;
    for (int i = 0; i < count; ++i) {
      if (left_ == 0) {
        byte_ = in_.byte();
        left_ = 8;
      }
      value |= static_cast<unsigned>(byte_ & 1) << i;
      byte_ = static_cast<std::uint8_t>(byte_ >> 1);
      --left_;
    }
    return value;
  }

 private:
  ByteReader& in_;
  std::uint8_t byte_ = 0;
  int left_ = 0;
};

double correlation_of(int steps) { return std::tanh(kCorrelationStep * steps); }

int steps_of(double correlation) {
  const double inside = std::clamp(correlation, -0.9999, 0.9999);
  const double steps = std::round(std::atanh(inside) / kCorrelationStep);
  return static_cast<int>(std::clamp<double>(steps, -kMostSteps, kMostSteps));
}

/// One bit where there is no correlation, else six.
void pack_steps(int steps, BitWriter& out) {
  out.bits(steps == 0 ? 0 : 1, 1);
  if (steps == 0) return;
  out.bits(static_cast<unsigned>(std::abs(steps)) | (steps < 0 ? 1U << (kStepBits - 1) : 0U),
           kStepBits);
}

int unpacked_steps(BitReader& in) {
  if (in.bits(1) == 0) return 0;
  const unsigned packed = in.bits(kStepBits);
  const int steps = static_cast<int>(packed & kMostSteps);
  return (packed >> (kStepBits - 1)) != 0 ? -steps : steps;
}

}  // namespace

std::uint8_t packed_sd(double sd) {
  const double octave = std::log2(std::max(sd, std::exp2(kLeastOctave)));
  const double steps = std::round((octave - kLeastOctave) * kStepsPerOctave);
  return static_cast<std::uint8_t>(std::clamp(steps, 0.0, 255.0));
}

double unpacked_sd(std::uint8_t byte) { return std::exp2(kLeastOctave + byte / kStepsPerOctave); }

/// The rows of the correlation matrix's Cholesky factor are walked with the partial correlations
/// as they will be unpacked, so that their rounding does not add up along a row.
void pack(const Eigen::MatrixXd& covariance, ByteWriter& out) {
  const Eigen::Index rows = covariance.rows();
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  for (const double s : sd) out.byte(packed_sd(s));
  BitWriter bits(out);
  Eigen::MatrixXd L = Eigen::MatrixXd::Identity(rows, rows);
  for (Eigen::Index i = 1; i < rows; ++i) {
    double left = 1;  // of the row's unit length
    for (Eigen::Index j = 0; j < i; ++j) {
      const double scale = sd(i) * sd(j);
      const double correlation = scale > 0 ? covariance(i, j) / scale : 0;
      const double along = (correlation - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
      const int steps = steps_of(along / std::sqrt(left));
      pack_steps(steps, bits);
      L(i, j) = correlation_of(steps) * std::sqrt(left);
      left -= L(i, j) * L(i, j);
    }
    L(i, i) = std::sqrt(left);
  }
}

Eigen::MatrixXd unpacked_covariance(int rows, ByteReader& in) {
  Eigen::VectorXd sd(rows);
  for (double& s : sd) s = unpacked_sd(in.byte());
  BitReader bits(in);
  Eigen::MatrixXd L = Eigen::MatrixXd::Identity(rows, rows);
  for (Eigen::Index i = 1; i < rows; ++i) {
    double left = 1;
    for (Eigen::Index j = 0; j < i; ++j) {
      L(i, j) = correlation_of(unpacked_steps(bits)) * std::sqrt(left);
      left -= L(i, j) * L(i, j);
    }
    L(i, i) = std::sqrt(left);
  }
  const Eigen::MatrixXd scaled = sd.asDiagonal() * L;
  return scaled * scaled.transpose();
}

}  // namespace saker::exchange
