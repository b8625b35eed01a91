#include "saker/slam/hidden_ends.h"

#include <cmath>
#include <limits>

#include "saker/objects/stated_length.h"
#include "saker/slam/model_algebra.h"

namespace saker::slam {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// An end's error with its tail: value, slope, and value over what came in.
struct Tail {
  double value, slope, ratio;
};

/// \param outward how much farther out than measured, m
/// \param most_m from where it grows in full again
Tail tail(double outward, double scale, double most_m) {
  if (outward > most_m) {
    const double value = tail(most_m, scale, most_m).value + outward - most_m;
    return {value, 1, value / outward};
  }
  constexpr double kNoTail = 1e-4;  // of the scale: all is linear to 1e-8
  const double ratio = outward / scale;
  if (ratio < kNoTail) return {outward, 1, 1};
  const double root = std::sqrt(std::log1p(ratio * ratio));
  return {scale * root, ratio / ((1 + ratio * ratio) * root), root / ratio};
}

/// Over [centre, size] what is diagonal over [low, high] end.
Eigen::Matrix2d of_centre_and_size(double low, double high) {
  Eigen::Matrix2d result;
  result << 0.5 * (low + high), 0.25 * (high - low), high - low, 0.5 * (low + high);
  return result;
}

void set_axis(Matrix9d& matrix, int axis, const Eigen::Matrix2d& block) {
  const int places[] = {3 + axis, 6 + axis};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) matrix(places[i], places[j]) = block(i, j);
}

}  // namespace

HiddenEnds::HiddenEnds(const objects::Cuboid& measured, const Matrix9d& covariance,
                       const HiddenEndConfig& config)
    : longer_(longer_axis(measured)),
      most_m_(config.most_m),
      scale_(Eigen::Vector2d::Constant(kNever)) {
  if (config.enabled) scale_ = config.sds * end_variances(covariance, longer_).cwiseSqrt();
}

HiddenEnds::Softened HiddenEnds::operator()(const Vector9d& error) const {
  Softened softened{error, Matrix9d::Identity(), Matrix9d::Identity()};
  const double centre = error[3 + longer_], half = 0.5 * error[6 + longer_];
  const Tail low = tail(half - centre, scale_[0], most_m_);
  const Tail high = tail(half + centre, scale_[1], most_m_);
  softened.error[3 + longer_] = 0.5 * (high.value - low.value);
  softened.error[6 + longer_] = high.value + low.value;
  set_axis(softened.slope, longer_, of_centre_and_size(low.slope, high.slope));
  set_axis(softened.secant, longer_, of_centre_and_size(low.ratio, high.ratio));
  return softened;
}

}  // namespace saker::slam
