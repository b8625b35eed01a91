#include "saker/objects/models.h"

namespace saker::objects {

Cuboid transformed(const SE3& T_b_a, const Cuboid& in_a) { return {T_b_a * in_a.pose, in_a.size}; }

Cylinder transformed(const SE3& T_b_a, const Cylinder& in_a) {
  Cylinder in_b = in_a;
  in_b.root = T_b_a * in_a.root;
  in_b.axis = T_b_a.linear() * in_a.axis;
  return in_b;
}

GroundPlane transformed(const SE3& T_b_a, const GroundPlane& in_a) {
  return {T_b_a.linear() * in_a.normal, T_b_a * in_a.point, in_a.radius};
}

Model transformed(const SE3& T_b_a, const Model& in_a) {
  return std::visit([&](const auto& model) -> Model { return transformed(T_b_a, model); }, in_a);
}

Eigen::Vector3d place(const Model& model) {
  if (const auto* cuboid = std::get_if<Cuboid>(&model)) return cuboid->pose.translation();
  return std::get<Cylinder>(model).root;
}

// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017: no singularity; the only step
// is at the horizon, where no axis of a trunk or pole lies.
Eigen::Matrix<double, 3, 2> tangent_basis(const Eigen::Vector3d& axis) {
  const double sign = std::copysign(1.0, axis.z());
  const double a = -1 / (sign + axis.z());
  const double b = axis.x() * axis.y() * a;
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) << 1 + sign * axis.x() * axis.x() * a, sign * b, -sign * axis.x();
  basis.col(1) << b, sign + axis.y() * axis.y() * a, -axis.y();
  return basis;
}

}  // namespace saker::objects
