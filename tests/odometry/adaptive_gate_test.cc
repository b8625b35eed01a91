#include "saker/odometry/adaptive_gate.h"

#include <gtest/gtest.h>

namespace saker::odometry {
namespace {

SE3 moved(double metres) {
  SE3 T = SE3::Identity();
  T.translation() << 0, metres, 0;
  return T;
}

AdaptiveGate after(const SE3& deviation, int scans = 300) {
  AdaptiveGate gate({});
  for (int i = 0; i < scans; ++i) gate.learn(deviation);
  return gate;
}

const Matrix6d kUnsure = Matrix6d::Identity();

TEST(AdaptiveGate, IsTheInitialOneUntilSomethingIsKnown) {
  const AdaptiveGate gate({});
  EXPECT_FALSE(gate.settled());
  EXPECT_EQ(gate.gate_m(1, kUnsure), AdaptiveGateConfig().initial_m);
  EXPECT_EQ(gate.gate_m(5, kUnsure), AdaptiveGateConfig().initial_m);
}

TEST(AdaptiveGate, IsThreeTimesTheRootMeanSquareOfTheDeviations) {
  EXPECT_NEAR(after(moved(0.3)).gate_m(1, kUnsure), 0.9, 1e-4);
  AdaptiveGate mixed({});
  for (int i = 0; i < 600; ++i) mixed.learn(moved(i % 2 == 0 ? 0.1 : 0.5));
  EXPECT_NEAR(mixed.gate_m(1, kUnsure), 3 * std::sqrt((0.01 + 0.25) / 2), 0.03);
}

TEST(AdaptiveGate, CountsARotationByWhatItMovesAtItsRange) {
  SE3 turned = SE3::Identity();
  turned.rotate(Eigen::AngleAxisd(0.006, Eigen::Vector3d(1, 2, 2) / 3));
  const double metres = AdaptiveGateConfig().range_m * 0.006;
  EXPECT_NEAR(after(turned).gate_m(1, kUnsure), 3 * metres, 1e-3);
}

TEST(AdaptiveGate, WidensWithTheTimeSinceTheLastScanButNeverNarrows) {
  const AdaptiveGate gate = after(moved(0.2));
  EXPECT_NEAR(gate.gate_m(2, kUnsure), 2 * gate.gate_m(1, kUnsure), 1e-9);
  EXPECT_EQ(gate.gate_m(0.5, kUnsure), gate.gate_m(1, kUnsure));
}

TEST(AdaptiveGate, StaysWithinItsLimits) {
  const AdaptiveGateConfig config;
  EXPECT_EQ(after(moved(0.03)).gate_m(1, kUnsure), config.least_m);
  EXPECT_EQ(after(moved(30)).gate_m(1, kUnsure), config.most_m);
  EXPECT_EQ(after(moved(0.5)).gate_m(100, kUnsure), config.most_m);
}

TEST(AdaptiveGate, IsNoWiderThanThreeDeviationsOfThePrediction) {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(0.002 * 0.002);
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(0.1 * 0.1);
  const double range_m = AdaptiveGateConfig().range_m;
  const double sd_m = std::sqrt(3 * (0.1 * 0.1 + range_m * range_m * 0.002 * 0.002));
  EXPECT_NEAR(after(moved(1)).gate_m(1, covariance), 3 * sd_m, 1e-9);
  EXPECT_EQ(after(moved(1)).gate_m(1, 1e-4 * covariance), AdaptiveGateConfig().least_m);
}

TEST(AdaptiveGate, TinyDeviationsTeachNothing) {
  AdaptiveGate gate = after(moved(0.3));
  const double before = gate.gate_m(1, kUnsure);
  for (int i = 0; i < 100; ++i) gate.learn(moved(0.5 * AdaptiveGateConfig().least_deviation_m));
  EXPECT_EQ(gate.gate_m(1, kUnsure), before);
}

TEST(AdaptiveGate, ForgetsALargeDeviationBitByBit) {
  AdaptiveGate gate = after(moved(0.15));
  gate.learn(moved(2));
  double last = gate.gate_m(1, kUnsure);
  EXPECT_GT(last, 1);
  for (int i = 0; i < 50; ++i) {
    gate.learn(moved(0.15));
    EXPECT_LT(gate.gate_m(1, kUnsure), last);
    last = gate.gate_m(1, kUnsure);
  }
  EXPECT_NEAR(last, 0.45, 0.2);
}

TEST(AdaptiveGate, KnowsNothingAfterAReset) {
  AdaptiveGate gate = after(moved(0.3));
  EXPECT_TRUE(gate.settled());
  gate.reset();
  EXPECT_FALSE(gate.settled());
  EXPECT_EQ(gate.gate_m(1, kUnsure), AdaptiveGateConfig().initial_m);
}

}  // namespace
}  // namespace saker::odometry
