#include "saker/uncertainty/uncertainty.h"

#include <utility>

#include "saker/core/files.h"
#include "saker/uncertainty/model_file.h"

namespace saker::uncertainty {

Model::Model(const std::vector<ClassModel>& classes, Provenance provenance)
    : provenance_(std::move(provenance)) {
  for (const ClassModel& model : classes) classes_.emplace(model.id, model);
}

Model Model::load(const std::filesystem::path& file, const objects::ClassTable& table) {
  return model_from_text(core::read_file(file), file.string(), table);
}

void Model::save(const std::filesystem::path& file, const objects::ClassTable& table) const {
  core::write_file(file, model_text(*this, table));
}

Prediction Model::predict(objects::ClassId id, const View& view) const {
  const ClassModel& model = classes_.at(id);
  GeometricModel::Expected expected = model.geometric.expected(view);
  Prediction prediction;
  prediction.confidence = model.semantic.confidence(view);
  prediction.bias = std::move(expected.bias);
  prediction.covariance = std::move(expected.covariance);
  prediction.whole = expected.whole;
  prediction.extrapolated = expected.extrapolated;
  prediction.cell = model.geometric.parts().intervals.cell_of(view);
  if (bias_stays_) {
    prediction.covariance += prediction.bias * prediction.bias.transpose();
    prediction.bias.setZero();
  }
  return prediction;
}

Model Model::about_truth() const {
  Model model = *this;
  model.bias_stays_ = true;
  return model;
}

const Eigen::MatrixXd& Model::common_covariance(objects::ClassId id) const {
  return classes_.at(id).geometric.parts().common;
}

}  // namespace saker::uncertainty
