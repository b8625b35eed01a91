#include "saker/uncertainty/regions.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <vector>

#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/core/statistics.h"

namespace saker::uncertainty {
namespace {

constexpr int kDraws = 512;

/// Normal draws of mean 0 and covariance 1 to the last digit.
Eigen::MatrixXd normal_draws(Eigen::Index dimension) {
  core::Rng rng(1);
  Eigen::MatrixXd draws(dimension, kDraws);
  for (double& value : draws.reshaped()) value = rng.normal();
  draws.colwise() -= Eigen::VectorXd(draws.rowwise().mean());
  const Eigen::MatrixXd covariance = draws * draws.transpose() / kDraws;
  covariance.llt().matrixL().solveInPlace(draws);
  return draws;
}

/// Views over all intervals that were flown, each at its middle.
std::vector<View> flown_views(const Intervals& intervals) {
  std::vector<View> views;
  for (int range = 0; range < intervals.ranges(); ++range) {
    for (int sector = 0; sector < intervals.sectors; ++sector) {
      View view;
      view.range = intervals.range_centre(range);
      view.angle = intervals.sectors > 1 ? intervals.sector_centre(sector) : 0;
      views.push_back(view);
    }
  }
  return views;
}

/// The threshold itself where some view reaches it, else what the best share reaches.
double reached(double threshold, const std::vector<double>& values, double best_share) {
  if (core::percentile(values, 1) >= threshold) return threshold;
  return core::percentile(values, 1 - best_share);
}

}  // namespace

Regions::Regions(const RegionConfig& config, const Model& model, objects::ClassId id)
    : config_(core::checked(config, "regions")), model_(&model), id_(id) {
  if (!model.knows(id)) {
    throw Error(fmt::format("regions: the uncertainty model does not know class {}", int{id}));
  }
  draws_ = normal_draws(model.common_covariance(id).rows());
  std::vector<double> confidences, probabilities;
  for (const View& view : flown_views(model.of(id).geometric.parts().intervals)) {
    const Prediction prediction = model.predict(id, view);
    if (prediction.extrapolated) continue;
    confidences.push_back(prediction.confidence);
    probabilities.push_back(small_error_probability(prediction));
  }
  least_confidence_ = reached(config_.confidence, confidences, config_.best_share);
  least_probability_ = reached(config_.probability, probabilities, config_.best_share);
}

double Regions::small_error_probability(const Prediction& prediction) const {
  const Eigen::MatrixXd factor =
      (prediction.covariance + model_->common_covariance(id_)).llt().matrixL();
  const Eigen::MatrixXd errors = factor * draws_;
  int small = 0;
  for (Eigen::Index i = 0; i < errors.cols(); ++i) {
    const bool place = errors.col(i).head<2>().norm() < config_.place_error_m;
    const auto sizes = errors.col(i).tail(errors.rows() - 2).array().abs();
    if (place && (sizes < config_.size_error_m).all()) ++small;
  }
  return prediction.whole * small / kDraws;
}

double Regions::small_error_probability(const View& view) const {
  return small_error_probability(model_->predict(id_, view));
}

bool Regions::confident(const View& view) const {
  return model_->predict(id_, view).confidence >= least_confidence_;
}

bool Regions::precise(const View& view) const {
  return small_error_probability(view) >= least_probability_;
}

bool Regions::contains(const View& view) const {
  const Prediction prediction = model_->predict(id_, view);
  return !prediction.extrapolated && prediction.confidence >= least_confidence_ &&
         small_error_probability(prediction) >= least_probability_;
}

}  // namespace saker::uncertainty
