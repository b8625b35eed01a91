#pragma once

#include <span>
#include <vector>

#include "saker/core/budget.h"
#include "saker/slam/graph_config.h"
#include "saker/slam/landmark.h"
#include "saker/slam/trajectory.h"

namespace saker::slam {

struct SolveReport {
  bool usable = true;  ///< the estimate is finite and no worse than before
  bool converged = false;
  int iterations = 0;
  double initial_cost = 0, final_cost = 0;
};

/// Moves the chains' poses and the given landmarks to less cost; keyframes that a chain holds, or
/// the first one of a chain without a prior, hold the frame. With a budget of no iterations nothing
/// changes.
SolveReport solve_graph(Chains chains, std::span<Landmark* const> landmarks,
                        const GraphConfig& config, const core::Budget& budget);

struct CovarianceReport {
  std::vector<Eigen::MatrixXd>
      covariances;  ///< in the order asked for, each in the object's own frame (as in Measurement)
  bool marginal = true;  ///< poses marginalised; false: given the poses, because the graph's could
                         ///< not be computed
};

/// Covariances of `wanted` (a subset of `landmarks`) in the world frame, given what the chains
/// hold.
[[nodiscard]] CovarianceReport graph_covariance(Chains chains, std::span<Landmark* const> landmarks,
                                                std::span<const Landmark* const> wanted,
                                                const GraphConfig& config);

}  // namespace saker::slam
