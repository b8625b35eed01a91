#include <gtest/gtest.h>

#include "flight/mavlink/latency.h"

namespace saker::flight::mavlink {
namespace {

TEST(MavlinkLatency, QuantilesAreThoseOfWhatWasCountedAndAtMostAFifthLonger) {
  LatencyHistogram histogram;
  for (int i = 1; i <= 1000; ++i) histogram.add(1e-5 * i);  // 10 µs … 10 ms
  EXPECT_EQ(histogram.count(), 1000);
  for (const double share : {0.01, 0.5, 0.95, 1.0}) {
    EXPECT_GE(histogram.quantile(share), 0.9999 * share * 1e-2) << share;
    EXPECT_LE(histogram.quantile(share), 1.19 * share * 1e-2 + 1e-5) << share;
  }
}

TEST(MavlinkLatency, NothingHasNoQuantileAndNoNumberCountsAsNothing) {
  LatencyHistogram histogram;
  histogram.add(NAN);
  histogram.add(INFINITY);
  EXPECT_TRUE(std::isnan(histogram.quantile(0.5)));
}

TEST(MavlinkLatency, TheShortestAndTheLongestHaveTheFirstAndTheLastBin) {
  LatencyHistogram histogram;
  histogram.add(0);
  EXPECT_DOUBLE_EQ(histogram.quantile(1), 1e-6);
  histogram.add(1e6);
  EXPECT_NEAR(histogram.quantile(1), 16.8, 0.1);
  histogram.add(-1);
  EXPECT_DOUBLE_EQ(histogram.quantile(0.5), 1e-6);
}

}  // namespace
}  // namespace saker::flight::mavlink
