#pragma once

#include <map>

#include "saker/active/belief/belief.h"
#include "saker/active/belief/view_history.h"
#include "saker/active/belief/view_model.h"
#include "saker/active/tour/targets.h"
#include "saker/active/views/pams_config.h"

/// What views tell of a target.
///
/// Reads the target's estimate, its views and the fitted model of their errors, makes its belief.
/// Frames: eyes are in `world`, covariances of [x, y, length, width] in the target's own frame, m².
/// Method: the paper, "Uncertainty minimization". Cost: one prediction for each dwell.
namespace saker::active {

/// How a target is seen from `eye` (world), as the class's model asks for it.
[[nodiscard]] uncertainty::View view_from(const Eigen::Vector3d& eye, const Target& target,
                                          const ViewModel& model);

struct PredictedView {
  int cell = -1;  ///< of the uncertainty model
  Measured measured;
};

/// How a view from `eye` (world) measures the target. A view that shows it from end to end in one
/// of n windows has a nth of the information; where faces count, this holds for the faces that the
/// view does not see.
[[nodiscard]] PredictedView predicted(const Eigen::Vector3d& eye, const Target& target,
                                      const ViewModel& model, const PamsConfig& config);

/// The belief of one target by its views: the paper's recursion over the cells of the model from
/// which it was in view for a dwell. However long that was, a cell counts once: with the mean
/// information of its views.
class Knowledge {
 public:
  Knowledge(const Target& target, const ViewHistory& views, const ViewModel& model,
            const PamsConfig& config);

  [[nodiscard]] const Belief& belief() const { return belief_; }
  [[nodiscard]] bool counted(int cell) const { return cells_.contains(cell); }
  [[nodiscard]] int cells() const { return static_cast<int>(cells_.size()); }

  /// What a map that knows the object to `covariance` (given the poses) by now will know after more
  /// views. Where it knows less than the views so far should have measured, they contradict each
  /// other, and further ones will: they tell so much less, too. \param then  of the same target
  /// after them
  [[nodiscard]] Belief expected(const Covariance& covariance, const Knowledge& then) const;

 private:
  [[nodiscard]] double scatter_of(const Belief& map) const;

  Covariance common_;  ///< as far as it counts
  Belief belief_;
  std::map<int, Information> cells_;  ///< that count, and their information
};

/// What the map will know of the target when it holds the views `until`; SLAM counts a cell from
/// its first window on.
/// \param held those of `until` that it holds by now
[[nodiscard]] Belief map_belief(const Target& target, const ViewHistory& held,
                                const ViewHistory& until, const ViewModel& model,
                                const PamsConfig& config);

/// [x, y, length, width] or [x, y] before the first view.
[[nodiscard]] Covariance prior_covariance(const PamsConfig& config, bool cylinder);

}  // namespace saker::active
