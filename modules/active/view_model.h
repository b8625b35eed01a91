#pragma once

#include <functional>
#include <memory>

#include "uncertainty/uncertainty.h"

namespace saker::active {

/// What active mapping asks of the fitted models.
struct ViewModel {
  /// What a measurement from this view is worth.
  std::function<uncertainty::Prediction(objects::ClassId, const uncertainty::View&)> predict;
  /// What all views of one object have in common.
  std::function<Eigen::MatrixXd(objects::ClassId)> common;
  /// Whether the view lies in the region of high confidence ∩ low geometric uncertainty.
  std::function<bool(objects::ClassId, const uncertainty::View&)> in_region;
};

}  // namespace saker::active
