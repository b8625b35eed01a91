#include "saker/motion/geofence.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"

namespace saker::motion {
namespace {

/// An L: the square 0 … 10 without its upper right quarter; heights 1 … 5.
GeofenceConfig corner() { return {1, 5, {0, 0, 10, 0, 10, 5, 5, 5, 5, 10, 0, 10}}; }

TEST(Geofence, TellsTheDistanceToTheNearestFaceInside) {
  const Geofence fence(corner());
  EXPECT_DOUBLE_EQ(fence.inside_m({2.5, 1.5, 3}), 1.5);       // the edge y = 0
  EXPECT_DOUBLE_EQ(fence.inside_m({2.5, 2.5, 4}), 1);         // the top
  EXPECT_DOUBLE_EQ(fence.inside_m({4, 4, 3}), std::sqrt(2));  // the inner corner
}

TEST(Geofence, IsNegativeOutside) {
  const Geofence fence(corner());
  EXPECT_DOUBLE_EQ(fence.inside_m({12, 2, 3}), -2);
  EXPECT_DOUBLE_EQ(fence.inside_m({2, 2, 5.5}), -0.5);
  EXPECT_DOUBLE_EQ(fence.inside_m({2, 2, 0.25}), -0.75);
}

TEST(Geofence, LeavesTheNotchOfAnLOutside) {
  const Geofence fence(corner());
  EXPECT_FALSE(fence.contains({7, 7, 3}));
  EXPECT_TRUE(fence.contains({7, 3, 3}));
  EXPECT_TRUE(fence.contains({3, 7, 3}));
}

TEST(Geofence, DoesNotDependOnTheSenseOfTheCorners) {
  GeofenceConfig reversed = corner();
  reversed.polygon_m = {0, 10, 5, 10, 5, 5, 10, 5, 10, 0, 0, 0};
  EXPECT_DOUBLE_EQ(Geofence(reversed).inside_m({3, 7, 3}), Geofence(corner()).inside_m({3, 7, 3}));
  EXPECT_DOUBLE_EQ(Geofence(reversed).inside_m({7, 7, 3}), Geofence(corner()).inside_m({7, 7, 3}));
}

TEST(Geofence, RefusesAreasThatAreNone) {
  GeofenceConfig odd = corner(), line = corner(), flat = corner(), nan = corner();
  odd.polygon_m.pop_back();
  line.polygon_m = {0, 0, 1, 1};
  flat.highest_m = flat.lowest_m;
  nan.polygon_m[3] = NAN;
  for (const GeofenceConfig& bad : {odd, line, flat, nan}) EXPECT_THROW(Geofence{bad}, Error);
}

}  // namespace
}  // namespace saker::motion
