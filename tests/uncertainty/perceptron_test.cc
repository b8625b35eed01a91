#include "saker/uncertainty/perceptron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace saker::uncertainty {
namespace {

double surface(double x, double y) {
  return 1 / (1 + std::exp(-(1.5 + 2 * std::sin(2 * x) * y - x)));
}

struct Data {
  Eigen::MatrixXd inputs;
  Eigen::VectorXd targets;
};

Data made(int count, std::uint64_t seed, double noise) {
  core::Rng rng(seed);
  Data data{Eigen::MatrixXd(2, count), Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    data.inputs.col(i) << rng.uniform(-1, 1), rng.uniform(-1, 1);
    const double value = surface(data.inputs(0, i), data.inputs(1, i)) + rng.normal(0, noise);
    data.targets[i] = std::clamp(value, 0.0, 1.0);
  }
  return data;
}

TEST(PerceptronTest, RecoversAKnownSurfaceFromNoisyTargets) {
  const Data data = made(2000, 1, 0.05);
  const Perceptron perceptron =
      trained(PerceptronConfig(), data.inputs, data.targets, core::Rng(3));
  const Data unseen = made(500, 2, 0);
  double squares = 0;
  for (int i = 0; i < 500; ++i) {
    squares += std::pow(perceptron(unseen.inputs.col(i)) - unseen.targets[i], 2);
  }
  EXPECT_LT(std::sqrt(squares / 500), 0.02);
}

TEST(PerceptronTest, TheSameSeedGivesTheSameWeights) {
  const Data data = made(200, 1, 0.05);
  PerceptronConfig config;
  config.epochs = 3;
  const auto first = trained(config, data.inputs, data.targets, core::Rng(3));
  const auto second = trained(config, data.inputs, data.targets, core::Rng(3));
  const auto other = trained(config, data.inputs, data.targets, core::Rng(4));
  const Eigen::Vector2d at(0.3, -0.2);
  EXPECT_EQ(first(at), second(at));
  EXPECT_NE(first(at), other(at));
}

TEST(PerceptronTest, ASingleLayerIsTheLogisticFunction) {
  const Perceptron perceptron({{Eigen::RowVector2d(2, -1), Eigen::VectorXd::Constant(1, 0.5)}});
  EXPECT_NEAR(perceptron(Eigen::Vector2d(1, 3)), 1 / (1 + std::exp(0.5)), 1e-12);
}

TEST(PerceptronTest, OfNoLayersSaysNothing) {
  EXPECT_TRUE(Perceptron().empty());
  EXPECT_TRUE(std::isnan(Perceptron()(Eigen::Vector2d(1, 2))));
}

TEST(PerceptronTest, AHiddenLayerBendsByTheHyperbolicTangent) {
  const Perceptron perceptron(
      {{Eigen::RowVector2d(1, 2), Eigen::VectorXd::Constant(1, -0.5)},
       {Eigen::MatrixXd::Constant(1, 1, 3), Eigen::VectorXd::Constant(1, 0.2)}});
  const double hidden = std::tanh(0.4 + 2 * 0.3 - 0.5);
  EXPECT_NEAR(perceptron(Eigen::Vector2d(0.4, 0.3)), 1 / (1 + std::exp(-(3 * hidden + 0.2))),
              1e-12);
}

TEST(PerceptronTest, HasTheLayersThatItsConfigurationAsksFor) {
  PerceptronConfig config;
  config.hidden_layers = 3;
  config.hidden_units = 5;
  config.epochs = 1;
  const Data data = made(50, 1, 0.05);
  const auto layers = trained(config, data.inputs, data.targets, core::Rng(1)).layers();
  ASSERT_EQ(layers.size(), 4u);
  EXPECT_EQ(layers[0].weights.rows(), 5);
  EXPECT_EQ(layers[0].weights.cols(), 2);
  EXPECT_EQ(layers[3].weights.rows(), 1);
  EXPECT_EQ(layers[3].offsets.size(), 1);
}

TEST(PerceptronTest, OfOneTargetSaysIt) {
  Data data = made(300, 1, 0);
  data.targets.setConstant(0.85);
  const Perceptron perceptron = trained({}, data.inputs, data.targets, core::Rng(1));
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(perceptron(data.inputs.col(i)), 0.85, 0.03);
}

TEST(PerceptronTest, StaysBetweenZeroAndOneFarFromItsData) {
  const Data data = made(300, 1, 0.05);
  const Perceptron perceptron = trained({}, data.inputs, data.targets, core::Rng(1));
  for (const double far : {-1e6, -10.0, 10.0, 1e6}) {
    const double value = perceptron(Eigen::Vector2d(far, -far));
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

TEST(PerceptronTest, StrongDecayPullsTheWeightsToZero) {
  const Data data = made(300, 1, 0.05);
  const auto norm = [&](double decay) {
    PerceptronConfig config;
    config.weight_decay = decay;
    config.epochs = 10;
    return trained(config, data.inputs, data.targets, core::Rng(1)).layers()[1].weights.norm();
  };
  EXPECT_LT(norm(1), 0.9 * norm(0));
}

}  // namespace
}  // namespace saker::uncertainty
