#include "saker/active/discovery/coverage.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "made_fence.h"
#include "made_street.h"
#include "saker/active/discovery/column.h"
#include "saker/core/error.h"

namespace saker::active {
namespace {

using Eigen::Vector2d;
using namespace made;

const FieldOfViewConfig kView;

/// Flies from stop to stop. \return how many.
int fly_over(Coverage& coverage, const occupancy::OccupancyGrid& grid,
             const objects::ObjectMap* map = nullptr) {
  int flown = 0;
  for (auto next = coverage.next(); next && flown < 10'000; next = coverage.next(), ++flown) {
    const Vector2d place = coverage.stops()[*next];
    for (int second = 0; second < 3; ++second) {
      coverage.observe({place.x(), place.y(), 3}, 0, 1, {&grid, SE3::Identity()}, map);
    }
    coverage.close(*next);
  }
  return flown;
}

TEST(Coverage, HasAStopWithinTheSpacingOfEveryPointOfTheFence) {
  auto all = shapes();
  all["spike"] = {{0, 0}, {200, 0}, {200, 1}, {40, 1}, {40, 30}, {0, 30}};
  for (const auto& [name, corners] : all) {
    const motion::Geofence fence = fence_of(corners);
    const SweepConfig config;
    const Coverage coverage(config, kView, fence);
    const double cell = std::sqrt(2.0) * config.cell_m;
    for (const Vector2d& p : points_in(fence)) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector2d& stop : coverage.stops()) nearest = std::min(nearest, (stop - p).norm());
      ASSERT_LE(nearest, config.spacing_m + cell) << name << " at " << p.transpose();
    }
  }
}

TEST(Coverage, OfAnOpenPlaceIsComplete) {
  Coverage coverage({}, kView, box_fence(50, 30));
  const int flown = fly_over(coverage, free_grid(60));
  EXPECT_GT(coverage.seen_share(), 0.95);
  EXPECT_LE(flown, static_cast<int>(coverage.stops().size()));
}

TEST(Coverage, LeavesStopsOutWhoseSurroundingsWereSeen) {
  Coverage coverage({}, kView, box_fence(50, 30));
  EXPECT_LT(fly_over(coverage, free_grid(60)), 0.7 * static_cast<double>(coverage.stops().size()));
}

TEST(Coverage, WithoutAnOccupancyBlockGoesToEveryStopOnce) {
  Coverage coverage({}, kView, box_fence(20, 15));
  const occupancy::OccupancyGrid nothing;
  EXPECT_EQ(fly_over(coverage, nothing), static_cast<int>(coverage.stops().size()));
  EXPECT_EQ(coverage.seen_share(), 0);
}

TEST(Coverage, DoesNotCountWhatIsUnknown) {
  auto grid = free_grid(60);
  fill(grid, {10, -60, -1}, {60, 60, 7}, occupancy::Cell::unknown);
  Coverage coverage({}, kView, box_fence(50, 30));
  fly_over(coverage, grid);
  EXPECT_NEAR(coverage.seen_share(), 0.6, 0.03);
}

TEST(Coverage, CountsNoGlance) {
  Coverage coverage({}, kView, box_fence(10, 10));
  const auto grid = free_grid(30);
  coverage.observe({0, 0, 3}, 0, 2.5, {&grid, SE3::Identity()}, nullptr);
  EXPECT_EQ(coverage.seen_share(), 0);
  EXPECT_TRUE(coverage.next());
  coverage.observe({0, 0, 3}, 0, 1, {&grid, SE3::Identity()}, nullptr);
  EXPECT_EQ(coverage.seen_share(), 1);
  EXPECT_FALSE(coverage.next());
}

TEST(Coverage, OfALidarOnItsSideIsWhatLiesUnderTheVehicleAndAheadOfIt) {
  FieldOfViewConfig view;
  view.R_body_lidar =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  view.farthest_m = 30;
  Coverage coverage({}, view, box_fence(20, 20));
  const auto grid = free_grid(30);
  coverage.observe({0, 0, 20}, 0, 4, {&grid, SE3::Identity()}, nullptr);
  const double share = coverage.seen_share();
  EXPECT_NEAR(share, 0.45, 0.1);  // ±8.3 m to the sides under it, ±11.7 m at its ends
  coverage.observe({0, 0, 20}, std::numbers::pi / 2, 4, {&grid, SE3::Identity()}, nullptr);
  EXPECT_GT(coverage.seen_share(), 1.4 * share);
}

TEST(Coverage, GoesOnWhereItWasAndNeverOpensAStopAgain) {
  Coverage coverage({}, kView, box_fence(50, 30));
  const std::size_t first = *coverage.next();
  EXPECT_EQ(*coverage.next(), first);
  coverage.close(first);
  const std::size_t second = *coverage.next();
  EXPECT_EQ(second, first + 1);
  for (std::size_t i = 0; i < coverage.stops().size(); ++i) coverage.close(i);
  EXPECT_FALSE(coverage.next());
}

TEST(Coverage, RefusesAFenceThatIsTooLargeByItsKey) {
  try {
    const Coverage coverage({}, kView, box_fence(5000, 5000));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("most_cells"), std::string::npos) << error.what();
  }
}

TEST(Coverage, OfAFenceSmallerThanASquareEnds) {
  Coverage coverage({}, kView, box_fence(0.4, 0.4));
  EXPECT_LE(fly_over(coverage, free_grid(5)), 1);
}

TEST(Column, IsFreeOccupiedUnknownOrOfAMappedObject) {
  auto grid = free_grid(20);
  fill(grid, {4, 4, 0}, {6, 6, 1});
  fill(grid, {-6, -6, 0}, {-4, -4, 2}, occupancy::Cell::unknown);
  const OccupancyView seen{&grid, SE3::Identity()};
  const objects::ObjectMap map = map_of({car(-10, 10)});
  EXPECT_EQ(standing_at({0, 0}, seen, &map), Standing::nothing);
  EXPECT_EQ(standing_at({5, 5}, seen, &map), Standing::something);
  EXPECT_EQ(standing_at({-5, -5}, seen, &map), Standing::unknown);
  EXPECT_EQ(standing_at({-11, 10.5}, seen, &map), Standing::mapped);
  EXPECT_EQ(standing_at({0, 0}, OccupancyView(), &map), Standing::unknown);
}

TEST(Column, StandsOnTheNearestMappedGround) {
  objects::ObjectMap map;
  for (const double x : {0.0, 10.0}) {
    objects::GroundPlane plane;
    plane.point = {x, 0, 0.2 * x};
    map.ground.push_back(plane);
  }
  EXPECT_EQ(ground_height(&map, {2, 1}), 0);
  EXPECT_EQ(ground_height(&map, {9, -3}), 2);
  EXPECT_EQ(ground_height(nullptr, {9, -3}), 0);
}

}  // namespace
}  // namespace saker::active
