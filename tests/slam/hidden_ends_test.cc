#include "saker/slam/hidden_ends.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_world.h"
#include "saker/slam/landmark_estimate.h"

namespace saker::slam {
namespace {

using objects::Cuboid;

const Cuboid kCar{SE3::Identity(), {4.4, 1.8, 1.5}};

/// Over [centre, size] of an axis, from what its low and high end lie farther out.
Vector9d ends_out(int axis, double low, double high) {
  Vector9d error = Vector9d::Zero();
  error[3 + axis] = 0.5 * (high - low);
  error[6 + axis] = high + low;
  return error;
}

/// Both ends of both axes with a standard deviation of 0.1 m.
Matrix9d tenth_of_a_metre() {
  Matrix9d covariance = 1e-4 * Matrix9d::Identity();
  covariance.block<2, 2>(3, 3) = 0.005 * Eigen::Matrix2d::Identity();
  covariance.block<2, 2>(6, 6) = 0.02 * Eigen::Matrix2d::Identity();
  return covariance;
}

TEST(HiddenEnds, AnEndFartherInThanMeasuredIsTheGaussians) {
  const Vector9d error = ends_out(0, -0.8, -0.3);
  EXPECT_TRUE(HiddenEnds(kCar, tenth_of_a_metre(), {})(error).error.isApprox(error));
}

TEST(HiddenEnds, AnEndFartherOutIsCauchys) {
  const Vector9d error = HiddenEnds(kCar, tenth_of_a_metre(), {})(ends_out(0, 0, 0.8)).error;
  const double of_high_end = 0.1 * std::sqrt(std::log1p(64));
  EXPECT_TRUE(error.isApprox(ends_out(0, 0, of_high_end)));
}

TEST(HiddenEnds, WhatLiesFartherOutThanAnEndHidesIsWeighedInFull) {
  const HiddenEnds hidden_ends(kCar, tenth_of_a_metre(), {.most_m = 1.5});
  const double near = hidden_ends(ends_out(0, 0, 1.5)).error[6];
  EXPECT_NEAR(hidden_ends(ends_out(0, 0, 3.5)).error[6], near + 2, 1e-12);
}

TEST(HiddenEnds, OneHiddenEndTakesNothingFromTheOther) {
  const HiddenEnds hidden_ends(kCar, tenth_of_a_metre(), {});
  const Vector9d error = hidden_ends(ends_out(0, -0.2, 1.5)).error;
  EXPECT_NEAR(error[3] - 0.5 * error[6], 0.2, 1e-12);  // the low end's, inward
}

TEST(HiddenEnds, ASideIsNoHiddenEnd) {
  const Vector9d error = ends_out(1, 0.4, 0.6);
  EXPECT_EQ(HiddenEnds(kCar, tenth_of_a_metre(), {})(error).error, error);
}

TEST(HiddenEnds, TheSecantTimesTheErrorIsTheSoftenedError) {
  const Vector9d error = ends_out(0, 0.6, 0.05) + ends_out(1, -0.3, 0.9);
  const auto softened = HiddenEnds(kCar, tenth_of_a_metre(), {.sds = 2})(error);
  EXPECT_TRUE((softened.secant * error).isApprox(softened.error, 1e-12));
}

TEST(HiddenEnds, TheSlopeIsTheDerivative) {
  const HiddenEnds hidden_ends(kCar, tenth_of_a_metre(), {});
  for (const double out : {-0.5, 0.0, 1e-6, 0.07, 0.8, 3.0}) {
    const Vector9d error = ends_out(0, 0.4, out) + ends_out(1, out, -0.1);
    const Matrix9d slope = hidden_ends(error).slope;
    for (int i = 0; i < 9; ++i) {
      constexpr double kStep = 1e-7;
      const Vector9d step = kStep * Vector9d::Unit(i);
      const Vector9d by_differences =
          (hidden_ends(error + step).error - hidden_ends(error - step).error) / (2 * kStep);
      EXPECT_NEAR((by_differences - slope.col(i)).norm(), 0, 1e-6) << out << ", " << i;
    }
  }
}

/// Windows of a car 4.4 m long from one keyframe; of a `cut` one the rear end is missing by 1 m.
Landmark seen(int whole, int cut) {
  Landmark landmark;
  Matrix9d covariance = tenth_of_a_metre();
  for (int i = 0; i < whole + cut; ++i) {
    const double missing = i < cut ? 1 : 0;
    const Cuboid measured{SE3(Eigen::Translation3d(8 + 0.5 * missing, 0, 0)),
                          {4.4 - missing, 1.8, 1.5}};
    landmark.observations.push_back({i, {measured, covariance}});
    landmark.model = landmark.observations.front().measured.model;
  }
  return landmark;
}

TEST(HiddenEnds, AFewWholeWindowsTellTheLengthOfManyCutOnes) {
  Landmark landmark = seen(5, 20);
  std::vector<Keyframe> keyframes;
  for (int i = 0; i < 25; ++i) {
    Keyframe keyframe;
    keyframe.serial = i;
    keyframes.push_back(keyframe);
  }
  const Chain chain{&keyframes};
  (void)refine(landmark, {&chain, 1}, GraphConfig{});
  const auto& cuboid = std::get<Cuboid>(landmark.model);
  EXPECT_NEAR(cuboid.size.x(), 4.4, 0.1);
  EXPECT_NEAR(cuboid.pose.translation().x() + 0.5 * cuboid.size.x(), 10.2, 0.03);
}

}  // namespace
}  // namespace saker::slam
