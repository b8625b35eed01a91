#include "active/view_model.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saker::active {
namespace {

const objects::ClassTable kTable;
const objects::ClassId kVehicle = kTable.find("vehicle");

/// The same errors from everywhere; `whole` of the measurements show the vehicle from end to end.
std::shared_ptr<const uncertainty::Model> model_of(double whole) {
  uncertainty::GeometricModel::Parts parts;
  parts.intervals = {{2, 8, 14}, 6};
  const Eigen::MatrixXd covariance = 0.01 * Eigen::Matrix4d::Identity();
  for (int i = 0; i < parts.intervals.size(); ++i) {
    parts.fitted.push_back({Eigen::Vector4d::Zero(), covariance, Eigen::VectorXd(), whole, 10});
  }
  parts.common = covariance;
  uncertainty::ClassModel model;
  model.id = kVehicle;
  model.semantic.mean = 0.95;
  model.geometric = uncertainty::GeometricModel(parts);
  return std::make_shared<const uncertainty::Model>(std::vector{model});
}

TEST(ViewModel, AViewThatShowsAVehicleEveryFourthTimeTellsAQuarter) {
  const uncertainty::View view{6, 1, NAN, NAN};
  const ViewModel always = view_model_of(model_of(1), {}, kTable);
  const ViewModel seldom = view_model_of(model_of(0.25), {}, kTable);
  EXPECT_TRUE(seldom.predict(kVehicle, view)
                  .covariance.isApprox(4 * always.predict(kVehicle, view).covariance, 1e-9));
}

TEST(ViewModel, ATargetClassThatTheModelDoesNotKnowIsRefused) {
  EXPECT_ANY_THROW((void)view_model_of(std::make_shared<const uncertainty::Model>(), {}, kTable));
}

}  // namespace
}  // namespace saker::active
