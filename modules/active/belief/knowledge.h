#pragma once

#include <map>

#include "saker/active/belief.h"
#include "saker/active/looks.h"
#include "saker/active/pams_config.h"
#include "saker/active/targets.h"
#include "saker/active/view_model.h"

namespace saker::active {

/// How a target is seen from `eye` (world), as the class's model asks for it.
[[nodiscard]] uncertainty::View view_from(const Eigen::Vector3d& eye, const Target& target,
                                          const ViewModel& model);

struct PredictedView {
  int cell = -1;  ///< of the uncertainty model
  Measured measured;
};

/// How a view from `eye` (world) measures the target. One that shows it from end to end in one of
/// n windows tells a nth; told face by face, of those that it does not look at.
[[nodiscard]] PredictedView predicted(const Eigen::Vector3d& eye, const Target& target,
                                      const ViewModel& model, const PamsConfig& config);

/// What the flight so far tells of one target: the paper's recursion over the cells of the model
/// from which it was in view for a dwell. However long that was, a cell counts once: with the mean
/// information of its views.
class Knowledge {
 public:
  Knowledge(const Target& target, const Looks& looks, const ViewModel& model,
            const PamsConfig& config);

  [[nodiscard]] const Belief& belief() const { return belief_; }
  [[nodiscard]] bool counted(int cell) const { return cells_.contains(cell); }
  [[nodiscard]] int cells() const { return static_cast<int>(cells_.size()); }

  /// What a map that knows the object to `covariance` (given the poses) by now will know after more
  /// looks. Where it knows less than these looks should have told, its views contradict each other,
  /// and further ones will: they tell so much less, too.
  /// \param then  of the same target after them
  [[nodiscard]] Belief expected(const Covariance& covariance, const Knowledge& then) const;

 private:
  [[nodiscard]] double scatter_of(const Belief& map) const;

  Covariance common_;  ///< as far as it counts
  Belief belief_;
  std::map<int, Information> cells_;  ///< that count, and their information
};

/// What the map will know of the target when it holds the looks `until`; SLAM counts a cell from
/// its first window on.
/// \param held those of `until` that it holds by now
[[nodiscard]] Belief map_belief(const Target& target, const Looks& held, const Looks& until,
                                const ViewModel& model, const PamsConfig& config);

/// [x, y, length, width] or [x, y] before the first view.
[[nodiscard]] Covariance prior_covariance(const PamsConfig& config, bool cylinder);

}  // namespace saker::active
