#include "saker/uncertainty/view.h"

#include <cmath>
#include <numbers>

namespace saker::uncertainty {
namespace {

/// Centre of a cuboid; half-way up a cylinder, its root where the height is unknown.
Eigen::Vector3d middle(const objects::Model& model) {
  const auto* cylinder = std::get_if<objects::Cylinder>(&model);
  if (cylinder == nullptr || !std::isfinite(cylinder->height)) return objects::place(model);
  return cylinder->root + 0.5 * cylinder->height * cylinder->axis;
}

/// Into (−π, π].
double wrapped(double angle) {
  const double turns = std::ceil((angle - std::numbers::pi) / (2 * std::numbers::pi));
  return angle - 2 * std::numbers::pi * turns;
}

}  // namespace

View view_of(const Eigen::Vector3d& eye, const objects::Model& model) {
  const Eigen::Vector3d to_eye = eye - objects::place(model);
  View view;
  view.range = to_eye.head<2>().norm();
  view.angle = 0;
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    view.angle = wrapped(std::atan2(to_eye.y(), to_eye.x()) - core::yaw(cuboid->pose.linear()));
  }
  view.elevation = std::atan2(eye.z() - middle(model).z(), view.range);
  return view;
}

}  // namespace saker::uncertainty
