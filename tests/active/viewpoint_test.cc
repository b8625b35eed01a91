#include "saker/active/views/viewpoint.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "made_street.h"

namespace saker::active {
namespace {

using namespace made;
using std::numbers::pi;

const FieldOfViewConfig kView;
const ViewpointConfig kConfig;
const InGeofence kEverywhere = [](const Eigen::Vector3d&) { return true; };

TEST(OccupancyView, AreUnknownWithoutABlock) {
  const OccupancyView nothing;
  EXPECT_EQ(nothing.at({0, 0, 0}), occupancy::Cell::unknown);
  EXPECT_FALSE(nothing.blocked({0, 0, 0}, 5));
  EXPECT_EQ(visible_share({9, 0, 3}, car(0, 0), nothing, 0.5), 1);
}

TEST(OccupancyView, BlockWithinTheClearanceOnly) {
  auto grid = free_grid();
  fill(grid, {10, -5, 0}, {10.5, 5, 6});  // centres at x = 10.25
  const OccupancyView block{&grid, SE3::Identity()};
  EXPECT_TRUE(block.blocked({9.5, 0.25, 3.25}, 0.9));
  EXPECT_FALSE(block.blocked({9.2, 0.25, 3.25}, 0.9));
  EXPECT_FALSE(block.blocked({100, 0, 3}, 0.9)) << "outside the block";
}

TEST(OccupancyView, MoveWithTheCorrectionBetweenWorldAndOdom) {
  auto grid = free_grid();
  fill(grid, {10, -5, 0}, {10.5, 5, 6});
  const SE3 T_odom_world(Eigen::Translation3d(5, 0, 0));
  const OccupancyView block{&grid, T_odom_world};
  EXPECT_TRUE(block.blocked({5.2, 0, 3}, 0.9));
  EXPECT_FALSE(block.blocked({10.2, 0, 3}, 0.9));
  EXPECT_EQ(block.at({5.2, 0, 3}), occupancy::Cell::occupied);
}

TEST(Visibility, OfATargetInTheOpenIsWholeThoughItsOwnCellsAreOccupied) {
  auto grid = free_grid();
  fill(grid, {-2.2, -0.9, 0}, {2.2, 0.9, 1.5});
  fill(grid, {-30, -30, -1}, {30, 30, 0});  // the ground
  const OccupancyView block{&grid, SE3::Identity()};
  for (double bearing = 0; bearing < 6; bearing += 0.5) {
    const Eigen::Vector3d eye(9 * std::cos(bearing), 9 * std::sin(bearing), 3);
    EXPECT_EQ(visible_share(eye, car(0, 0), block, 0.5), 1) << bearing;
  }
}

TEST(Visibility, EndsBehindAWall) {
  auto grid = free_grid();
  fill(grid, {4, -10, 0}, {4.5, 10, 4});
  const OccupancyView block{&grid, SE3::Identity()};
  EXPECT_EQ(visible_share({9, 0, 3}, car(0, 0), block, 0.5), 0);
  EXPECT_EQ(visible_share({-9, 0, 3}, car(0, 0), block, 0.5), 1);
}

TEST(Visibility, IsPartialBehindHalfAWall) {
  auto grid = free_grid();
  fill(grid, {-10, 4, 0}, {0, 4.5, 4});
  const OccupancyView block{&grid, SE3::Identity()};
  const double share = visible_share({0.3, 9, 3}, car(0, 0), block, 0.5);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.8);
}

TEST(Visibility, IsNotTakenAwayByWhatWasNeverSeen) {
  auto grid = free_grid();
  fill(grid, {-30, -30, -1}, {30, 30, 7}, occupancy::Cell::unknown);
  EXPECT_EQ(visible_share({9, 0, 3}, car(0, 0), {&grid, SE3::Identity()}, 0.5), 1);
}

TEST(Candidates, StandAroundTheTargetAndLookAtIt) {
  const objects::Cuboid target = car(3, -2, 0.4);
  const auto candidates = sample_viewpoints(target, 100, kConfig, kView, {}, kEverywhere);
  ASSERT_EQ(candidates.size(), static_cast<std::size_t>(kConfig.bearings * kConfig.rings));
  std::set<int> ids;
  for (const ViewpointCandidate& candidate : candidates) {
    const Viewpoint& viewpoint = candidate.viewpoint;
    ids.insert(viewpoint.id);
    EXPECT_NEAR(viewpoint.position.z(), kConfig.height_m, 1e-9);
    const Eigen::Vector2d ahead(std::cos(viewpoint.yaw), std::sin(viewpoint.yaw));
    const Eigen::Vector2d to_target = (Eigen::Vector3d(3, -2, 0) - viewpoint.position).head<2>();
    EXPECT_NEAR(ahead.dot(to_target.normalized()), 1, 1e-9);
  }
  EXPECT_EQ(ids.size(), candidates.size());
  EXPECT_EQ(*ids.begin(), 100);
}

TEST(Candidates, OfTheFirstRingAreTheNearestThatHaveTheTargetInView) {
  const objects::Cuboid target = car(0, 0);
  const auto candidates = sample_viewpoints(target, 0, kConfig, kView, {}, kEverywhere);
  for (std::size_t i = 0; i < candidates.size(); i += kConfig.rings) {
    EXPECT_EQ(candidates[i].refusal, Refusal::none);
    const Eigen::Vector3d& eye = candidates[i].viewpoint.position;
    EXPECT_TRUE(in_field_of_view(eye, 0, target, kView, kView.margin_deg));
    const Eigen::Vector3d nearer = eye - 0.3 * Eigen::Vector3d(eye.x(), eye.y(), 0).normalized();
    EXPECT_FALSE(in_field_of_view(nearer, 0, target, kView, kView.margin_deg));
  }
}

TEST(Candidates, RiseOverTheFloorOfTheGeofence) {
  const InGeofence high = [](const Eigen::Vector3d& p) { return p.z() > 3.6 && p.y() > 0.1; };
  const objects::Cuboid target = car(0, 0);
  const auto candidates = sample_viewpoints(target, 0, kConfig, kView, {}, high);
  for (std::size_t i = 0; i < candidates.size(); i += kConfig.rings) {
    const ViewpointCandidate& it = candidates[i];
    const Eigen::Vector3d& eye = it.viewpoint.position;
    if (eye.y() < 0.1) {
      EXPECT_EQ(it.refusal, Refusal::outside_geofence);
      continue;
    }
    EXPECT_EQ(it.refusal, Refusal::none);
    EXPECT_GE(eye.z(), 4.1);
    EXPECT_LE(eye.z(), 4.4);
    EXPECT_TRUE(in_field_of_view(eye, it.viewpoint.yaw, target, kView, kView.margin_deg));
  }
}

TEST(Candidates, StayAtTheirHeightWhereTheFenceHoldsIt) {
  const InGeofence low = [](const Eigen::Vector3d& p) { return p.z() < 3.2; };
  for (const ViewpointCandidate& it : sample_viewpoints(car(0, 0), 0, kConfig, kView, {}, low)) {
    EXPECT_NEAR(it.viewpoint.position.z(), kConfig.height_m, 1e-9);
  }
}

TEST(Candidates, EachHasTheReasonOfItsRefusal) {
  auto grid = free_grid();
  fill(grid, {4, -10, 0}, {4.5, 10, 6});
  const OccupancyView block{&grid, SE3::Identity()};
  const InGeofence north = [](const Eigen::Vector3d& p) { return p.y() > -5; };
  const auto refusal = [&](double x, double y) {
    Viewpoint viewpoint;
    viewpoint.position = {x, y, 3};
    viewpoint.yaw = 0;
    return refusal_of(viewpoint, car(0, 0), kConfig, kView, block, north);
  };
  EXPECT_EQ(refusal(0, 9.5), Refusal::none);
  EXPECT_EQ(refusal(0, 20), Refusal::out_of_view);
  EXPECT_EQ(refusal(0, -9.5), Refusal::outside_geofence);
  EXPECT_EQ(refusal(3.9, 9), Refusal::occupied);
  EXPECT_EQ(refusal(12, 0), Refusal::hidden);
}

TEST(Candidates, AreKnownFreeOnlyWhereTheBlockSaysSo) {
  auto grid = free_grid(9.3, 0.3);
  const auto candidates =
      sample_viewpoints(car(0, 0), 0, kConfig, kView, {&grid, SE3::Identity()}, kEverywhere);
  int known = 0;
  for (const ViewpointCandidate& candidate : candidates) {
    const Eigen::Vector3d& p = candidate.viewpoint.position;
    EXPECT_EQ(candidate.known_free, p.head<2>().cwiseAbs().maxCoeff() < 9.3);
    known += candidate.known_free;
  }
  EXPECT_GT(known, 0);
  EXPECT_LT(known, static_cast<int>(candidates.size()));
}

}  // namespace
}  // namespace saker::active
