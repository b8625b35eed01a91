#pragma once

#include <vector>

#include "saker/uncertainty/covariate.h"
#include "saker/uncertainty/perceptron.h"

namespace saker::uncertainty {

/// f^s of the paper: the confidence of an object's class by where it is seen from. A multilayer
/// perceptron over range, the sine and cosine of the folded angle, and what else helped; or a
/// constant, where the data show no trend.
struct SemanticModel {
  struct Input {
    Covariate covariate = Covariate::elevation;
    double mean = NAN, spread = NAN;
  };

  double mean = NAN;  ///< over all samples: the constant
  std::vector<Input> inputs;
  Perceptron perceptron;  ///< empty: the constant

  [[nodiscard]] double confidence(const View& view) const;
  [[nodiscard]] Eigen::VectorXd features(const View& view) const;
};

}  // namespace saker::uncertainty
