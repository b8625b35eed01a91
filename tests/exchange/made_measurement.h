#pragma once

#include <cmath>
#include <vector>

#include "saker/core/rng.h"
#include "saker/objects/measurement.h"

/// Measurements and covariances as they may come.
namespace saker::exchange {

constexpr int kClasses = 5;

inline Eigen::Vector3d some_vector(core::Rng& rng, double size) {
  return {rng.uniform(-size, size), rng.uniform(-size, size), rng.uniform(-size, size)};
}

inline Eigen::MatrixXd some_covariance(core::Rng& rng, int rows) {
  Eigen::MatrixXd A(rows, rows);
  for (double& a : A.reshaped()) a = rng.normal();
  const Eigen::MatrixXd mixed = A * A.transpose() + Eigen::MatrixXd::Identity(rows, rows);
  Eigen::VectorXd sd(rows);
  for (double& s : sd) s = std::exp2(rng.uniform(-8, 0));
  const Eigen::VectorXd unit = mixed.diagonal().cwiseSqrt().cwiseInverse().cwiseProduct(sd);
  return unit.asDiagonal() * mixed * unit.asDiagonal();
}

inline std::vector<double> some_probabilities(core::Rng& rng, objects::ClassId likely) {
  std::vector<double> p(kClasses, 0.0);
  p[likely] = rng.uniform(0.6, 1);
  p[0] += 1 - p[likely];
  return p;
}

inline objects::Measurement some_measurement(core::Rng& rng, Time stamp, bool cuboid) {
  objects::Measurement m;
  m.stamp = stamp;
  m.class_id = cuboid ? 1 : 2;
  m.class_probability = some_probabilities(rng, m.class_id);
  m.points = rng.index(3000);
  if (cuboid) {
    objects::Cuboid model;
    model.pose.linear() = core::so3_exp({0.05, -0.03, rng.uniform(-3, 3)});
    model.pose.translation() = some_vector(rng, 20);
    model.size = {rng.uniform(3, 6), rng.uniform(1.5, 2.5), rng.uniform(1.3, 2)};
    m.model = model;
    m.front_log_odds = rng.uniform(-5, 5);
    m.length_sd = rng.uniform(0.05, 0.5);
    m.covariance = some_covariance(rng, 9);
  } else {
    const Eigen::Vector3d axis(rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2), 1);
    m.model = objects::Cylinder{some_vector(rng, 20), axis.normalized(), rng.uniform(0.05, 0.4),
                                rng.uniform(1, 8)};
    m.reflectivity = rng.uniform();
    m.view_cell = rng.index(500);
    m.covariance = some_covariance(rng, 6);
  }
  return m;
}

}  // namespace saker::exchange
