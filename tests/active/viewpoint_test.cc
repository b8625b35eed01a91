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
