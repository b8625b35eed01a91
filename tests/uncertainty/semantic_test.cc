#include "saker/uncertainty/semantic.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saker::uncertainty {
namespace {

/// The logistic function of weights over the features.
SemanticModel logistic(const Eigen::VectorXd& weights) {
  SemanticModel model;
  model.mean = 0.7;
  model.perceptron = Perceptron({{weights.transpose(), Eigen::VectorXd::Zero(1)}});
  return model;
}

TEST(SemanticModelTest, WithoutAPerceptronIsTheMean) {
  SemanticModel model;
  model.mean = 0.83;
  for (const double range : {1.0, 10.0, 100.0}) {
    EXPECT_EQ(model.confidence({range, 2, 0.1, NAN}), 0.83);
  }
}

TEST(SemanticModelTest, WithOneIsWhatItMakesOfTheFeatures) {
  const SemanticModel model = logistic(Eigen::Vector3d(-1, 2, 0.5));
  const View view{15, 0.6, NAN, NAN};
  const double sum = -1 * 0.5 + 2 * std::sin(0.6) + 0.5 * std::cos(0.6);
  EXPECT_NEAR(model.confidence(view), 1 / (1 + std::exp(-sum)), 1e-12);
}

TEST(SemanticModelTest, IsTheSameFromTheLeftAndFromTheRight) {
  const SemanticModel model = logistic(Eigen::Vector3d(-1, 2, 0.5));
  for (double angle = 0.1; angle < 3.1; angle += 0.3) {
    EXPECT_EQ(model.confidence({8, angle, NAN, NAN}), model.confidence({8, -angle, NAN, NAN}));
  }
}

TEST(SemanticModelTest, HasNoJumpWhereTheAngleWraps) {
  const SemanticModel model = logistic(Eigen::Vector3d(-1, 2, 0.5));
  const double behind = std::numbers::pi - 1e-9;
  EXPECT_NEAR(model.confidence({8, behind, NAN, NAN}), model.confidence({8, -behind, NAN, NAN}),
              1e-8);
}

TEST(SemanticModelTest, FeaturesAreOfAboutOne) {
  for (const double range : {2.0, 10.0, 25.0}) {
    for (const double angle : {-3.0, 0.0, 1.5}) {
      const Eigen::VectorXd features = SemanticModel().features({range, angle, NAN, NAN});
      EXPECT_LE(features.cwiseAbs().maxCoeff(), 2);
      EXPECT_NEAR(features.segment<2>(1).norm(), 1, 1e-12) << "sine and cosine";
    }
  }
}

TEST(SemanticModelTest, FurtherInputsFollowStandardised) {
  SemanticModel model;
  model.inputs = {{Covariate::reflectivity, 40, 10}, {Covariate::elevation, 0.2, 0.1}};
  const Eigen::VectorXd features = model.features({10, 0, 0.1, 55});
  ASSERT_EQ(features.size(), 5);
  EXPECT_NEAR(features[3], 1.5, 1e-12);
  EXPECT_NEAR(features[4], -1, 1e-12);
  EXPECT_EQ(model.features({10, 0, 0.1, NAN})[3], 0) << "unknown";
}

}  // namespace
}  // namespace saker::uncertainty
