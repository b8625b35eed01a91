#include "saker/autonomy/standstill.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saker/core/rng.h"

namespace saker::autonomy {
namespace {

/// Samples at 100 Hz whose swaying along x dies away with `decay_s`.
std::vector<lidar::ImuSample> samples(double begin_s, double end_s, double sway, double decay_s) {
  core::Rng rng(5);
  std::vector<lidar::ImuSample> result;
  for (int i = static_cast<int>(begin_s * 100); i < static_cast<int>(end_s * 100); ++i) {
    const double t = 0.01 * i;
    lidar::ImuSample sample;
    sample.stamp = from_seconds(t);
    sample.acceleration = {sway * std::exp(-t / decay_s) * std::sin(20 * t) + rng.normal(0, 0.02),
                           rng.normal(0, 0.02), 9.81 + rng.normal(0, 0.02)};
    sample.angular_velocity.setConstant(0.004);
    result.push_back(sample);
  }
  return result;
}

TEST(Standstill, IsReachedAfterAWindowOfRest) {
  Standstill standstill({});
  standstill.add(samples(0, 0.9, 0, 1));
  EXPECT_FALSE(standstill.reached());
  standstill.add(samples(0.9, 1.1, 0, 1));
  EXPECT_TRUE(standstill.reached());
}

TEST(Standstill, WaitsUntilTheSwayingHasDiedAway) {
  Standstill standstill({});
  double reached_s = 0;
  for (int i = 0; i < 50 && reached_s == 0; ++i) {
    standstill.add(samples(0.1 * i, 0.1 * (i + 1), 6, 0.3));
    if (standstill.reached()) reached_s = 0.1 * (i + 1);
  }
  EXPECT_GT(reached_s, 1.5);  // the swaying is below 0.4 after 0.8 s
  EXPECT_LT(reached_s, 2.2);
  EXPECT_LE(standstill.samples().size(), 102u);
}

TEST(Standstill, ATurnIsNoRest) {
  Standstill standstill({});
  auto turning = samples(0, 2, 0, 1);
  for (std::size_t i = 150; i < turning.size(); ++i) turning[i].angular_velocity.z() = 0.5;
  standstill.add(turning);
  EXPECT_FALSE(standstill.reached());
}

TEST(Standstill, SamplesThatAreNotFiniteDoNotCount) {
  Standstill standstill({});
  auto broken = samples(0, 2, 0, 1);
  for (auto& sample : broken) sample.acceleration.x() = NAN;
  standstill.add(broken);
  EXPECT_FALSE(standstill.reached());
}

}  // namespace
}  // namespace saker::autonomy
