#include "active/faces.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace saker::active {

Covariance by_faces(const Covariance& covariance, double whole, const Eigen::Vector2d& eye,
                    const Eigen::Vector2d& size, const FacesConfig& config) {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const double outside = sign * eye[axis] - 0.5 * size[axis];
      const double looked_at = std::clamp(outside / config.outside_m, 0.0, 1.0);
      const double hidden = config.hidden_m * (1 - looked_at);
      const double windows = looked_at + (1 - looked_at) * whole;
      Eigen::Vector4d face = Eigen::Vector4d::Zero();
      face[axis] = sign;
      face[2 + axis] = 0.5;
      const double variance = face.dot(covariance * face) / windows + hidden * hidden;
      information += face * face.transpose() / variance;
    }
  }
  return Covariance(information.inverse());
}

}  // namespace saker::active
