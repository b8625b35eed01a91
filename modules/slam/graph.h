#pragma once

#include <span>
#include <vector>

#include "core/budget.h"
#include "slam/hidden_ends.h"
#include "slam/landmark.h"
#include "slam/trajectory.h"

namespace saker::slam {

struct GraphConfig {
  int iterations = 4;
  double function_tolerance = 1e-5;
  double robust_scale = 3;
  HiddenEndConfig hidden_ends;
  LengthAxisConfig length_axis;
  int movable_keyframes = 600;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("iterations", iterations, {0, 1000}, "",
            "most Levenberg-Marquardt steps a cycle; the start is the last cycle's estimate");
    v.field("function_tolerance", function_tolerance, {0, 1}, "",
            "relative decrease of the cost at which a cycle ends");
    v.field(
        "robust_scale", robust_scale, {0.1, 1000}, "",
        "Cauchy's scale on whitened errors of objects: half weight at 9, the mean of nine degrees "
        "of freedom; parts taken for wholes, far from where covariances hold, weigh little");
    v.group("hidden_ends", hidden_ends, "ends of vehicles that were hidden");
    v.group("length_axis", length_axis, "windows that took a side for the length are left out");
    v.field("movable_keyframes", movable_keyframes, {1, 100000}, "",
            "the newest so many move; older ones are held where they are: what a cycle costs does "
            "not grow for ever. Ten minutes at 1 m/s");
  }
};

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

/// Hands what was measured from keyframe `from` on to keyframe `to`, both held, as it weighs in the
/// graph now: what is held takes no more memory, however long it was looked at.
void hand_over(Landmark& landmark, const Keyframe& from, const Keyframe& to,
               const GraphConfig& config);

/// The landmark's estimate from its own observations with the poses held: what candidates get, and
/// the start after a merge. \return its covariance given the poses, in the landmark's own frame.
/// The newest measurement is tried as a start too: a robust estimate that began at a part of a
/// vehicle would never leave it.
Eigen::MatrixXd refine(Landmark& landmark, Chains chains, const GraphConfig& config);

/// Covariance of the estimate given the poses, in the object's own frame; empty where nothing was
/// measured. One linearisation.
[[nodiscard]] Eigen::MatrixXd covariance_given_poses(const Landmark& landmark, Chains chains,
                                                     const GraphConfig& config);

/// Moves the estimate to its newest measurement where the robust cost of all is less there.
void restart_if_better(Landmark& landmark, Chains chains, const GraphConfig& config);

/// What the robust kernel leaves of each observation's weight, by the current estimate: 1 where
/// they agree.
[[nodiscard]] std::vector<double> robust_weights(const Landmark& landmark, Chains chains,
                                                 const GraphConfig& config);

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
