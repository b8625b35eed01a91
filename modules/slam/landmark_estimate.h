#pragma once

#include <vector>

#include "saker/slam/graph_config.h"
#include "saker/slam/landmark.h"
#include "saker/slam/trajectory.h"

/// What one landmark's own observations say of it, with the poses held.
namespace saker::slam {

/// The landmark's estimate from its own observations, started anew by `restart_if_better`: what
/// candidates get, and the start after a merge. \return its covariance given the poses, in the
/// landmark's own frame.
Eigen::MatrixXd refine(Landmark& landmark, Chains chains, const GraphConfig& config);

/// How sure the estimate is, given the poses.
struct GivenPoses {
  Eigen::MatrixXd covariance;  ///< in the object's own frame; empty where nothing was measured
  Eigen::VectorXd scatter;     ///< of the standard deviations: by how much more the view cells
                               ///< disagree than their covariances have it, at least 1
};

/// One linearisation. The scatter is that of the sandwich estimator (Huber, The behavior of maximum
/// likelihood estimates under nonstandard conditions, 1967; by cells: Liang and Zeger, Longitudinal
/// data analysis using generalized linear models, 1986), as large as errors that covariances do not
/// know: where one view took something else for a vehicle's end, the others contradict it. Raised
/// only, as in the scale factor of Birge (The calculation of errors by the method of least squares,
/// 1932): few cells agree by chance.
[[nodiscard]] GivenPoses given_poses(const Landmark& landmark, Chains chains,
                                     const GraphConfig& config);

/// Moves the estimate to the newest measurement, of all or from one of its view cells, at which the
/// robust cost of all is least, if it is less there: a robust estimate that began at a part of a
/// vehicle, or with a bush behind it, would never leave it, however many views tell of another.
void restart_if_better(Landmark& landmark, Chains chains, const GraphConfig& config);

/// Hands what was measured from keyframe `from` on to keyframe `to`, both held, as it weighs in the
/// graph now: what is held takes no more memory, however long it was looked at.
void hand_over(Landmark& landmark, const Keyframe& from, const Keyframe& to,
               const GraphConfig& config);

/// What the robust kernel leaves of each observation's weight, by the current estimate: 1 where
/// they agree.
[[nodiscard]] std::vector<double> robust_weights(const Landmark& landmark, Chains chains,
                                                 const GraphConfig& config);

/// What may hide its ends: what is taken for corrected shows both.
[[nodiscard]] const HiddenEndConfig& hidden_ends_of(const Observation& observation,
                                                    const GraphConfig& config);

}  // namespace saker::slam
