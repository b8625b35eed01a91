#pragma once

#include <cmath>
#include <numbers>

#include "saker/active/belief/view_model.h"

/// A made model of what views are worth, for tests: cells of 30° by 3 m, oblique views best.
namespace saker::active::made {

constexpr int kCellsAround = 12;
constexpr double kCellRange = 3;  // m

/// sd of x, y, length and width, m: from 0.1 at 45° to 0.3 straight on, the same at every range.
inline double view_sd(double angle) { return 0.3 - 0.2 * std::abs(std::sin(2 * angle)); }

inline uncertainty::Prediction predict(objects::ClassId, const uncertainty::View& view) {
  const double turn = view.angle / (2 * std::numbers::pi) + 1;
  uncertainty::Prediction prediction;
  prediction.confidence = 0.97;
  prediction.bias = Eigen::VectorXd::Zero(4);
  prediction.covariance =
      Eigen::MatrixXd::Identity(4, 4) * view_sd(view.angle) * view_sd(view.angle);
  prediction.cell = static_cast<int>(view.range / kCellRange) * kCellsAround +
                    static_cast<int>(std::floor(turn * kCellsAround)) % kCellsAround;
  return prediction;
}

/// Good: within 20° of an oblique view.
inline ViewModel oblique_model(double common_sd = 0.05) {
  ViewModel model;
  model.predict = predict;
  model.common = [common_sd](objects::ClassId) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Identity(4, 4) * common_sd * common_sd;
  };
  model.in_region = [](objects::ClassId, const uncertainty::View& view) {
    return std::abs(std::sin(2 * view.angle)) > std::sin(50 * std::numbers::pi / 180);
  };
  return model;
}

}  // namespace saker::active::made
