#include "saker/slam/landmark_estimate.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "saker/objects/view_cell.h"
#include "saker/slam/manifolds.h"

namespace saker::slam {
namespace {

constexpr HiddenEndConfig kNothingHidden{.sds = 1e9};

/// The landmark's normal equations with the poses held, in the landmark's tangent.
struct NormalEquations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
};

/// A measurement in the world frame, and what it weighs.
struct Weighted {
  Weighted(Gaussian in_world, double weighs, const HiddenEndConfig& may_hide, int of_cell)
      : measured(std::move(in_world)), weight(weighs), hidden_ends(may_hide), cell(of_cell) {
    const Eigen::Index size = measured.covariance.rows();
    information = measured.covariance.llt().solve(Eigen::MatrixXd::Identity(size, size));
  }

  Gaussian measured;
  Eigen::MatrixXd information;  ///< inverse of its covariance
  double weight;
  HiddenEndConfig hidden_ends;
  int cell;
};

/// The error of an estimate as its factor weighs it, by the estimate's tangent: slope, whitened².
struct Residual {
  Eigen::VectorXd error;
  Eigen::MatrixXd slope;
  double squared = 0;
};

Residual residual_of(const Model& model, const Weighted& observation) {
  const Gaussian& measured = observation.measured;
  Residual residual;
  residual.error = -difference(measured.model, model);
  const Eigen::Index size = residual.error.size();
  residual.slope = Eigen::MatrixXd::Identity(size, size);
  if (is_cuboid(model)) {
    const HiddenEnds hidden_ends(std::get<objects::Cuboid>(measured.model), measured.covariance,
                                 observation.hidden_ends);
    const HiddenEnds::Softened softened = hidden_ends(residual.error);
    residual.error = softened.error;
    residual.slope = softened.slope;
  }
  residual.squared = residual.error.dot(observation.information * residual.error);
  return residual;
}

/// What Cauchy's kernel leaves of a squared error's weight.
double robust_weight(double squared, const GraphConfig& config) {
  return 1 / (1 + squared / (config.robust_scale * config.robust_scale));
}

void add_observation(const Model& model, const Weighted& observation, const GraphConfig& config,
                     NormalEquations& sum) {
  const Residual residual = residual_of(model, observation);
  const double weight = observation.weight * robust_weight(residual.squared, config);
  const Eigen::MatrixXd weighted = weight * residual.slope.transpose() * observation.information;
  sum.information += weighted * residual.slope;
  sum.gradient -= weighted * residual.error;
}

NormalEquations normal_equations(const Model& model, std::span<const Weighted> all,
                                 const GraphConfig& config) {
  const Eigen::Index size = is_cuboid(model) ? kCuboidTangent : kCylinderTangent;
  NormalEquations sum{Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size)};
  for (const Weighted& observation : all) add_observation(model, observation, config, sum);
  return sum;
}

/// Empty where there is none.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information) {
  const auto solver = information.llt();
  if (solver.info() != Eigen::Success) return {};
  return solver.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
}

/// Summed up to `most` only.
double robust_cost(const Model& model, std::span<const Weighted> all, const GraphConfig& config,
                   double most = INFINITY) {
  double cost = 0;
  for (const Weighted& observation : all) {
    const double squared = residual_of(model, observation).squared;
    cost -= observation.weight * std::log(robust_weight(squared, config));
    if (cost >= most) break;
  }
  return cost;
}

/// The newest of each view cell, and of all.
std::vector<const Weighted*> starts(const std::vector<Weighted>& all) {
  std::map<int, const Weighted*> newest;
  for (const Weighted& observation : all) {
    if (observation.cell >= 0) newest[observation.cell] = &observation;
  }
  if (all.back().cell < 0) newest[-1] = &all.back();
  std::vector<const Weighted*> found;
  for (const auto& [cell, observation] : newest) found.push_back(observation);
  return found;
}

/// All that was measured of a landmark, in the world frame by the estimated poses.
std::vector<Weighted> all_in_world(const Landmark& landmark, Chains chains,
                                   const GraphConfig& config) {
  const std::vector<double> weights = observation_weights(landmark, config.length_axis);
  std::vector<Weighted> all;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Observation& observation = landmark.observations[i];
    const Chain& chain = chains[static_cast<std::size_t>(observation.chain)];
    const Keyframe* keyframe = find(*chain.keyframes, observation.keyframe);
    if (keyframe == nullptr) continue;
    all.emplace_back(transformed(keyframe->T_world_lidar, Matrix6d::Zero(), observation.measured),
                     weights[i], hidden_ends_of(observation, config), observation.cell);
  }
  return all;
}

/// The measurement with the covariance that its factor and its loss make of it at the estimate.
Gaussian as_weighed(const Weighted& observation, const Model& estimate, const GraphConfig& config) {
  Gaussian measured = observation.measured;
  if (is_cuboid(estimate)) {
    const Vector9d error = -difference(measured.model, estimate);
    const HiddenEnds hidden_ends(std::get<objects::Cuboid>(measured.model), measured.covariance,
                                 observation.hidden_ends);
    const Matrix9d widened = hidden_ends(error).secant.inverse();
    measured.covariance = widened * measured.covariance * widened.transpose();
  }
  measured.covariance /= robust_weight(residual_of(estimate, observation).squared, config);
  return measured;
}

/// The roots, at least 1, of the diagonal of the sandwich C B C over that of C, B = n/(n − 1) Σ g
/// gᵀ of the pulls g of n cells.
Eigen::VectorXd scatter(const std::map<int, Eigen::VectorXd>& pulls, const Eigen::MatrixXd& C) {
  const auto n = static_cast<double>(pulls.size());
  if (n < 2) return Eigen::VectorXd::Ones(C.rows());
  Eigen::ArrayXd variance = Eigen::ArrayXd::Zero(C.rows());
  for (const auto& [cell, pull] : pulls) variance += n / (n - 1) * (C * pull).array().square();
  return (variance / C.diagonal().array()).max(1).sqrt();
}

constexpr int kRefineSteps = 5;

}  // namespace

const HiddenEndConfig& hidden_ends_of(const Observation& observation, const GraphConfig& config) {
  return objects::is_corrected(observation.cell) ? kNothingHidden : config.hidden_ends;
}

void hand_over(Landmark& landmark, const Keyframe& from, const Keyframe& to,
               const GraphConfig& config) {
  const auto of_from = [&](const Observation& o) { return o.keyframe == from.serial; };
  std::vector<Observation> handed;
  std::ranges::copy_if(landmark.observations, std::back_inserter(handed), of_from);
  std::erase_if(landmark.observations, of_from);
  for (Observation& observation : handed) {
    const Gaussian in_world =
        transformed(from.T_world_lidar, Matrix6d::Zero(), observation.measured);
    observation.measured =
        transformed(to.T_world_lidar.inverse(), Matrix6d::Zero(),
                    as_weighed({in_world, 1, hidden_ends_of(observation, config), observation.cell},
                               landmark.model, config));
    observation.keyframe = to.serial;
    remember(landmark, observation);
  }
  // What was flown past is a few observations from then on; hundreds were made room for.
  if (landmark.observations.capacity() > 4 * landmark.observations.size()) {
    landmark.observations.shrink_to_fit();
  }
}

void restart_if_better(Landmark& landmark, Chains chains, const GraphConfig& config) {
  const std::vector<Weighted> all = all_in_world(landmark, chains, config);
  if (all.size() < 2) return;
  double least = robust_cost(landmark.model, all, config);
  for (const Weighted* start : starts(all)) {
    Model model = start->measured.model;
    if (auto* cylinder = std::get_if<objects::Cylinder>(&model)) {
      cylinder->height = std::get<objects::Cylinder>(landmark.model).height;
    }
    const double cost = robust_cost(model, all, config, least);
    if (cost >= least) continue;
    least = cost;
    landmark.model = model;
  }
}

Eigen::MatrixXd refine(Landmark& landmark, Chains chains, const GraphConfig& config) {
  restart_if_better(landmark, chains, config);
  const std::vector<Weighted> all = all_in_world(landmark, chains, config);
  NormalEquations sum;
  for (int step = 0; step < kRefineSteps; ++step) {
    sum = normal_equations(landmark.model, all, config);
    const auto solver = sum.information.llt();
    if (solver.info() != Eigen::Success) return {};
    landmark.model = moved(landmark.model, solver.solve(sum.gradient));
  }
  return inverse_of(sum.information);
}

GivenPoses given_poses(const Landmark& landmark, Chains chains, const GraphConfig& config) {
  NormalEquations sum = normal_equations(landmark.model, {}, config);
  std::map<int, Eigen::VectorXd> pulls;  // at the estimate, of each cell: at its best they balance
  int alone = -1;                        // windows without a cell
  for (const Weighted& observation : all_in_world(landmark, chains, config)) {
    const NormalEquations one = normal_equations(landmark.model, {&observation, 1}, config);
    sum.information += one.information;
    const int cell = observation.cell < 0 ? alone-- : observation.cell;
    const auto [pull, first] = pulls.try_emplace(cell, one.gradient);
    if (!first) pull->second += one.gradient;
  }
  GivenPoses given{inverse_of(sum.information), {}};
  if (given.covariance.size() > 0) given.scatter = scatter(pulls, given.covariance);
  return given;
}

std::vector<double> robust_weights(const Landmark& landmark, Chains chains,
                                   const GraphConfig& config) {
  std::vector<double> weights;
  for (const Weighted& observation : all_in_world(landmark, chains, config)) {
    weights.push_back(robust_weight(residual_of(landmark.model, observation).squared, config));
  }
  return weights;
}

}  // namespace saker::slam
