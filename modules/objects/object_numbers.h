#pragma once

#include <vector>

#include "saker/objects/object_map.h"

/// The numbers by which files name an object, and the object that they make.
namespace saker::objects {

inline constexpr double kFarthest_m = 1e9;        ///< what lies farther out is a wrong unit
inline constexpr double kLargestObject_m = 1000;  ///< what is larger is a wrong unit

inline constexpr int kCuboidNumbers = 10, kCylinderNumbers = 8;
using CuboidNumbers = Eigen::Matrix<double, kCuboidNumbers, 1>;
using CylinderNumbers = Eigen::Matrix<double, kCylinderNumbers, 1>;

[[nodiscard]] CuboidNumbers numbers(const Cuboid& cuboid);  ///< position, [qx, qy, qz, qw], size
[[nodiscard]] CylinderNumbers numbers(const Cylinder& cylinder);     ///< root, axis, radius, height
[[nodiscard]] Cuboid cuboid_of(const CuboidNumbers& numbers);        ///< normalises the rotation
[[nodiscard]] Cylinder cylinder_of(const CylinderNumbers& numbers);  ///< normalises the axis

/// Six decimals: a micrometre, and the same value in every form of a file. Throws Error for what is
/// not finite.
[[nodiscard]] double rounded(double value);

[[nodiscard]] bool has_covariance(const MapObject& object);

/// Standard deviations of every row of a covariance, then the correlations of its planar part
/// (planar_rows): the upper triangle, row by row. 9 and 6 of a cuboid, 6 and 1 of a cylinder.
using CovarianceNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 15, 1>;
[[nodiscard]] constexpr int deviations(const Model& model) {
  return std::holds_alternative<Cuboid>(model) ? 9 : 6;
}
[[nodiscard]] constexpr int correlations(const Model& model) {
  return std::holds_alternative<Cuboid>(model) ? 6 : 1;
}
[[nodiscard]] CovarianceNumbers covariance_numbers(const MapObject& object);
[[nodiscard]] Eigen::MatrixXd covariance_of(const Model& model, const CovarianceNumbers& numbers);

[[nodiscard]] double probability_of(const MapObject& object);  ///< of its own class
/// What a file does not say is spread evenly over the other classes.
[[nodiscard]] std::vector<double> spread(double probability, ClassId id, const ClassTable& table);

}  // namespace saker::objects
