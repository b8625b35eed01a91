#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "saker/core/config.h"

namespace saker::uncertainty {

struct RandomEffectsConfig {
  double prior_draws = 10;
  double bias_prior_draws = 1;
  double bias_most_deviations = 2;
  double most_sd = 5;
  double least_sd_m = 0.005;
  int iterations = 1000;
  double tolerance = 2e-4;
  bool about_truth = false;  ///< no bias: variances are about zero; FitConfig says for which class

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("prior_draws", prior_draws, {0, 1000}, "",
            "for which the class's mean covariance counts in that of an interval");
    v.field("bias_prior_draws", bias_prior_draws, {0, 1000}, "",
            "for which the class's mean bias counts in that of an interval");
    v.field("bias_most_deviations", bias_most_deviations, {0.01, 100}, "",
            "median deviations beyond which an error moves a bias as if it lay there: 1.3 standard "
            "deviations of a Gaussian; ends that were not seen make errors lean inward");
    v.field("most_sd", most_sd, {2, 100}, "",
            "standard deviations (Mahalanobis) beyond which an error counts as if it lay there");
    v.field("least_sd_m", least_sd_m, {1e-6, 1}, "m",
            "no measurement is believed to be better than this");
    v.field("iterations", iterations, {1, 10000}, "", "of expectation and maximisation, at most");
    v.field("tolerance", tolerance, {0, 0.1}, "",
            "relative change of the common covariance at which they end");
  }
};

/// The mean error of one object as measured from one cell: one draw.
struct Draw {
  int object = 0;         ///< from 0 without gaps
  int interval = 0;       ///< of range and |angle|
  bool mirrored = false;  ///< seen from the right
  Eigen::VectorXd error;  ///< as if seen from the left
};

/// error = bias of the interval + what the object adds to all its measurements + rest. About the
/// truth all biases are 0.
struct RandomEffects {
  std::vector<Eigen::VectorXd> bias;        ///< one an interval
  std::vector<Eigen::MatrixXd> covariance;  ///< of the rest, for a new object: one an interval
  std::vector<int> draws;                   ///< one an interval
  Eigen::MatrixXd common;                   ///< of what an object adds, in its own frame
};

/// The variances of a linear model with random effects by expectation and maximisation (Laird and
/// Ware, Biometrics 1982), with shrinkage towards the class and bounded influence of outliers.
/// The covariance of an interval contains what its bias is uncertain by.
/// \param alike   one an interval: signs of the error's entries under which those of all intervals
///                are alike, as the class's mean takes them
/// \param parity  of the error's entries under the mirror between left and right
[[nodiscard]] RandomEffects random_effects(std::span<const Draw> draws,
                                           std::span<const Eigen::VectorXd> alike,
                                           const Eigen::VectorXd& parity,
                                           const RandomEffectsConfig& config);

}  // namespace saker::uncertainty
