#include "saker/motion/free_space.h"

#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::motion {
namespace {

const ClearanceConfig kConfig;
const Geofence kFence{GeofenceConfig{}};
const double kCellDiagonal_m = 0.25 * std::sqrt(3.0);
const double kPlanned_m = kConfig.least_m() + kConfig.planning_slack_m;

FreeSpace space_of(const made::World& world, const Exemption& exemption = {}) {
  return FreeSpace(*world.grid(), kConfig, kFence, exemption);
}

made::World with_wall() {  // its face at x = 5 lies on the lattice
  made::World world({-10, -10, 0}, {10, 10, 10});
  return world.add(made::Box{{5, -10, 0}, {6, 10, 10}});
}

TEST(FreeSpace, MeasuresTheDistanceToAWallExactly) {
  const FreeSpace space = space_of(with_wall());
  for (const double x : {2.7, 3.0, 4.1, 4.33, 4.8})
    EXPECT_NEAR(space.clearance_m({x, 0.1, 5}), 5 - x, 1e-6) << x;
}

TEST(FreeSpace, OverestimatesTheDistanceToAPostByLessThanTheSlack) {
  made::World world({-10, -10, 0}, {10, 10, 10});
  world.add(made::Box{{0, 0, 0}, {0.25, 0.25, 10}});
  const FreeSpace space = space_of(world);
  core::Rng rng(1);
  for (int i = 0; i < 10'000; ++i) {
    const double x = rng.uniform(-2, 2), y = rng.uniform(-2, 2);
    const Eigen::Vector3d p(x, y, rng.uniform(4, 6));
    const double truth = std::min(2.5, world.distance_m(p));
    if (truth < 0.5) continue;  // nearer, it is not free whatever it reads
    EXPECT_LT(space.clearance_m(p) - truth, 0.03);
    EXPECT_GT(space.clearance_m(p) - truth, -0.06);
  }
}

TEST(FreeSpace, EndsAtTheFacesOfTheBlock) {
  const FreeSpace space = space_of(with_wall());
  EXPECT_NEAR(space.clearance_m({-9, 0, 5}), 1, 1e-6);
  EXPECT_EQ(space.clearance_m({-11, 0, 5}), 0);
  EXPECT_FALSE(space.free({50, 50, 50}));
  EXPECT_FALSE(space.free(Eigen::Vector3d::Constant(NAN)));
}

TEST(FreeSpace, IsFreeWhereRadiusMarginAndSlackFit) {
  const FreeSpace space = space_of(with_wall());
  EXPECT_TRUE(space.free({5 - kPlanned_m - 0.01, 0, 5}));
  EXPECT_FALSE(space.free({5 - kPlanned_m + 0.01, 0, 5}));
  EXPECT_TRUE(space.safe({5 - kConfig.least_m() - 0.01, 0, 5}));
  EXPECT_FALSE(space.safe({5 - kConfig.least_m() + 0.01, 0, 5}));
}

TEST(FreeSpace, SeesAPostBetweenTheEndsOfALeg) {
  made::World world({-10, -10, 0}, {10, 10, 10});
  world.add(made::Box{{0, 0, 0}, {0.25, 0.25, 10}});
  const FreeSpace space = space_of(world);
  EXPECT_FALSE(space.free({-5, 0, 5}, {5, 0.5, 5}));
  EXPECT_TRUE(space.free({-5, 2, 5}, {5, 2, 5}));
  EXPECT_FALSE(space.free({-5, 2, 5}, {20, 2, 5})) << "it ends outside";
}

TEST(FreeSpace, TakesTheUnknownForFreeInColumnAndBallOnly) {
  made::World world({-10, -10, 0}, {10, 10, 10});
  world.hide(made::Box{{-10, -10, 0}, {10, 10, 10}});
  const FreeSpace space = space_of(world, {.takeoff = {0, 0, 0}, .vehicle = {6, 0, 5}});
  EXPECT_GT(space.clearance_m({0, 0, 5}), kConfig.takeoff_radius_m - kCellDiagonal_m);
  EXPECT_GT(space.clearance_m({6, 0, 5}), kConfig.vehicle_ball_m - kCellDiagonal_m);
  EXPECT_EQ(space.clearance_m({0, 6, 5}), 0);
  EXPECT_LT(space.clearance_m({0, 0, kConfig.takeoff_height_m}), 0.3) << "over the column";
}

TEST(FreeSpace, DoesNotTakeTheOccupiedForFreeInTheBall) {
  const FreeSpace space = space_of(with_wall(), {.vehicle = {4.2, 0, 5}});
  EXPECT_NEAR(space.clearance_m({4.2, 0, 5}), 0.8, 1e-6);
}

TEST(FreeSpace, LetsTheVehicleStayAsNearAsItIsButNotNearer) {
  const FreeSpace space = space_of(with_wall(), {.vehicle = {4.5, 0, 5}});
  EXPECT_TRUE(space.vehicle_is_clear());
  EXPECT_TRUE(space.free({4.5, 0.5, 5}));
  EXPECT_FALSE(space.free({4.55, 0.5, 5}));
  EXPECT_FALSE(space.free({4.5, 3, 5})) << "outside of its ball";
}

TEST(FreeSpace, KnowsWhenTheVehicleTouchesSomething) {
  EXPECT_FALSE(space_of(with_wall(), {.vehicle = {5.1, 0, 5}}).vehicle_is_clear());
}

TEST(FreeSpace, ComesNoNearerToACellThanItIsWithinTheRadius) {
  const FreeSpace space = space_of(with_wall(), {.vehicle = {4.7, 0, 5}});
  ASSERT_TRUE(space.vehicle_is_clear());
  EXPECT_NEAR(space.clearance_m({4.7, 0, 5}), 0.3, 1e-6);
  EXPECT_TRUE(space.free({4.7, 0, 5}, {4.2, 0, 5})) << "straight away from it";
  EXPECT_FALSE(space.free({4.75, 0, 5}));
  EXPECT_FALSE(space.safe({4.75, 0, 5}));
  EXPECT_FALSE(space.safe({4.7, 0.8, 5})) << "there are other cells, nearer than the radius";
}

TEST(FreeSpace, IsNotFreeNearTheGeofence) {
  GeofenceConfig config;
  config.polygon_m = {-5, -5, 3, -5, 3, 5, -5, 5};
  const Geofence fence(config);
  const FreeSpace space(*with_wall().grid(), kConfig, fence, {});
  EXPECT_TRUE(space.free({3 - kConfig.planning_slack_m - 0.01, 0, 5}));
  EXPECT_FALSE(space.free({3 - kConfig.planning_slack_m + 0.01, 0, 5}));
}

TEST(FreeSpace, CellsAgreeWithTheirCentres) {
  const FreeSpace space = space_of(made::forest(1, 80), {.vehicle = {-17, -17, 3}});
  core::Rng rng(2);
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3i cell(rng.index(160), rng.index(160), rng.index(40));
    EXPECT_EQ(space.cell_free(cell), space.free(space.grid().centre_of(cell)));
  }
}

}  // namespace
}  // namespace saker::motion
