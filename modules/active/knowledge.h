#pragma once

#include <vector>

#include "active/belief.h"
#include "active/looks.h"
#include "active/pams_config.h"
#include "active/targets.h"
#include "active/view_model.h"

namespace saker::active {

/// How a target is seen from `eye` (world), as the class's model asks for it.
[[nodiscard]] uncertainty::View view_from(const Eigen::Vector3d& eye, const Target& target,
                                          const ViewModel& model);

/// What a view from `eye` (world) tells of the target.
[[nodiscard]] uncertainty::Prediction predicted(const Eigen::Vector3d& eye, const Target& target,
                                                const ViewModel& model, const PamsConfig& config);

/// What the flight so far tells of one target: the paper's recursion over the cells of the model
/// from which it was in view for a dwell. However long that was, a cell counts once: with the mean
/// information of its views.
class Knowledge {
 public:
  Knowledge(const Target& target, const Looks& looks, const ViewModel& model,
            const PamsConfig& config);

  [[nodiscard]] const Belief& belief() const { return belief_; }
  [[nodiscard]] bool counted(int cell) const;
  [[nodiscard]] int cells() const { return static_cast<int>(cells_.size()); }

 private:
  Belief belief_;
  std::vector<int> cells_;  ///< that count
};

/// [x, y, length, width] or [x, y] before the first view.
[[nodiscard]] Covariance prior_covariance(const PamsConfig& config, bool cylinder);

}  // namespace saker::active
