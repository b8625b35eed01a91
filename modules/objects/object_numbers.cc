#include "saker/objects/object_numbers.h"

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"
#include "saker/objects/measurement.h"

namespace saker::objects {

CuboidNumbers numbers(const Cuboid& cuboid) {
  Eigen::Quaterniond q(cuboid.pose.linear());
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return (CuboidNumbers() << cuboid.pose.translation(), q.coeffs(), cuboid.size).finished();
}

CylinderNumbers numbers(const Cylinder& cylinder) {
  return (CylinderNumbers() << cylinder.root, cylinder.axis, cylinder.radius, cylinder.height)
      .finished();
}

Cuboid cuboid_of(const CuboidNumbers& numbers) {
  Cuboid cuboid;
  const Eigen::Vector4d q = numbers.segment<4>(3).normalized();
  cuboid.pose.linear() = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
  cuboid.pose.translation() = numbers.head<3>();
  cuboid.size = numbers.tail<3>();
  return cuboid;
}

Cylinder cylinder_of(const CylinderNumbers& numbers) {
  return {numbers.head<3>(), numbers.segment<3>(3).normalized(), numbers[6], numbers[7]};
}

double rounded(double value) {
  if (!std::isfinite(value)) throw Error("object map: a number is not finite");
  return std::round(value * 1e6) / 1e6 + 0.0;  // + 0.0: no negative zero
}

bool has_covariance(const MapObject& object) {
  return object.covariance.size() > 0 && object.covariance.allFinite();
}

CovarianceNumbers covariance_numbers(const MapObject& object) {
  const Eigen::MatrixXd& P = object.covariance;
  CovarianceNumbers values(deviations(object.model) + correlations(object.model));
  values.head(P.rows()) = P.diagonal().cwiseMax(0).cwiseSqrt();
  const std::vector<int> rows = planar_rows(object.model);
  Eigen::Index next = P.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      const double scale = std::sqrt(P(rows[i], rows[i]) * P(rows[j], rows[j]));
      values[next++] = scale > 0 ? std::clamp(P(rows[i], rows[j]) / scale, -1.0, 1.0) : 0;
    }
  }
  return values;
}

Eigen::MatrixXd covariance_of(const Model& model, const CovarianceNumbers& numbers) {
  Eigen::Index next = deviations(model);
  Eigen::MatrixXd covariance = numbers.head(next).cwiseAbs2().asDiagonal();
  const std::vector<int> rows = planar_rows(model);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      const double sd_sd = std::sqrt(covariance(rows[i], rows[i]) * covariance(rows[j], rows[j]));
      covariance(rows[i], rows[j]) = numbers[next++] * sd_sd;
      covariance(rows[j], rows[i]) = covariance(rows[i], rows[j]);
    }
  }
  return covariance;
}

double probability_of(const MapObject& object) {
  if (object.class_id >= object.class_probability.size()) return 1;
  return object.class_probability[object.class_id];
}

std::vector<double> spread(double probability, ClassId id, const ClassTable& table) {
  const auto count = static_cast<std::size_t>(table.size());
  std::vector<double> all(
      count, (1 - probability) / static_cast<double>(std::max<std::size_t>(count - 1, 1)));
  all[id] = probability;
  return all;
}

}  // namespace saker::objects
