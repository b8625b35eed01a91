#include "saker/uncertainty/regions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saker/core/error.h"

namespace saker::uncertainty {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr objects::ClassId kVehicle = 1;

/// Small errors at oblique views within 8 m; `sd` of all errors there, twice that elsewhere.
Model model_of(double sd, double confidence) {
  GeometricModel::Parts parts;
  parts.intervals = {{2, 8, 14}, 6};
  for (int i = 0; i < parts.intervals.size(); ++i) {
    const bool oblique = i < 6 && (i == 1 || i == 4);
    const double own = oblique ? sd : 2 * sd;
    GeometricModel::Interval interval;
    interval.bias = Eigen::Vector4d::Constant(0.5);
    interval.covariance = own * own * Eigen::Matrix4d::Identity();
    interval.covariate_mean.resize(0);
    interval.objects = 10;
    parts.fitted.push_back(interval);
  }
  parts.common = 1e-8 * Eigen::Matrix4d::Identity();
  ClassModel model;
  model.id = kVehicle;
  model.geometric = GeometricModel(parts);
  model.semantic.mean = confidence;
  return Model({model});
}

/// The same, but only one measurement in two shows the object from end to end.
Model half_whole(double sd) {
  GeometricModel::Parts parts = model_of(sd, 0.99).of(kVehicle).geometric.parts();
  for (auto& interval : parts.fitted) interval.whole = 0.5;
  ClassModel model = model_of(sd, 0.99).of(kVehicle);
  model.geometric = GeometricModel(parts);
  return Model({model});
}

const View kOblique{5, kPi / 4, NAN, NAN};
const View kSide{5, kPi / 2, NAN, NAN};

TEST(RegionsTest, ProbabilityOfSmallErrorsIsThatOfTheGaussian) {
  const Model model = model_of(0.05, 0.99);
  const Regions regions({}, model, kVehicle);
  // Rayleigh in place, normal in both sizes; the bias is known and does not count.
  const double place = 1 - std::exp(-0.5 * 2 * 2);
  const double size = std::erf(4 / std::sqrt(2.0));
  EXPECT_NEAR(regions.small_error_probability(kOblique), place * size * size, 0.03);
}

TEST(RegionsTest, AViewThatHidesAnEndEverySecondTimeIsHalfAsProbableToBePrecise) {
  const Model model = model_of(0.05, 0.99), half = half_whole(0.05);
  EXPECT_NEAR(Regions({}, half, kVehicle).small_error_probability(kOblique),
              0.5 * Regions({}, model, kVehicle).small_error_probability(kOblique), 1e-9);
}

TEST(RegionsTest, OnlyViewsWithSmallErrorsArePrecise) {
  const Model model = model_of(0.03, 0.99);
  const Regions regions({}, model, kVehicle);
  EXPECT_FALSE(regions.relative_probability());
  EXPECT_TRUE(regions.precise(kOblique));
  EXPECT_TRUE(regions.precise({5, -kPi / 4, NAN, NAN})) << "the mirror image";
  EXPECT_FALSE(regions.precise(kSide));
  EXPECT_TRUE(regions.contains(kOblique));
}

TEST(RegionsTest, WhereNoViewReachesTheThresholdTheBestShareIsTaken) {
  const Model model = model_of(0.2, 0.9);
  RegionConfig config;
  config.best_share = 0.1;
  const Regions regions(config, model, kVehicle);
  EXPECT_TRUE(regions.relative_probability());
  EXPECT_TRUE(regions.relative_confidence());
  EXPECT_TRUE(regions.contains(kOblique));
  EXPECT_FALSE(regions.contains(kSide));
}

TEST(RegionsTest, WhatWasNotFlownBelongsToNoRegion) {
  const Model model = model_of(0.03, 0.99);
  const Regions regions({}, model, kVehicle);
  EXPECT_FALSE(regions.contains({1.5, kPi / 4, NAN, NAN}));
}

TEST(RegionsTest, AnUnknownClassIsRefused) {
  const Model model = model_of(0.03, 0.99);
  EXPECT_THROW((void)Regions({}, model, 2), Error);
}

}  // namespace
}  // namespace saker::uncertainty
