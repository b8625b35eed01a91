#pragma once

#include <functional>
#include <memory>

#include "saker/uncertainty/regions.h"
#include "saker/uncertainty/uncertainty.h"

/// What views are worth, by the fitted uncertainty model.
///
/// Reads the model (`uncertainty`), makes the three questions that the choosers ask. Frames: views
/// are relative to the object (`uncertainty::View`). Cost: a look-up each.
namespace saker::active {

/// What active mapping asks of the fitted models.
struct ViewModel {
  /// What a measurement from this view is worth where it shows the object from end to end.
  std::function<uncertainty::Prediction(objects::ClassId, const uncertainty::View&)> predict;
  /// What all views of one object have in common.
  std::function<Eigen::MatrixXd(objects::ClassId)> common;
  /// Whether the view lies in the region of high confidence ∩ low geometric uncertainty.
  std::function<bool(objects::ClassId, const uncertainty::View&)> in_region;
};

/// Throws Error where the model does not know a target class of the table.
[[nodiscard]] ViewModel view_model_of(std::shared_ptr<const uncertainty::Model> model,
                                      const uncertainty::RegionConfig& config,
                                      const objects::ClassTable& table);

}  // namespace saker::active
