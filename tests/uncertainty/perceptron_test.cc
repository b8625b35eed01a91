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

}  // namespace
}  // namespace saker::uncertainty
