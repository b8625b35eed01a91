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

TEST(AdaptiveGate, IsTheInitialOneUntilSomethingIsKnown) {
  const AdaptiveGate gate({});
  EXPECT_FALSE(gate.settled());
  EXPECT_EQ(gate.gate_m(1), AdaptiveGateConfig().initial_m);
  EXPECT_EQ(gate.gate_m(5), AdaptiveGateConfig().initial_m);
}

TEST(AdaptiveGate, IsThreeTimesTheRootMeanSquareOfTheDeviations) {
  EXPECT_NEAR(after(moved(0.3)).gate_m(1), 0.9, 1e-4);
  AdaptiveGate mixed({});
  for (int i = 0; i < 600; ++i) mixed.learn(moved(i % 2 == 0 ? 0.1 : 0.5));
  EXPECT_NEAR(mixed.gate_m(1), 3 * std::sqrt((0.01 + 0.25) / 2), 0.03);
}

TEST(AdaptiveGate, CountsARotationByWhatItMovesAtItsRange) {
  SE3 turned = SE3::Identity();
  turned.rotate(Eigen::AngleAxisd(0.006, Eigen::Vector3d(1, 2, 2) / 3));
  const double metres = AdaptiveGateConfig().range_m * 0.006;
  EXPECT_NEAR(after(turned).gate_m(1), 3 * metres, 1e-3);
}

TEST(AdaptiveGate, WidensWithTheTimeSinceTheLastScanButNeverNarrows) {
  const AdaptiveGate gate = after(moved(0.2));
  EXPECT_NEAR(gate.gate_m(2), 2 * gate.gate_m(1), 1e-9);
  EXPECT_EQ(gate.gate_m(0.5), gate.gate_m(1));
}

TEST(AdaptiveGate, StaysWithinItsLimits) {
  const AdaptiveGateConfig config;
  EXPECT_EQ(after(moved(0.03)).gate_m(1), config.least_m);
  EXPECT_EQ(after(moved(30)).gate_m(1), config.most_m);
  EXPECT_EQ(after(moved(0.5)).gate_m(100), config.most_m);
}

TEST(AdaptiveGate, TinyDeviationsTeachNothing) {
  AdaptiveGate gate = after(moved(0.3));
  const double before = gate.gate_m(1);
  for (int i = 0; i < 100; ++i) gate.learn(moved(0.5 * AdaptiveGateConfig().least_deviation_m));
  EXPECT_EQ(gate.gate_m(1), before);
}

TEST(AdaptiveGate, ForgetsALargeDeviationBitByBit) {
  AdaptiveGate gate = after(moved(0.15));
  gate.learn(moved(2));
  double last = gate.gate_m(1);
  EXPECT_GT(last, 1);
  for (int i = 0; i < 50; ++i) {
    gate.learn(moved(0.15));
    EXPECT_LT(gate.gate_m(1), last);
    last = gate.gate_m(1);
  }
  EXPECT_NEAR(last, 0.45, 0.2);
}

TEST(AdaptiveGate, KnowsNothingAfterAReset) {
  AdaptiveGate gate = after(moved(0.3));
  EXPECT_TRUE(gate.settled());
  gate.reset();
  EXPECT_FALSE(gate.settled());
  EXPECT_EQ(gate.gate_m(1), AdaptiveGateConfig().initial_m);
}

}  // namespace
}  // namespace saker::odometry
