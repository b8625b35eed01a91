#include "saker/slam/graph.h"

#include <ceres/covariance.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "saker/slam/factors.h"
#include "saker/slam/landmark_estimate.h"

namespace saker::slam {
namespace {

int parameter_count(const Model& model) {
  return is_cuboid(model) ? kCuboidParameters : kCylinderParameters;
}

void write_model(const Model& model, double* parameters) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    write_pose(cuboid->pose, parameters);
    Eigen::Map<Eigen::Vector3d>{parameters + kPoseParameters} = cuboid->size;
    return;
  }
  const auto& cylinder = std::get<objects::Cylinder>(model);
  Eigen::Map<Eigen::Vector3d>{parameters} = cylinder.root;
  Eigen::Map<Eigen::Vector3d>{parameters + 3} = cylinder.axis;
  parameters[6] = cylinder.radius;
}

void read_model(const double* parameters, Model& model) {
  if (auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    cuboid->pose = pose_from(parameters);
    cuboid->size =
        Eigen::Map<const Eigen::Vector3d>(parameters + kPoseParameters).cwiseMax(kLeastSize);
    return;
  }
  auto& cylinder = std::get<objects::Cylinder>(model);
  cylinder.root = Eigen::Map<const Eigen::Vector3d>(parameters);
  cylinder.axis = Eigen::Map<const Eigen::Vector3d>(parameters + 3);
  cylinder.radius = std::max(parameters[6], kLeastSize);
}

ceres::Problem::Options keep_ownership() {
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

/// Keyframes of a chain that do not move.
std::size_t held(const Chain& chain) {
  return std::max<std::size_t>(chain.free_from, chain.prior ? 0 : 1);
}

/// Poses and landmarks as a Ceres problem. All parameters lie in one array in the order of
/// keyframes and landmarks, so that nothing depends on addresses.
class Graph {
 public:
  Graph(Chains chains, std::span<Landmark* const> landmarks, const GraphConfig& config)
      : config_(config), loss_(config.robust_scale), problem_(keep_ownership()) {
    reserve(chains, landmarks);
    for (std::size_t c = 0; c < chains.size(); ++c) add_chain(chains[c], c);
    for (std::size_t l = 0; l < landmarks.size(); ++l) add_landmark(chains, *landmarks[l], l);
  }

  [[nodiscard]] ceres::Problem& problem() { return problem_; }
  [[nodiscard]] double* pose(std::size_t chain, std::size_t k) {
    return parameters_.data() + (first_pose_[chain] + k) * kPoseParameters;
  }
  [[nodiscard]] double* landmark(std::size_t l) { return parameters_.data() + offsets_[l]; }
  [[nodiscard]] bool finite() const {
    return std::all_of(parameters_.begin(), parameters_.end(),
                       [](double p) { return std::isfinite(p); });
  }

 private:
  void reserve(Chains chains, std::span<Landmark* const> landmarks) {
    std::size_t poses = 0;
    for (const Chain& chain : chains) {
      first_pose_.push_back(poses);
      poses += chain.keyframes->size();
    }
    std::size_t size = poses * kPoseParameters;
    for (const Landmark* landmark : landmarks) {
      offsets_.push_back(size);
      size += static_cast<std::size_t>(parameter_count(landmark->model));
    }
    parameters_.assign(size, 0);
  }

  void add_chain(const Chain& chain, std::size_t c) {
    const std::vector<Keyframe>& keyframes = *chain.keyframes;
    for (std::size_t k = 0; k < keyframes.size(); ++k) {
      write_pose(keyframes[k].T_world_lidar, pose(c, k));
      if (k < held(chain)) continue;
      problem_.AddParameterBlock(pose(c, k), kPoseParameters, &pose_manifold_);
      if (k == 0) continue;
      const SE3 motion = keyframes[k - 1].T_odom_lidar.inverse() * keyframes[k].T_odom_lidar;
      problem_.AddResidualBlock(new OdometryFactor(motion, keyframes[k].covariance), nullptr,
                                pose(c, k - 1), pose(c, k));
      if (k == held(chain)) problem_.SetParameterBlockConstant(pose(c, k - 1));
    }
    if (keyframes.empty() || held(chain) > 0) return;
    problem_.AddResidualBlock(new PoseFactor(chain.prior->pose, chain.prior->covariance), nullptr,
                              pose(c, 0));
  }

  void add_landmark(Chains chains, const Landmark& landmark, std::size_t l) {
    double* parameters = this->landmark(l);
    write_model(landmark.model, parameters);
    ceres::Manifold* manifold = &cylinder_manifold_;
    if (is_cuboid(landmark.model)) manifold = &cuboid_manifold_;
    problem_.AddParameterBlock(parameters, parameter_count(landmark.model), manifold);
    const std::vector<double> weights = observation_weights(landmark, config_.length_axis);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Observation& observation = landmark.observations[i];
      const auto c = static_cast<std::size_t>(observation.chain);
      const int k = observation.keyframe - chains[c].keyframes->front().serial;
      if (k < 0) continue;
      double* from = pose(c, static_cast<std::size_t>(k));
      const Gaussian& measured = observation.measured;
      problem_.AddResidualBlock(
          object_factor(measured.model, measured.covariance, hidden_ends_of(observation, config_))
              .release(),
          weighted_loss(weights[i]), from, parameters);
      if (static_cast<std::size_t>(k) < held(chains[c])) problem_.SetParameterBlockConstant(from);
    }
  }

  /// What is an outlier stays one, however many windows of its cell it shares the weight with.
  ceres::LossFunction* weighted_loss(double weight) {
    if (weight == 1) return &loss_;
    weighted_losses_.push_back(
        std::make_unique<ceres::ScaledLoss>(&loss_, weight, ceres::DO_NOT_TAKE_OWNERSHIP));
    return weighted_losses_.back().get();
  }

  const GraphConfig& config_;
  PoseManifold pose_manifold_;
  CuboidManifold cuboid_manifold_;
  CylinderManifold cylinder_manifold_;
  ceres::CauchyLoss loss_;
  std::vector<std::unique_ptr<ceres::ScaledLoss>> weighted_losses_;
  std::vector<double> parameters_;
  std::vector<std::size_t> first_pose_;  ///< of each chain, among all
  std::vector<std::size_t> offsets_;
  ceres::Problem problem_;
};

ceres::Solver::Options solver_options(const GraphConfig& config, const core::Budget& budget) {
  omp_set_max_active_levels(0);  // CHOLMOD's threads wait for each other longer than they work
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = std::min(config.iterations, budget.most_iterations());
  options.max_solver_time_in_seconds = std::min(budget.seconds_left(), 1e6);
  options.function_tolerance = config.function_tolerance;
  options.initial_trust_region_radius = config.trust_radius;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

SolveReport solve_graph(Chains chains, std::span<Landmark* const> landmarks,
                        const GraphConfig& config, const core::Budget& budget) {
  SolveReport report;
  const bool still = std::ranges::all_of(
      chains, [](const Chain& chain) { return chain.keyframes->size() <= held(chain); });
  if (still || config.iterations == 0 || budget.used_up(0)) return report;
  Graph graph(chains, landmarks, config);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(config, budget), &graph.problem(), &summary);
  report.usable = summary.IsSolutionUsable() && graph.finite();
  report.converged = summary.termination_type == ceres::CONVERGENCE;
  report.iterations = static_cast<int>(summary.iterations.size()) - 1;
  report.initial_cost = summary.initial_cost;
  report.final_cost = summary.final_cost;
  if (!report.usable) return report;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    std::vector<Keyframe>& keyframes = *chains[c].keyframes;
    for (std::size_t k = held(chains[c]); k < keyframes.size(); ++k)
      keyframes[k].T_world_lidar = pose_from(graph.pose(c, k));
  }
  for (std::size_t l = 0; l < landmarks.size(); ++l)
    read_model(graph.landmark(l), landmarks[l]->model);
  return report;
}

CovarianceReport graph_covariance(Chains chains, std::span<Landmark* const> landmarks,
                                  std::span<const Landmark* const> wanted,
                                  const GraphConfig& config) {
  Graph graph(chains, landmarks, config);
  std::vector<std::pair<const double*, const double*>> blocks;
  for (const Landmark* landmark : wanted) {
    const auto at = std::find(landmarks.begin(), landmarks.end(), landmark);
    const double* parameters = graph.landmark(static_cast<std::size_t>(at - landmarks.begin()));
    blocks.emplace_back(parameters, parameters);
  }
  ceres::Covariance::Options options;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  CovarianceReport report;
  report.marginal = !blocks.empty() && covariance.Compute(blocks, &graph.problem());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Landmark copy = *wanted[i];
    Eigen::MatrixXd result = refine(copy, chains, config);
    if (report.marginal) {
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(result.rows(),
                                                                                   result.cols());
      covariance.GetCovarianceBlockInTangentSpace(blocks[i].first, blocks[i].first, block.data());
      result = block;
    }
    report.covariances.push_back(std::move(result));
  }
  return report;
}

}  // namespace saker::slam
