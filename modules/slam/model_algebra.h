#pragma once

#include <Eigen/Core>

#include "saker/objects/models.h"

/// Sums, differences and turns of object models in the tangents of DESIGN section 3.
namespace saker::slam {

using objects::Model;

/// b ⊖ a, in a's own frame: 9 of a cuboid, 6 of a cylinder. Both are of one shape.
[[nodiscard]] Eigen::VectorXd difference(const Model& b, const Model& a);

/// m. No step makes an object smaller: the optimum of a few poor views may lie at a negative
/// radius.
inline constexpr double kLeastSize = 0.01;

/// a ⊕ δ, of `kLeastSize` at least.
[[nodiscard]] Model moved(const Model& a, const Eigen::VectorXd& step);

/// A model and its covariance as one measurement.
struct Gaussian {
  Model model;
  Eigen::MatrixXd covariance;
};

/// Carried into another frame by a motion that is itself uncertain (right tangent at T_b_a).
[[nodiscard]] Gaussian transformed(const SE3& T_b_a, const Matrix6d& motion, const Gaussian& in_a);

/// The mean of two measurements of one object in one frame, weighted by their information.
[[nodiscard]] Gaussian fused(const Gaussian& a, const Gaussian& b);

/// A cuboid has four names: its frame turned about z by quarters, length and width swapped by odd
/// ones.
[[nodiscard]] objects::Cuboid turned(const objects::Cuboid& cuboid, int quarters);
[[nodiscard]] Gaussian turned(const Gaussian& cuboid, int quarters);

/// Evidence for the front along x and y (log-odds), as seen from the turned frame.
[[nodiscard]] Eigen::Vector2d turned(const Eigen::Vector2d& front, int quarters);

/// Quarters by which `cuboid` is turned to come nearest to the heading of `reference`.
[[nodiscard]] int nearest_turn(const objects::Cuboid& cuboid, const objects::Cuboid& reference);

/// Longer horizontal edge over the shorter one.
[[nodiscard]] double elongation(const objects::Cuboid& cuboid);

/// Variances of where the low and the high end along a horizontal axis are, m².
/// \param covariance of [rotation, translation, size] in the cuboid's own frame
[[nodiscard]] Eigen::Vector2d end_variances(const Eigen::Ref<const Eigen::MatrixXd>& covariance,
                                            int axis);

/// Adds what the low and the high end's variances lack of these; the other end and the sides stay.
void raise_end_variances(Eigen::MatrixXd& covariance, int axis, const Eigen::Vector2d& variances);

/// Whether p, moved along z, lies on the cuboid's bottom.
[[nodiscard]] bool on_footprint(const objects::Cuboid& cuboid, const Eigen::Vector3d& p);

/// Area that two bottoms, moved along z, have in common, as a share of the smaller one: 0 to 1.
[[nodiscard]] double footprint_overlap(const objects::Cuboid& a, const objects::Cuboid& b);

[[nodiscard]] bool is_cuboid(const Model& model);

/// Finite, of positive size, with a covariance of the right form that is positive definite.
[[nodiscard]] bool valid(const Gaussian& measured);

}  // namespace saker::slam
