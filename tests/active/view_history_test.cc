#include "saker/active/belief/view_history.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::active {
namespace {

constexpr double kRange = 10;  // m

Eigen::Vector3d eye_at(double bearing, double range = kRange) {
  return {range * std::cos(bearing), range * std::sin(bearing), 3};
}

ViewHistory no_views() { return {24, 1.5}; }

TEST(ViewHistory, OfOnePlaceIsOneDwellHoweverManyViewsThereAre) {
  ViewHistory views = no_views();
  for (int i = 0; i < 100; ++i) views.add(eye_at(0.01 * (i % 3)), {0, 0, 0}, 0.5, i);
  ASSERT_EQ(views.dwells().size(), 1U);
  EXPECT_NEAR(views.dwells()[0].seconds, 50, 1e-9);
  EXPECT_LT((views.dwells()[0].eye - eye_at(0.01)).norm(), 0.01);
  EXPECT_EQ(views.first_m(), 0);
  EXPECT_NEAR(views.dwells()[0].flown_m, 49.5, 1e-9);
}

TEST(ViewHistory, NearAPlaceIsWhatLiesWithinADistanceOfIt) {
  ViewHistory views = no_views();
  views.add({10, 0, 0}, {0, 0, 0}, 0.4, 0);
  views.add({10, 1.6, 0}, {0, 0, 0}, 0.7, 2);
  EXPECT_NEAR(views.seconds_near({10, 0.3, 0}, 0.5), 0.4, 1e-9);
  EXPECT_NEAR(views.seconds_near({10, 0.8, 0}, 1), 1.1, 1e-9);
  EXPECT_EQ(views.seconds_near({10, 0, 0}, 0), 0);
}

TEST(ViewHistory, IsInAMapOnceThatHoldsWhatWasMeasuredUntilTheViewsEnded) {
  MappedViewHistory views(no_views());
  views.add(1000, {10, 0, 0}, {0, 0, 0}, 0.4, 0);
  views.add(2000, {0, 10, 0}, {0, 0, 0}, 0.7, 12);
  EXPECT_EQ(views.so_far().dwells().size(), 2U);
  EXPECT_TRUE(views.in_map().dwells().empty());
  views.map_holds(1999);
  ASSERT_EQ(views.in_map().dwells().size(), 1U);
  EXPECT_NEAR(views.in_map().dwells()[0].seconds, 0.4, 1e-12);
  views.map_holds(2000);
  EXPECT_EQ(views.in_map().dwells().size(), 2U);
  EXPECT_EQ(views.in_map().first_m(), 0);
}

TEST(ViewHistory, FromAllAroundHasNoMoreDwellsThanBins) {
  ViewHistory views = no_views();
  for (int i = 0; i < 5000; ++i) views.add(eye_at(0.37 * i, 4 + i % 12), {0, 0, 0}, 0.1, 0);
  EXPECT_LE(views.dwells().size(), 24U * 9);
}

TEST(ViewHistory, AViewWithoutTimeIsNone) {
  ViewHistory views = no_views();
  views.add(eye_at(0), {0, 0, 0}, 0, 0);
  EXPECT_TRUE(views.dwells().empty());
}

}  // namespace
}  // namespace saker::active
