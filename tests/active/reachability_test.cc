#include "saker/active/views/reachability.h"

#include <gtest/gtest.h>

#include "made_flight.h"

namespace saker::active {
namespace {

using namespace made;

constexpr double kClearance = 0.9;
const Eigen::Vector3d kVehicle3(0, 0, 3);

bool reaches(const occupancy::OccupancyGrid& grid, const Eigen::Vector3d& p,
             const InGeofence& fence = everywhere) {
  return Reachability({&grid, SE3::Identity()}, kVehicle3, kClearance, fence).reaches(p);
}

/// A wall from floor to ceiling across the block, at x = 10.
occupancy::OccupancyGrid walled(double gap_m) {
  auto grid = free_grid();
  fill(grid, {10, -30, -1}, {10.5, 30, 7});
  fill(grid, {10, -gap_m / 2, -1}, {10.5, gap_m / 2, 7}, occupancy::Cell::free);
  return grid;
}

TEST(Reachability, OfAnEmptyBlockIsAllOfIt) {
  EXPECT_TRUE(reaches(free_grid(), {25, -25, 2}));
  EXPECT_TRUE(reaches(free_grid(), {500, 0, 2}));
}

TEST(Reachability, WithoutABlockIsEverything) {
  const Reachability reachability({}, kVehicle3, kClearance, everywhere);
  EXPECT_TRUE(reachability.reaches({100, 0, 3}));
}

TEST(Reachability, EndsAtAWallAndGoesThroughItsDoor) {
  EXPECT_FALSE(reaches(walled(0), {20, 0, 3}));
  EXPECT_TRUE(reaches(walled(0), {-20, 0, 3}));
  EXPECT_TRUE(reaches(walled(4), {20, 20, 3}));
}

TEST(Reachability, GapNarrowerThanTheVehicleIsNone) {
  EXPECT_FALSE(reaches(walled(1), {20, 20, 3}));
}

TEST(Reachability, GoesThroughTheUnknown) {
  auto grid = free_grid();
  fill(grid, {5, -30, -1}, {15, 30, 7}, occupancy::Cell::unknown);
  EXPECT_TRUE(reaches(grid, {20, 0, 3}));
}

TEST(Reachability, StaysInTheGeofence) {
  const InGeofence fence = [](const Eigen::Vector3d& p) { return p.x() < 8 || p.x() > 12; };
  EXPECT_FALSE(reaches(free_grid(), {20, 0, 3}, fence));
}

TEST(Reachability, OfAVehicleInABoxEndsInIt) {
  auto grid = free_grid();
  for (const double side : {-5.0, 4.5}) {
    fill(grid, {side, -5, -1}, {side + 0.5, 5, 7});
    fill(grid, {-5, side, -1}, {5, side + 0.5, 7});
  }
  EXPECT_TRUE(reaches(grid, {2, 2, 3}));
  EXPECT_FALSE(reaches(grid, {10, 0, 3}));
  EXPECT_FALSE(reaches(grid, {500, 0, 3}));
}

}  // namespace
}  // namespace saker::active
