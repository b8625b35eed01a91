#pragma once

#include <Eigen/Core>

/// What is known of an object's place and size, and what a view adds.
///
/// Reads covariances, makes beliefs and their entropy. Frames: [x, y, length, width] in the
/// object's own frame, m². Method: an information filter (the paper, "Uncertainty minimization").
/// Cost: a view is one sum of 8×8, an entropy one solution and two determinants of 4×4.
namespace saker::active {

/// Covariance of an object's [x, y, length, width] or [x, y], m²: 4×4 or 2×2, on the stack.
using Covariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

/// Σ⁻¹ of [x, y, length, width] and of what hides the front, the rear, the left and the right face.
using Information = Eigen::Matrix<double, 8, 8>;

/// How a view measures an object. A face that it does not see lies farther out by
/// `hidden` · u, with one u ~ N(0, 1) a face that is the same in all views: as many as there are
/// from one side, they do not tell where the other one is.
struct Measured {
  Covariance covariance;                             ///< Σ_z of what differs from view to view
  Eigen::Vector4d hidden = Eigen::Vector4d::Zero();  ///< m, of front, rear, left and right
};

/// The information of a view, zero where it says nothing.
/// \param drift  m², variance that x and y have beside: the pose's, since the object was first
/// seen.
[[nodiscard]] Information information_of(const Measured& measured, double drift);

/// What is known of an object's [x, y, length, width] (its own frame, m), relative to the robot.
///
/// Paper, "Uncertainty minimization": Σ_{t+1} = (Σ_t⁻¹ + Σ_z⁻¹)⁻¹, entropy ½ ln det Σ (without the
/// constant of a normal distribution, as there). Beyond it, the state is augmented by what hides
/// each face (as by a bias: Friedland, Treatment of bias in recursive filtering, 1969), Σ is the
/// marginal one. What all views of an object have in common stands beside it: no number of views
/// takes that away. Objects with two errors only (cylinders) have unit variances in the place of
/// the others (`padded`), which neither gain nor lose.
class Belief {
 public:
  /// Both of one size; `common` may be zero.
  Belief(const Covariance& prior, const Covariance& common);

  /// \param information  of a view that shares no error with those before but what hides faces.
  void add(const Information& information) { information_ += information; }

  /// Of an object that is known to `covariance` (without what is common) by whatever means; what
  /// hides its faces is known, given the object, as it was.
  [[nodiscard]] Belief known_to(const Covariance& covariance) const;

  /// Σ + common.
  [[nodiscard]] Eigen::Matrix4d covariance() const;

  /// nat; ½ ln det of `covariance`.
  [[nodiscard]] double entropy() const;

  /// nat, at least what `added` takes off `entropy`: what it takes off that of the object and of
  /// what hides its faces, in which nothing is common. Submodular: it shrinks as more is known.
  [[nodiscard]] double most_gain(const Information& added) const;

 private:
  [[nodiscard]] Eigen::Matrix4d hidden_share() const;
  [[nodiscard]] Eigen::Matrix4d marginal() const;

  Information information_;
  Eigen::Matrix4d common_;
};

}  // namespace saker::active
