#include "saker/uncertainty/evaluation.h"

#include <gtest/gtest.h>

#include "made_model.h"
#include "made_samples.h"

namespace saker::uncertainty {
namespace {

const Eigen::Vector4d kBias(0.1, 0, -0.2, 0.05);

Eigen::Matrix4d covariance() {
  Eigen::Matrix4d P = Eigen::Vector4d(0.01, 0.02, 0.04, 0.01).asDiagonal();
  P(0, 2) = P(2, 0) = 0.01;
  return P;
}

Model model() { return made_model(even_parts(kBias, covariance()), 0.8); }

/// Four cells an object, so many windows each, with errors as the model says, times a factor.
std::vector<Sample> drawn(int objects, double factor = 1, int windows = 1) {
  core::Rng rng(4);
  std::vector<Sample> samples;
  for (int object = 0; object < objects; ++object) {
    for (const double angle : {-2.5, -0.5, 0.5, 2.5}) {
      const Eigen::Vector4d error = kBias + factor * normal4(rng, covariance());
      for (int window = 0; window < windows; ++window) {
        Sample sample;
        sample.recording = "made";
        sample.object_id = object;
        sample.class_id = kMadeClass;
        sample.view = {8, angle, NAN, NAN};
        sample.confidence = window % 2 == 0 ? 0.9 : 0.7;
        sample.error = error;
        samples.push_back(sample);
      }
    }
  }
  return samples;
}

Evaluation evaluated(const std::vector<Sample>& samples) {
  return evaluate(model(), kMadeClass, samples);
}

TEST(EvaluationTest, OfErrorsAsTheModelSaysIsOne) {
  const Evaluation result = evaluated(drawn(800));
  EXPECT_EQ(result.draws, 3200);
  EXPECT_EQ(result.objects, 800);
  EXPECT_NEAR(result.nees, 1, 0.05);
  EXPECT_NEAR(result.fused_nees, 1, 0.1);
}

TEST(EvaluationTest, OfErrorsTwiceAsLargeIsFour) {
  EXPECT_NEAR(evaluated(drawn(800, 2)).nees, 4, 0.2);
  EXPECT_NEAR(evaluated(drawn(800, 0.5)).nees, 0.25, 0.02);
}

TEST(EvaluationTest, WindowsFromOneCellCountOnce) {
  const Evaluation once = evaluated(drawn(50)), often = evaluated(drawn(50, 1, 6));
  EXPECT_EQ(often.draws, once.draws);
  EXPECT_NEAR(often.nees, once.nees, 1e-9);
  EXPECT_NEAR(often.fused_nees, once.fused_nees, 1e-9);
}

TEST(EvaluationTest, FusedErrorIsTheMeanOverTheCellsWithoutTheBias) {
  const Evaluation result = evaluated(drawn(800));
  for (int k = 0; k < 4; ++k) {
    const double expected = std::sqrt(covariance()(k, k) / 4);  // of four cells alike
    EXPECT_NEAR(result.fused_error_sd[k], expected, 0.1 * expected) << k;
    EXPECT_NEAR(result.fused_error_mean[k], 0, 0.15 * expected) << k;
  }
}

TEST(EvaluationTest, ABiasThatTheModelDoesNotKnowShows) {
  std::vector<Sample> samples = drawn(400);
  for (Sample& sample : samples) sample.error[2] += 0.3;
  const Evaluation result = evaluated(samples);
  EXPECT_NEAR(result.fused_error_mean[2], 0.3, 0.03);
  EXPECT_GT(result.fused_nees, 1.5);
}

TEST(EvaluationTest, WhatAllCellsOfAnObjectShareIsJudgedByTheCommonPart) {
  core::Rng rng(9);
  std::vector<Sample> samples = drawn(600);
  GeometricModel::Parts parts = even_parts(kBias, covariance());
  parts.common = 0.09 * Eigen::Matrix4d::Identity();
  for (std::size_t i = 0; i < samples.size(); i += 4) {
    const Eigen::Vector4d added = normal4(rng, parts.common);
    for (std::size_t k = i; k < i + 4; ++k) samples[k].error += added;
  }
  const Evaluation result = evaluate(made_model(parts, 0.8), kMadeClass, samples);
  EXPECT_NEAR(result.nees, 1, 0.1);
  EXPECT_NEAR(result.fused_nees, 1, 0.1);
}

TEST(EvaluationTest, OnlyWholeFlownSamplesOfTheClassAreJudged) {
  const auto draws_with = [](auto spoil) {
    std::vector<Sample> samples = drawn(10);
    spoil(samples[0]);
    GeometricModel::Parts parts = even_parts(kBias, covariance());
    parts.whole_length_sd_m = 0.25;
    return evaluate(made_model(parts), kMadeClass, samples).draws;
  };
  EXPECT_EQ(draws_with([](Sample&) {}), 40);
  EXPECT_EQ(draws_with([](Sample& s) { s.length_sd = 0.3; }), 39);
  EXPECT_EQ(draws_with([](Sample& s) { s.view.range = 25; }), 39);
  EXPECT_EQ(draws_with([](Sample& s) { s.class_id = 3; }), 39);
}

TEST(EvaluationTest, OfNothingIsNotANumber) {
  const Evaluation result = evaluated({});
  EXPECT_EQ(result.draws, 0);
  EXPECT_TRUE(std::isnan(result.nees) && std::isnan(result.fused_nees));
}

TEST(EvaluationTest, ConfidenceErrorsAreRootMeanSquares) {
  const Evaluation result = evaluated(drawn(20, 1, 2));  // 0.9 and 0.7 where 0.8 is said
  EXPECT_NEAR(result.confidence_error, 0.1, 1e-9);
  EXPECT_NEAR(result.constant_error, 0.1, 1e-9);
}

}  // namespace
}  // namespace saker::uncertainty
