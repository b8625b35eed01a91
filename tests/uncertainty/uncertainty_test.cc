#include "saker/uncertainty/uncertainty.h"

#include <gtest/gtest.h>

#include "made_model.h"

namespace saker::uncertainty {
namespace {

Model model_of(const Eigen::Vector4d& bias, double sd) {
  return made_model(even_parts(bias, sd * sd * Eigen::Matrix4d::Identity()), 0.9);
}

const View kView{8, 1, NAN, NAN};

TEST(ModelTest, AboutTheTruthABiasIsPartOfTheError) {
  const Eigen::Vector4d bias(0.1, 0, -0.5, 0.05);
  const Prediction about = model_of(bias, 0.2).about_truth().predict(kMadeClass, kView);
  const Eigen::Matrix4d second_moment =
      0.04 * Eigen::Matrix4d::Identity() + bias * bias.transpose();
  EXPECT_TRUE(about.covariance.isApprox(second_moment, 1e-9)) << about.covariance;
  EXPECT_TRUE(about.bias.isZero());
}

TEST(ModelTest, WithoutABiasBothSayTheSame) {
  const Model model = model_of(Eigen::Vector4d::Zero(), 0.2);
  EXPECT_TRUE(model.about_truth()
                  .predict(kMadeClass, kView)
                  .covariance.isApprox(model.predict(kMadeClass, kView).covariance, 1e-12));
}

TEST(ModelTest, AboutTheTruthIsSaidOnceHoweverOftenItIsAskedFor) {
  const Model once = model_of({0.1, 0, -0.5, 0.05}, 0.2).about_truth();
  EXPECT_TRUE(once.about_truth()
                  .predict(kMadeClass, kView)
                  .covariance.isApprox(once.predict(kMadeClass, kView).covariance, 1e-12));
}

TEST(ModelTest, KnowsTheClassesThatItWasMadeOf) {
  const Model model = model_of(Eigen::Vector4d::Zero(), 0.2);
  EXPECT_TRUE(model.knows(kMadeClass));
  EXPECT_FALSE(model.knows(2));
  EXPECT_FALSE(Model().knows(kMadeClass));
  EXPECT_EQ(model.classes().size(), 1u);
}

TEST(ModelTest, CellsOfBothSidesDifferAndTheConfidenceDoesNot) {
  const Model model = model_of(Eigen::Vector4d::Zero(), 0.2);
  const Prediction left = model.predict(kMadeClass, {8, 1, NAN, NAN});
  const Prediction right = model.predict(kMadeClass, {8, -1, NAN, NAN});
  EXPECT_NE(left.cell, right.cell);
  EXPECT_EQ(left.confidence, 0.9);
  EXPECT_EQ(right.confidence, 0.9);
}

TEST(ModelTest, CommonCovarianceIsThatOfItsParts) {
  GeometricModel::Parts parts = even_parts(Eigen::Vector4d::Zero(), Eigen::Matrix4d::Identity());
  parts.common = Eigen::Vector4d(1, 2, 3, 4).asDiagonal();
  EXPECT_EQ(made_model(parts).common_covariance(kMadeClass), parts.common);
}

}  // namespace
}  // namespace saker::uncertainty
