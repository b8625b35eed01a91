#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "saker/core/se3.h"

/// Eigen ↔ the arrays of messages.
namespace saker::flight {

template <class Scalar, class Derived>
void write_field(const Eigen::MatrixBase<Derived>& value, Scalar* field) {
  for (Eigen::Index i = 0; i < value.size(); ++i) field[i] = static_cast<Scalar>(value(i));
}

template <class Scalar>
[[nodiscard]] Eigen::Vector3d vector_of(const Scalar* field) {
  return {static_cast<double>(field[0]), static_cast<double>(field[1]),
          static_cast<double>(field[2])};
}

template <class Scalar>
void write_rotation(const Eigen::Quaterniond& rotation, Scalar* xyzw) {
  write_field(rotation.coeffs(), xyzw);
}

/// Normalised; nothing where it is no rotation.
template <class Scalar>
[[nodiscard]] std::optional<Eigen::Quaterniond> rotation_of(const Scalar* xyzw) {
  constexpr double kOff = 1e-3;  // of the norm: single precision is a thousand times better
  const Eigen::Quaterniond q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  if (!(std::abs(q.norm() - 1) < kOff)) return std::nullopt;
  return q.normalized();
}

template <class Scalar>
void write_pose(const SE3& T, Scalar* position, Scalar* orientation) {
  write_field(T.translation(), position);
  write_rotation(Eigen::Quaterniond(T.rotation()), orientation);
}

/// Nothing where it is no pose.
template <class Scalar>
[[nodiscard]] std::optional<SE3> pose_of(const Scalar* position, const Scalar* orientation) {
  const auto rotation = rotation_of(orientation);
  const Eigen::Vector3d translation = vector_of(position);
  if (!rotation || !translation.allFinite()) return std::nullopt;
  SE3 T = SE3::Identity();
  T.linear() = rotation->toRotationMatrix();
  T.translation() = translation;
  return T;
}

/// An enumerator with values 0 … last; nothing outside.
template <class Enum>
[[nodiscard]] std::optional<Enum> enumerator_of(int value, Enum last) {
  if (value < 0 || value > static_cast<int>(last)) return std::nullopt;
  return static_cast<Enum>(value);
}

}  // namespace saker::flight
