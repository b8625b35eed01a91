#include "saker/uncertainty/semantic.h"

#include <cmath>

namespace saker::uncertainty {
namespace {

constexpr double kRangeScale = 10;  // m: brings ranges to about one

}  // namespace

Eigen::VectorXd SemanticModel::features(const View& view) const {
  Eigen::VectorXd features(3 + static_cast<Eigen::Index>(inputs.size()));
  features.head<3>() << view.range / kRangeScale - 1, std::sin(std::abs(view.angle)),
      std::cos(view.angle);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    features[3 + static_cast<Eigen::Index>(i)] =
        standardised(value_of(view, inputs[i].covariate), inputs[i].mean, inputs[i].spread);
  }
  return features;
}

double SemanticModel::confidence(const View& view) const {
  return perceptron.empty() ? mean : perceptron(features(view));
}

}  // namespace saker::uncertainty
