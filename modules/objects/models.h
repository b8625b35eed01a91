#pragma once

#include <cmath>
#include <variant>

#include "saker/core/se3.h"

namespace saker::objects {

/// Origin at its centre, x to its front, z along the local ground's normal, its bottom on the
/// ground.
struct Cuboid {
  SE3 pose = SE3::Identity();                             ///< T_frame_cuboid
  Eigen::Vector3d size = Eigen::Vector3d::Constant(NAN);  ///< length (x), width (y), height (z), m
};

/// A trunk or a pole from the local ground up.
struct Cylinder {
  Eigen::Vector3d root = Eigen::Vector3d::Constant(NAN);  ///< axis ∩ local ground, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();        ///< unit, up
  double radius = NAN;                                    ///< m
  double height = NAN;                                    ///< m, of the part that was seen
};

/// The local ground near `point`.
struct GroundPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();       ///< unit, up
  Eigen::Vector3d point = Eigen::Vector3d::Constant(NAN);  ///< m
  double radius = NAN;                                     ///< m, where it holds

  /// Height of p above the plane along its normal, m.
  [[nodiscard]] double height_of(const Eigen::Vector3d& p) const { return normal.dot(p - point); }
};

using Model = std::variant<Cuboid, Cylinder>;

[[nodiscard]] Cuboid transformed(const SE3& T_b_a, const Cuboid& in_a);
[[nodiscard]] Cylinder transformed(const SE3& T_b_a, const Cylinder& in_a);
[[nodiscard]] GroundPlane transformed(const SE3& T_b_a, const GroundPlane& in_a);
[[nodiscard]] Model transformed(const SE3& T_b_a, const Model& in_a);

/// What data association compares: a cuboid's centre, a cylinder's root.
[[nodiscard]] Eigen::Vector3d place(const Model& model);

/// Two orthonormal vectors normal to `axis`, a smooth function of it near the vertical: the tangent
/// plane in which the two components of an axis error are expressed.
[[nodiscard]] Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& axis);

}  // namespace saker::objects
