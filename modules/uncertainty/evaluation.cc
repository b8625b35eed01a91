#include "saker/uncertainty/evaluation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <map>
#include <vector>

#include "saker/core/statistics.h"

namespace saker::uncertainty {
namespace {

/// Mean error of one object from one cell, its bias taken off, and the covariance it should have.
struct Draw {
  Eigen::VectorXd error;
  Eigen::MatrixXd covariance;
  int samples = 0;

  void add(const Eigen::VectorXd& rest, const Eigen::MatrixXd& expected) {
    if (samples == 0) {
      error = Eigen::VectorXd::Zero(rest.size());
      covariance = Eigen::MatrixXd::Zero(rest.size(), rest.size());
    }
    ++samples;
    error += (rest - error) / samples;
    covariance += (expected - covariance) / samples;
  }
};

using ObjectDraws = std::map<int, Draw>;  // by cell

double nees(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  return error.dot(covariance.llt().solve(error)) / static_cast<double>(error.size());
}

/// Weighted by information, each cell once.
Draw fused(const ObjectDraws& draws) {
  const Eigen::Index n = draws.begin()->second.error.size();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd weighted = Eigen::VectorXd::Zero(n);
  for (const auto& [cell, draw] : draws) {
    const Eigen::MatrixXd known = draw.covariance.inverse();
    information += known;
    weighted += known * draw.error;
  }
  Draw all;
  all.covariance = information.inverse();
  all.error = all.covariance * weighted;
  return all;
}

void judge_confidence(const ClassModel& model, objects::ClassId id, std::span<const Sample> samples,
                      Evaluation& evaluation) {
  std::vector<double> errors, constants;
  for (const Sample& sample : samples) {
    if (sample.class_id != id) continue;
    errors.push_back(std::pow(sample.confidence - model.semantic.confidence(sample.view), 2));
    constants.push_back(std::pow(sample.confidence - model.semantic.mean, 2));
  }
  evaluation.confidence_error = std::sqrt(core::mean(errors));
  evaluation.constant_error = std::sqrt(core::mean(constants));
}

/// Mean and standard deviation entry by entry.
void summarise(const std::vector<Eigen::VectorXd>& errors, Evaluation& evaluation) {
  if (errors.empty()) return;
  const Eigen::Index n = errors.front().size();
  evaluation.fused_error_mean.resize(n);
  evaluation.fused_error_sd.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    std::vector<double> values;
    for (const Eigen::VectorXd& error : errors) values.push_back(error[k]);
    evaluation.fused_error_mean[k] = core::mean(values);
    evaluation.fused_error_sd[k] = core::standard_deviation(values);
  }
}

}  // namespace

Evaluation evaluate(const Model& model, objects::ClassId id, std::span<const Sample> samples) {
  std::map<std::pair<std::string, int>, ObjectDraws> objects;
  for (const Sample& sample : samples) {
    if (sample.class_id != id) continue;
    if (!is_whole(sample, model.of(id).geometric.parts().whole_length_sd_m)) continue;
    const Prediction prediction = model.predict(id, sample.view);
    if (prediction.extrapolated) continue;
    objects[{sample.recording, sample.object_id}][prediction.cell].add(
        sample.error - prediction.bias, prediction.covariance);
  }
  const Eigen::MatrixXd& common = model.common_covariance(id);
  std::vector<double> single, together;
  std::vector<Eigen::VectorXd> errors;
  for (const auto& [object, draws] : objects) {
    for (const auto& [cell, draw] : draws) {
      single.push_back(nees(draw.error, draw.covariance + common));
    }
    const Draw all = fused(draws);
    together.push_back(nees(all.error, all.covariance + common));
    errors.push_back(all.error);
  }
  Evaluation evaluation;
  evaluation.draws = static_cast<int>(single.size());
  evaluation.nees = core::mean(single);
  evaluation.objects = static_cast<int>(together.size());
  evaluation.fused_nees = core::mean(together);
  summarise(errors, evaluation);
  judge_confidence(model.of(id), id, samples, evaluation);
  return evaluation;
}

}  // namespace saker::uncertainty
