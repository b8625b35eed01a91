#include "saker/active/belief/faces.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace saker::active {
namespace {

/// sd of faces across that axis that the eye does not see.
double hidden_sd(int axis, const Eigen::Vector2d& eye, const FacesConfig& config) {
  if (axis == 0) return config.hidden_end_m;
  if (eye.squaredNorm() <= 0) return config.hidden_side_m;
  return config.hidden_side_m * eye.y() * eye.y() / eye.squaredNorm();  // sin² of the bearing
}

}  // namespace

Measured by_faces(const Covariance& covariance, double complete_share, const Eigen::Vector2d& eye,
                  const Eigen::Vector2d& size, const FacesConfig& config) {
  Measured measured;
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const double outside = sign * eye[axis] - 0.5 * size[axis];
      const double visible = std::clamp(outside / config.outside_m, 0.0, 1.0);
      const double windows = visible + (1 - visible) * complete_share;
      Eigen::Vector4d face = Eigen::Vector4d::Zero();
      face[axis] = sign;
      face[2 + axis] = 0.5;
      information += windows / face.dot(covariance * face) * face * face.transpose();
      measured.hidden[2 * axis + (sign > 0 ? 0 : 1)] = hidden_sd(axis, eye, config) * (1 - visible);
    }
  }
  measured.covariance = information.inverse();
  return measured;
}

}  // namespace saker::active
