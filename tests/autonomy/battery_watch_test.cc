#include "saker/autonomy/battery_watch.h"

#include <gtest/gtest.h>

namespace saker::autonomy {
namespace {

constexpr double kFlight_s = 900;
constexpr double kNominal = 1 / kFlight_s;

Time at(double seconds) { return from_seconds(1000 + seconds); }

/// A battery that falls so fast, said every 20 ms in steps, from 0.9 on. \return what it was last
double fly(BatteryWatch& watch, double drain_per_s, double seconds, double step = 0) {
  double share = 0.9;
  for (double t = 0; t <= seconds; t += 0.02) {
    share = 0.9 - drain_per_s * t;
    if (step > 0) share = step * std::round(share / step);
    watch.update(at(t), share, true);
  }
  return share;
}

TEST(BatteryWatch, BelievesTheNominalDrainUntilOneIsMeasured) {
  const BatteryWatch watch(kFlight_s);
  EXPECT_DOUBLE_EQ(watch.drain_per_s(), kNominal);
}

TEST(BatteryWatch, MeasuresTheDrainInWholePercents) {
  for (const double drain : {0.5 * kNominal, kNominal, 1.8 * kNominal}) {
    BatteryWatch watch(kFlight_s);
    (void)fly(watch, drain, 300, 0.01);
    const double expected = (60 * kNominal + 120 * drain) / 180;  // the nominal one is a minute
    EXPECT_NEAR(watch.drain_per_s(), expected, 0.1 * expected);
  }
}

TEST(BatteryWatch, AFallFromOneMomentToTheNextIsNoDrain) {
  BatteryWatch watch(kFlight_s);
  (void)fly(watch, kNominal, 60);
  watch.update(at(60.1), 0.3, true);
  EXPECT_LE(watch.drain_per_s(), 2 * kNominal);
  EXPECT_DOUBLE_EQ(watch.share(at(60.1)), 0.3);
}

TEST(BatteryWatch, WhatIsNoLongerSaidFallsByTheDrain) {
  BatteryWatch watch(kFlight_s);
  const double last = fly(watch, kNominal, 100);
  for (double t = 100; t < 200; t += 0.02) watch.update(at(t), NAN, true);
  EXPECT_NEAR(watch.share(at(200)), last - 100 * kNominal, 0.002);
  EXPECT_NEAR(watch.unknown_s(at(200)), 100, 0.1);
  EXPECT_DOUBLE_EQ(watch.share(at(1e5)), 0);
}

TEST(BatteryWatch, WhatWasNeverSaidIsNotKnown) {
  BatteryWatch watch(kFlight_s);
  watch.update(at(0), NAN, true);
  watch.update(at(10), 1.7, true);
  EXPECT_TRUE(std::isnan(watch.share(at(10))));
  EXPECT_NEAR(watch.unknown_s(at(10)), 10, 1e-6);
}

TEST(BatteryWatch, OnTheGroundItForgetsTheFlight) {
  BatteryWatch watch(kFlight_s);
  (void)fly(watch, 1.8 * kNominal, 300);
  watch.update(at(301), NAN, false);
  EXPECT_DOUBLE_EQ(watch.drain_per_s(), kNominal);
  EXPECT_TRUE(std::isnan(watch.share(at(301))));
  EXPECT_DOUBLE_EQ(watch.unknown_s(at(301)), 0);
}

}  // namespace
}  // namespace saker::autonomy
