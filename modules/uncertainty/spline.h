#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/uncertainty/intervals.h"

namespace saker::uncertainty {

/// A smooth surface through one vector a interval, over range and |angle|: cubic Hermite splines,
/// monotone between neighbours (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 1984), so that they
/// do not swing over between intervals. In angle it goes on at 0 and π as its own mirror image; in
/// range it is constant beyond the outermost centres.
class SplineSurface {
 public:
  SplineSurface() = default;
  /// \param nodes   one an interval, at its centre
  /// \param parity  of each entry under the mirror: 1 it stays, −1 it changes its sign
  SplineSurface(Intervals intervals, std::vector<Eigen::VectorXd> nodes, Eigen::VectorXd parity);

  [[nodiscard]] Eigen::VectorXd at(double range, double folded_angle) const;

 private:
  [[nodiscard]] Eigen::VectorXd along_angle(int range, double folded_angle) const;
  [[nodiscard]] Eigen::VectorXd node(int range, int sector) const;

  Intervals intervals_;
  std::vector<Eigen::VectorXd> nodes_;
  Eigen::VectorXd parity_;
};

}  // namespace saker::uncertainty
