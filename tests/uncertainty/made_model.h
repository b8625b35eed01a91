#pragma once

#include <functional>
#include <numbers>

#include "saker/uncertainty/uncertainty.h"

/// Models of which it is known what they say.
namespace saker::uncertainty {

constexpr objects::ClassId kMadeClass = 1;  ///< a cuboid

[[nodiscard]] inline GeometricModel::Interval made_interval(const Eigen::VectorXd& bias,
                                                            const Eigen::MatrixXd& covariance) {
  GeometricModel::Interval interval;
  interval.bias = bias;
  interval.covariance = covariance;
  interval.covariate_mean.resize(0);
  interval.objects = 10;
  return interval;
}

/// One interval a range and sector, as a function of its centre says.
[[nodiscard]] inline GeometricModel::Parts made_parts(
    const Intervals& intervals,
    const std::function<GeometricModel::Interval(double range, double angle)>& of) {
  GeometricModel::Parts parts;
  parts.intervals = intervals;
  for (int range = 0; range < intervals.ranges(); ++range) {
    for (int sector = 0; sector < intervals.sectors; ++sector) {
      parts.fitted.push_back(of(intervals.range_centre(range), intervals.sector_centre(sector)));
    }
  }
  const Eigen::Index n = parts.fitted.front().bias.size();
  parts.common = 1e-8 * Eigen::MatrixXd::Identity(n, n);
  return parts;
}

/// The same wherever a cuboid is seen from, within 2 to 20 m.
[[nodiscard]] inline GeometricModel::Parts even_parts(const Eigen::Vector4d& bias,
                                                      const Eigen::Matrix4d& covariance) {
  return made_parts({{2, 20}, 2}, [&](double, double) { return made_interval(bias, covariance); });
}

[[nodiscard]] inline Model made_model(const GeometricModel::Parts& parts, double confidence = NAN) {
  ClassModel model;
  model.id = kMadeClass;
  model.geometric = GeometricModel(parts);
  model.semantic.mean = confidence;
  return Model({model});
}

}  // namespace saker::uncertainty
