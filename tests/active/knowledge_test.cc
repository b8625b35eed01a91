#include "saker/active/belief/knowledge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "made_model.h"
#include "made_street.h"

namespace saker::active {
namespace {

using namespace made;
using std::numbers::pi;

constexpr double kRange = 10;  // m

Target car_at_origin(double yaw = 0) {
  Target target;
  target.id = 0;
  target.class_id = kVehicle;
  target.extent = car(0, 0, yaw);
  target.object_id = 0;
  return target;
}

Eigen::Vector3d eye_at(double bearing, double range = kRange) {
  return {range * std::cos(bearing), range * std::sin(bearing), 3};
}

ViewHistory no_views() { return ViewHistory(24, 1.5); }

PamsConfig config_with(double common = 0) {
  PamsConfig config;
  config.common_counts = common > 0;
  return config;
}

Knowledge known(const ViewHistory& views, double yaw = 0,
                const PamsConfig& config = config_with()) {
  return Knowledge(car_at_origin(yaw), views, oblique_model(), config);
}

TEST(Predicted, AViewThatShowsAVehicleEveryFourthTimeTellsAQuarter) {
  ViewModel seldom = oblique_model();
  seldom.predict = [](objects::ClassId id, const uncertainty::View& view) {
    uncertainty::Prediction prediction = predict(id, view);
    prediction.whole = 0.25;
    return prediction;
  };
  const auto of = [](const ViewModel& model) {
    return predicted(eye_at(pi / 4), car_at_origin(), model, config_with()).measured.covariance;
  };
  EXPECT_TRUE(of(seldom).isApprox(4 * of(oblique_model()), 1e-9));
}

TEST(Knowledge, BeforeAnyLookIsThePrior) {
  const PamsConfig config = config_with();
  const Eigen::Matrix4d prior = prior_covariance(config, false);
  EXPECT_TRUE(known(no_views()).belief().covariance().isApprox(prior, 1e-12));
  EXPECT_EQ(known(no_views()).cells(), 0);
}

TEST(Knowledge, CellCountsAfterADwellAndOnceHoweverLongItIs) {
  const PamsConfig config = config_with();
  const double bearing = 0.3;
  const uncertainty::View view = view_from(eye_at(bearing), car_at_origin(), oblique_model());
  const int cell = predict(kVehicle, view).cell;
  ViewHistory views = no_views();
  views.add(eye_at(bearing), {0, 0, 0}, config.dwell_s - 0.1, 0);
  EXPECT_FALSE(known(views).counted(cell));
  views.add(eye_at(bearing), {0, 0, 0}, 0.2, 0);
  EXPECT_TRUE(known(views).counted(cell));
  const double entropy = known(views).belief().entropy();
  views.add(eye_at(bearing), {0, 0, 0}, 100, 0);
  EXPECT_NEAR(known(views).belief().entropy(), entropy, 1e-12);
}

TEST(Knowledge, AfterCellsIsTheInverseOfTheSumOfTheirInformation) {
  ViewHistory views = no_views();
  double information = 4;  // of a prior of 0.5 m
  for (const double bearing : {0.3, 1.3, -2.0}) {
    views.add(eye_at(bearing), {0, 0, 0}, 3, 0);
    information += std::pow(view_sd(bearing), -2);
  }
  const Knowledge now = known(views);
  EXPECT_EQ(now.cells(), 3);
  EXPECT_TRUE(now.belief().covariance().isApprox(Eigen::Matrix4d::Identity() / information, 1e-9));
}

TEST(Knowledge, ChangesWithTheEstimateOfTheHeading) {
  ViewHistory views = no_views();
  views.add(eye_at(pi / 4), {0, 0, 0}, 3, 0);
  EXPECT_LT(known(views, 0).belief().entropy(), known(views, pi / 4).belief().entropy() - 1);
}

TEST(Knowledge, OfLaterLooksIsLessWhenDriftCounts) {
  PamsConfig config = config_with();
  config.drift_m = 0.05;
  ViewHistory views = no_views();
  views.add(eye_at(0.7), {0, 0, 0}, 3, 0);
  views.add(eye_at(2.3), {0, 0, 0}, 3, 30);
  const Eigen::Matrix4d without = known(views, 0, config).belief().covariance();
  config.drift_counts = true;
  const Eigen::Matrix4d with = known(views, 0, config).belief().covariance();
  EXPECT_GT(with(0, 0), without(0, 0));
  EXPECT_NEAR(with(2, 2), without(2, 2), 1e-12);
}

TEST(Knowledge, WhatIsExpectedIsTheMapsAndTheCellsThatAreNew) {
  const Covariance map(Eigen::Vector4d(0.01, 0.01, 0.04, 0.02).asDiagonal());
  ViewHistory views = no_views();
  views.add(eye_at(0.3), {0, 0, 0}, 3, 0);
  const Knowledge now = known(views);
  EXPECT_TRUE(now.expected(map, now).covariance().isApprox(map, 1e-9));
  views.add(eye_at(-2.0), {0, 0, 0}, 3, 0);
  const double length = 1 / (1 / 0.04 + std::pow(view_sd(-2.0), -2));
  EXPECT_NEAR(now.expected(map, known(views)).covariance()(2, 2), length, 1e-9);
}

TEST(Knowledge, WhereViewsContradictEachOtherTheNextIsExpectedToTellLess) {
  ViewHistory views = no_views();
  views.add(eye_at(0.3), {0, 0, 0}, 3, 0);
  views.add(eye_at(1.3), {0, 0, 0}, 3, 0);
  const Knowledge now = known(views);
  const Covariance map(9 * now.belief().covariance());
  views.add(eye_at(-2.0), {0, 0, 0}, 3, 0);
  const Eigen::Matrix4d then = known(views).belief().covariance();
  EXPECT_TRUE(now.expected(map, known(views)).covariance().isApprox(9 * then, 1e-6));
}

TEST(Knowledge, HoldsWhatIsCommonWhereItCounts) {
  PamsConfig config = config_with();
  config.common_counts = true;
  ViewHistory views = no_views();
  for (int i = 0; i < 12; ++i) views.add(eye_at(i * pi / 6 + 0.1), {0, 0, 0}, 3, 0);
  EXPECT_GT(known(views, 0, config).belief().covariance()(2, 2), 0.05 * 0.05);
}

}  // namespace
}  // namespace saker::active
