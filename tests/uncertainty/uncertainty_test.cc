#include "saker/uncertainty/uncertainty.h"

#include <gtest/gtest.h>

namespace saker::uncertainty {
namespace {

constexpr objects::ClassId kVehicle = 1;

/// One interval of range, all around; the same everywhere.
Model model_of(const Eigen::Vector4d& bias, double sd) {
  GeometricModel::Parts parts;
  parts.intervals = {{2, 20}, 2};
  GeometricModel::Interval interval;
  interval.bias = bias;
  interval.covariance = sd * sd * Eigen::Matrix4d::Identity();
  interval.covariate_mean.resize(0);
  interval.objects = 10;
  parts.fitted.assign(static_cast<std::size_t>(parts.intervals.size()), interval);
  parts.common = 1e-8 * Eigen::Matrix4d::Identity();
  ClassModel model;
  model.id = kVehicle;
  model.geometric = GeometricModel(parts);
  return Model({model});
}

const View kView{8, 1, NAN, NAN};

TEST(ModelTest, AboutTheTruthABiasIsPartOfTheError) {
  const Eigen::Vector4d bias(0.1, 0, -0.5, 0.05);
  const Prediction about = model_of(bias, 0.2).about_truth().predict(kVehicle, kView);
  const Eigen::Matrix4d second_moment =
      0.04 * Eigen::Matrix4d::Identity() + bias * bias.transpose();
  EXPECT_TRUE(about.covariance.isApprox(second_moment, 1e-9)) << about.covariance;
  EXPECT_TRUE(about.bias.isZero());
}

TEST(ModelTest, WithoutABiasBothSayTheSame) {
  const Model model = model_of(Eigen::Vector4d::Zero(), 0.2);
  EXPECT_TRUE(model.about_truth()
                  .predict(kVehicle, kView)
                  .covariance.isApprox(model.predict(kVehicle, kView).covariance, 1e-12));
}

}  // namespace
}  // namespace saker::uncertainty
