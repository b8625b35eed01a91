#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "saker/uncertainty/uncertainty.h"

/// A fitted model of vehicles and trunks with made numbers, for tests.
namespace saker::autonomy::made {

constexpr objects::ClassId kVehicle = 1, kTrunk = 2, kPole = 3;

inline uncertainty::GeometricModel::Parts errors(int sectors, const Eigen::VectorXd& bias,
                                                 const Eigen::VectorXd& sd,
                                                 const Eigen::VectorXd& common_sd) {
  uncertainty::GeometricModel::Parts parts;
  parts.intervals = {{2, 7, 12}, sectors};
  for (int i = 0; i < parts.intervals.size(); ++i) {
    const double worse = 1 + 0.02 * i;  // no two intervals alike
    parts.fitted.push_back(
        {worse * bias, (worse * sd).cwiseAbs2().asDiagonal(), Eigen::VectorXd(), 1, 50});
  }
  parts.whole_length_sd_m = 0.3;
  parts.common = common_sd.cwiseAbs2().asDiagonal();
  return parts;
}

inline uncertainty::ClassModel class_model(objects::ClassId id,
                                           uncertainty::GeometricModel::Parts parts) {
  uncertainty::ClassModel model;
  model.id = id;
  model.semantic.mean = 0.9;
  model.geometric = uncertainty::GeometricModel(std::move(parts));
  return model;
}

/// Flown from 2 to 12 m; knows no poles.
inline std::shared_ptr<const uncertainty::Model> model() {
  const Eigen::Vector4d bias(0.12, -0.05, -0.25, 0.06), sd(0.15, 0.06, 0.25, 0.1),
      common(0.05, 0.03, 0.12, 0.05);
  return std::make_shared<const uncertainty::Model>(std::vector{
      class_model(kVehicle, errors(6, bias, sd, common)),
      class_model(kTrunk, errors(1, Eigen::Vector2d(0.08, 0.02), Eigen::Vector2d(0.06, 0.03),
                                 Eigen::Vector2d(0.03, 0.01)))});
}

}  // namespace saker::autonomy::made
