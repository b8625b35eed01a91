#include "saker/uncertainty/fit.h"

#include <gtest/gtest.h>

#include <map>

#include "made_samples.h"
#include "saker/core/error.h"
#include "saker/uncertainty/evaluation.h"

namespace saker::uncertainty {
namespace {

const objects::ClassTable kTable;
const objects::ClassId kVehicle = kTable.find("vehicle");
const objects::ClassId kPole = kTable.find("pole");
const std::vector<double> kEdges = {2, 5, 8, 12, 18};

/// Small enough for a test.
FitConfig small_config() {
  FitConfig config;
  config.range_edges_m = kEdges;
  config.folds = 2;
  config.cuboid_bias = true;  // the made law has one
  config.confidence.epochs = 15;
  return config;
}

ClassModel fitted(const std::vector<Sample>& samples, const FitConfig& config = small_config()) {
  return fit(samples, kTable, config, 1).front();
}

GeometricModel geometric(const std::vector<Sample>& samples) {
  std::vector<Trial> trials;
  return fit_geometric(samples, {kEdges, 6}, small_config(), trials);
}

/// Poles whose confidence does not depend on the range; errors along the sight are the larger ones.
std::vector<Sample> made_poles(int count, std::uint64_t seed) {
  core::Rng rng(seed);
  std::vector<Sample> samples;
  for (int i = 0; i < count * 4; ++i) {
    const auto range = static_cast<std::size_t>(i % 4);
    const double centre = 0.5 * (kEdges[range] + kEdges[range + 1]);
    Sample sample;
    sample.recording = "pole_" + std::to_string(seed) + "_" + std::to_string(i / 4);
    sample.class_id = kPole;
    sample.view = {centre + rng.uniform(-1, 1), 0, 0.1, NAN};
    sample.confidence = std::clamp(rng.normal(0.9, 0.05), 0.0, 1.0);
    sample.error = Eigen::Vector2d(rng.normal(0.02, 0.05), rng.normal(0, 0.02));
    samples.push_back(sample);
  }
  return samples;
}

const Trial* trial_of(const ClassModel& model, const std::string& what) {
  for (const Trial& trial : model.trials) {
    if (trial.what == what) return &trial;
  }
  return nullptr;
}

TEST(FitTest, RecoversTheBiasFromBothSides) {
  const MadeLaw law;
  const GeometricModel model = geometric(made_samples(law, kEdges, 150, 1));
  for (const double angle : {-2.6, -1.3, 0.26, 1.3, 2.9}) {
    const View view{6.5, angle, NAN, NAN};
    EXPECT_LT((model.expected(view).bias - law.bias(view)).cwiseAbs().maxCoeff(), 0.025) << angle;
  }
}

TEST(FitTest, RecoversTheCovarianceFromBothSides) {
  const MadeLaw law;
  const GeometricModel model = geometric(made_samples(law, kEdges, 150, 1));
  for (const double angle : {-2.88, 0.26}) {
    const View view{10, angle, NAN, NAN};
    const Eigen::MatrixXd found = model.expected(view).covariance;
    const Eigen::MatrixXd expected = law.covariance(view);
    EXPECT_LT((found - expected).norm(), 0.3 * expected.norm()) << angle;
    EXPECT_GT(found(0, 2) * expected(0, 2), 0) << "sign of what place and length share";
  }
}

TEST(FitTest, RecoversWhatAllMeasurementsOfAnObjectShare) {
  const MadeLaw law;
  const Eigen::MatrixXd common = geometric(made_samples(law, kEdges, 150, 2)).parts().common;
  EXPECT_NEAR(std::sqrt(common(2, 2)), law.common_sd, 0.015);
  EXPECT_NEAR(std::sqrt(common(0, 0)), 0.02, 0.008);
}

TEST(FitTest, ManyWindowsFromOneCellAreOneDraw) {
  const MadeLaw law;
  const auto once = geometric(made_samples(law, kEdges, 150, 3, 1));
  const auto often = geometric(made_samples(law, kEdges, 150, 3, 5));
  const View view{10, 1.3, NAN, NAN};
  const double one = once.expected(view).covariance(2, 2);
  const double five = often.expected(view).covariance(2, 2);
  EXPECT_NEAR(five / one, 1, 0.3);
}

TEST(FitTest, IsHonestAboutSamplesItHasNotSeen) {
  const MadeLaw law;
  const Model model(fit(made_samples(law, kEdges, 150, 4), kTable, small_config(), 1));
  const Evaluation unseen = evaluate(model, kVehicle, made_samples(law, kEdges, 300, 5));
  EXPECT_EQ(unseen.objects, 300);
  EXPECT_GT(unseen.nees, 0.9);
  EXPECT_LT(unseen.nees, 1.1);
  EXPECT_GT(unseen.fused_nees, 0.85);
  EXPECT_LT(unseen.fused_nees, 1.15);
}

/// From ahead every second window misses the far end, and says so.
std::vector<Sample> with_hidden_ends(std::vector<Sample> samples) {
  bool hidden = false;
  for (Sample& sample : samples) {
    sample.length_sd = 0.1;
    if (std::abs(sample.view.angle) > 0.5) continue;
    hidden = !hidden;
    if (!hidden) continue;
    sample.length_sd = 1;
    sample.error[2] -= 0.8;
  }
  return samples;
}

TEST(FitTest, CuboidsHaveNoBiasUnlessItIsAskedForAndAreHonestAboutTheTruth) {
  FitConfig config = small_config();
  config.cuboid_bias = FitConfig().cuboid_bias;
  const Model model(fit(made_samples(MadeLaw(), kEdges, 150, 4), kTable, config, 1));
  EXPECT_TRUE(model.predict(kVehicle, {6.5, 1.3, 0.3, NAN}).bias.isZero());
  const Evaluation unseen = evaluate(model, kVehicle, made_samples(MadeLaw(), kEdges, 300, 5));
  EXPECT_GT(unseen.nees, 0.9);
  EXPECT_LT(unseen.nees, 1.1);
}

TEST(FitTest, CylindersKeepTheirBias) {
  FitConfig config = small_config();
  config.cuboid_bias = false;
  EXPECT_NEAR(fitted(made_poles(100, 2), config).geometric.expected({6.5, 0, NAN, NAN}).bias[0],
              0.02, 0.01);
}

TEST(FitTest, WindowsThatDoNotShowBothEndsMoveNoBiasOrCovariance) {
  const MadeLaw law;
  const View ahead{6.5, 0.26, NAN, NAN};
  const GeometricModel model = geometric(with_hidden_ends(made_samples(law, kEdges, 150, 1, 4)));
  EXPECT_LT((model.expected(ahead).bias - law.bias(ahead)).cwiseAbs().maxCoeff(), 0.025);
  const Eigen::MatrixXd expected = law.covariance(ahead);
  EXPECT_LT((model.expected(ahead).covariance - expected).norm(), 0.3 * expected.norm());
}

TEST(FitTest, TheShareOfWholeWindowsIsKnownByWhereTheyAreSeenFrom) {
  const GeometricModel model =
      geometric(with_hidden_ends(made_samples(MadeLaw(), kEdges, 60, 1, 4)));
  EXPECT_NEAR(model.expected({6.5, 0.26, NAN, NAN}).whole, 0.5, 0.05);
  EXPECT_NEAR(model.expected({6.5, -0.26, NAN, NAN}).whole, 0.5, 0.05);
  EXPECT_NEAR(model.expected({6.5, 2.3, NAN, NAN}).whole, 1, 0.05);
}

TEST(FitTest, ConfidenceFollowsRangeAndAngleWhereTheDataDo) {
  const MadeLaw law;
  const ClassModel model = fitted(made_samples(law, kEdges, 60, 6));
  ASSERT_FALSE(model.semantic.perceptron.empty());
  for (const double angle : {-1.5, 0.3, 2.8}) {
    const View view{6.5, angle, NAN, NAN};
    EXPECT_NEAR(model.semantic.confidence(view), law.confidence(view), 0.02) << angle;
  }
}

TEST(FitTest, ConfidenceIsAConstantWhereTheDataShowNoTrend) {
  const ClassModel model = fitted(made_poles(60, 1));
  EXPECT_TRUE(model.semantic.perceptron.empty());
  EXPECT_NEAR(model.semantic.confidence({5, 0, NAN, NAN}), 0.9, 0.01);
  ASSERT_NE(trial_of(model, "confidence: range and angle"), nullptr);
  EXPECT_FALSE(trial_of(model, "confidence: range and angle")->kept);
}

TEST(FitTest, AnInputIsKeptOnlyWhereItHelpsOnHeldOutRecordings) {
  MadeLaw law;
  law.covariates = true;
  const ClassModel model = fitted(made_samples(law, kEdges, 60, 7));
  ASSERT_NE(trial_of(model, "errors: elevation"), nullptr);
  EXPECT_TRUE(trial_of(model, "errors: elevation")->kept);
  EXPECT_FALSE(trial_of(model, "errors: reflectivity")->kept);
  const View low{6.5, 1.3, 0.1, NAN}, high{6.5, 1.3, 0.5, NAN};
  EXPECT_NEAR(model.geometric.expected(high).bias[2] - model.geometric.expected(low).bias[2],
              0.3 * 0.4, 0.02);
}

TEST(FitTest, ACylindersErrorsDependOnTheRangeOnly) {
  const ClassModel model = fitted(made_poles(100, 2));
  EXPECT_EQ(model.geometric.parts().intervals.sectors, 1);
  const auto expected = model.geometric.expected({6.5, 0, NAN, NAN});
  EXPECT_NEAR(expected.bias[0], 0.02, 0.01);
  EXPECT_NEAR(std::sqrt(expected.covariance(0, 0)), 0.05, 0.01);
  EXPECT_NEAR(std::sqrt(expected.covariance(1, 1)), 0.02, 0.005);
}

TEST(FitTest, WhatWasNotFlownIsSaidAndTakesTheNearestIntervalsValues) {
  std::vector<Sample> samples = made_samples(MadeLaw(), kEdges, 60, 8);
  std::erase_if(samples, [](const Sample& s) { return s.view.range > 12; });
  const GeometricModel model = geometric(samples);
  const View near{10, 1.3, NAN, NAN}, far{16, 1.3, NAN, NAN};
  EXPECT_FALSE(model.expected(near).extrapolated);
  EXPECT_TRUE(model.expected(far).extrapolated);
  EXPECT_TRUE(model.expected({1, 1.3, NAN, NAN}).extrapolated);
  const auto& fitted = model.parts().fitted;
  const Intervals& intervals = model.parts().intervals;
  EXPECT_EQ(fitted[static_cast<std::size_t>(intervals.of(far))].bias,
            fitted[static_cast<std::size_t>(intervals.of(near))].bias);
}

TEST(FitTest, AClassOfOwnMakingIsFittedWithoutCode) {
  objects::ClassTable table;
  objects::ObjectClass& own = table.classes.emplace_back();
  own.name = "bin";
  own.shape = objects::Shape::cuboid;
  own.target = true;
  own.label_ids = {200};
  const objects::ClassId bin = table.find("bin");
  std::vector<Sample> samples = made_samples(MadeLaw(), kEdges, 30, 9);
  for (Sample& sample : samples) sample.class_id = bin;
  const Model model(fit(samples, table, small_config(), 1));
  ASSERT_TRUE(model.knows(bin));
  EXPECT_FALSE(model.knows(kVehicle));
  EXPECT_EQ(model.predict(bin, {6, 1, NAN, NAN}).covariance.rows(), 4);
}

TEST(FitTest, TooFewObjectsAreRefused) {
  EXPECT_THROW((void)fitted(made_samples(MadeLaw(), kEdges, 5, 1)), Error);
  EXPECT_THROW((void)fit({}, kTable, small_config(), 1), Error);
}

TEST(FitTest, TheSameSamplesGiveTheSameModel) {
  const auto samples = made_samples(MadeLaw(), kEdges, 20, 10);
  const View view{7, -2, NAN, NAN};
  const ClassModel first = fitted(samples), second = fitted(samples);
  EXPECT_EQ(first.semantic.confidence(view), second.semantic.confidence(view));
  EXPECT_EQ(first.geometric.expected(view).covariance, second.geometric.expected(view).covariance);
}

}  // namespace
}  // namespace saker::uncertainty
