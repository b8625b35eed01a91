#include <cmath>
#include <map>

#include "saker/core/statistics.h"
#include "saker/uncertainty/fit.h"
#include "saker/uncertainty/held_out.h"

namespace saker::uncertainty {
namespace {

enum class Kind { constant, perceptron };

using Samples = std::vector<const Sample*>;

SemanticModel::Input input_of(Covariate covariate, const Samples& samples) {
  std::vector<double> values;
  for (const Sample* sample : samples) {
    const double value = value_of(sample->view, covariate);
    if (std::isfinite(value)) values.push_back(value);
  }
  return {covariate, core::mean(values), core::standard_deviation(values)};
}

SemanticModel fitted(const Samples& samples, Kind kind, const std::vector<Covariate>& covariates,
                     const FitConfig& config, std::uint64_t seed) {
  SemanticModel model;
  Eigen::VectorXd targets(static_cast<Eigen::Index>(samples.size()));
  for (Eigen::Index i = 0; i < targets.size(); ++i) {
    targets[i] = samples[static_cast<std::size_t>(i)]->confidence;
  }
  model.mean = targets.mean();
  if (kind == Kind::constant) return model;
  for (const Covariate covariate : covariates) {
    model.inputs.push_back(input_of(covariate, samples));
  }
  Eigen::MatrixXd inputs(3 + static_cast<Eigen::Index>(covariates.size()), targets.size());
  for (Eigen::Index i = 0; i < targets.size(); ++i) {
    inputs.col(i) = model.features(samples[static_cast<std::size_t>(i)]->view);
  }
  model.perceptron = trained(config.confidence, inputs, targets, core::Rng(seed));
  return model;
}

/// Minus the mean squared error of each recording, from fits without it.
HeldOut scores(const Samples& samples, Kind kind, const std::vector<Covariate>& covariates,
               const FitConfig& config, std::uint64_t seed) {
  std::vector<std::string> recordings;
  for (const Sample* sample : samples) recordings.push_back(sample->recording);
  return held_out(recordings, config.folds, [&](const auto& is_held_out) {
    Samples seen, unseen;
    for (const Sample* sample : samples) {
      (is_held_out(sample->recording) ? unseen : seen).push_back(sample);
    }
    std::map<std::string, std::vector<double>> errors;
    if (seen.empty()) return HeldOut{};
    const SemanticModel model = fitted(seen, kind, covariates, config, seed);
    for (const Sample* sample : unseen) {
      const double error = sample->confidence - model.confidence(sample->view);
      errors[sample->recording].push_back(-error * error);
    }
    HeldOut means;
    for (const auto& [recording, values] : errors) means[recording] = core::mean(values);
    return means;
  });
}

}  // namespace

SemanticModel fit_semantic(std::span<const Sample> samples, const FitConfig& config,
                           std::uint64_t seed, std::vector<Trial>& trials) {
  Samples all;
  for (const Sample& sample : samples) all.push_back(&sample);
  const HeldOut constant = scores(all, Kind::constant, {}, config, seed);
  HeldOut best = scores(all, Kind::perceptron, {}, config, seed);
  trials.push_back(trial("confidence: range and angle", best, constant, config.standard_errors));
  if (!trials.back().kept) return fitted(all, Kind::constant, {}, config, seed);
  std::vector<Covariate> kept;
  for (const Covariate covariate : {Covariate::elevation, Covariate::reflectivity}) {
    if (!(input_of(covariate, all).spread > 0)) continue;
    std::vector<Covariate> more = kept;
    more.push_back(covariate);
    const HeldOut with = scores(all, Kind::perceptron, more, config, seed);
    const std::string name = enum_names(covariate)[static_cast<std::size_t>(covariate)];
    trials.push_back(trial("confidence: " + name, with, best, config.standard_errors));
    if (!trials.back().kept) continue;
    kept = more;
    best = with;
  }
  return fitted(all, Kind::perceptron, kept, config, seed);
}

}  // namespace saker::uncertainty
