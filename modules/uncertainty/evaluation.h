#pragma once

#include <span>

#include "saker/uncertainty/sample.h"
#include "saker/uncertainty/uncertainty.h"

namespace saker::uncertainty {

/// How well a model predicts samples that it was not fitted to. NEES: squared error over its
/// predicted covariance, a degree of freedom; 1 where the model is honest, NaN where there is
/// nothing to judge.
struct Evaluation {
  int draws = 0;      ///< objects and cells, within what was flown
  double nees = NAN;  ///< of one draw: covariance + common
  int objects = 0;
  double fused_nees = NAN;           ///< of all draws of an object, each cell once
  Eigen::VectorXd fused_error_mean;  ///< m, over the objects
  Eigen::VectorXd fused_error_sd;    ///< m
  double confidence_error = NAN;     ///< root of the mean square, over the samples
  double constant_error = NAN;       ///< the same of the mean confidence of the fit
};

/// Of the samples of one class that showed both ends and both sides; requires that the model knows
/// it.
[[nodiscard]] Evaluation evaluate(const Model& model, objects::ClassId id,
                                  std::span<const Sample> samples);

}  // namespace saker::uncertainty
