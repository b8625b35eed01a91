#include "detection/interval.h"

#include <gtest/gtest.h>

namespace saker::detection {
namespace {

TEST(Interval, KeepsEdgesThatWereSeen) {
  const Interval i = fuse_edges({1, 0.05}, {5, 0.05}, {4.4, 0.3}, 0.3);
  EXPECT_DOUBLE_EQ(i.size(), 4);
  EXPECT_DOUBLE_EQ(i.centre(), 3);
}

TEST(Interval, MovesTheUnseenEdgeToTheLikelySizeAndSaysSo) {
  const Interval i = fuse_edges({1, 0.05}, {1.5, 1}, {4.4, 0.3}, 0.3);
  EXPECT_NEAR(i.low, 1, 0.02);
  EXPECT_GT(i.size(), 4);
  EXPECT_NEAR(std::sqrt(i.covariance(1, 1)), 0.29, 0.02);
  EXPECT_GT(i.covariance(0, 1), 0) << "a longer vehicle reaches to the unseen side";
}

}  // namespace
}  // namespace saker::detection
