#pragma once

#include <Eigen/Core>

namespace saker::active {

/// Covariance of an object's [x, y, length, width] or [x, y], m²: 4×4 or 2×2, on the stack.
using Covariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

/// Σ_z⁻¹ of a view, zero where it says nothing.
/// \param drift  m², variance that x and y have beside: the pose's, since the object was first
/// seen.
[[nodiscard]] Eigen::Matrix4d information_of(const Covariance& covariance, double drift);

/// What is known of an object's [x, y, length, width] (its own frame, m), relative to the robot.
///
/// Paper, "Uncertainty minimization": Σ_{t+1} = (Σ_t⁻¹ + Σ_z⁻¹)⁻¹, entropy ½ ln det Σ (without the
/// constant of a normal distribution, as there). What all views of an object have in common stands
/// beside it: no number of views takes that away. Objects with two errors only (cylinders) have
/// unit variances in the place of the others (`padded`), which neither gain nor lose.
class Belief {
 public:
  /// Both of one size; `common` may be zero.
  Belief(const Covariance& prior, const Covariance& common);

  /// \param information  Σ_z⁻¹ of a view that shares no error with those before.
  void add(const Eigen::Matrix4d& information) { information_ += information; }

  /// Σ + common.
  [[nodiscard]] Eigen::Matrix4d covariance() const;

  /// nat; ½ ln det of `covariance`.
  [[nodiscard]] double entropy() const;

  /// nat, at least what `added` takes off `entropy`: what it takes off ½ ln det Σ, in which nothing
  /// is common. Submodular: it shrinks as more is known.
  [[nodiscard]] double most_gain(const Eigen::Matrix4d& added) const;

 private:
  Eigen::Matrix4d information_;
  Eigen::Matrix4d common_;
};

}  // namespace saker::active
