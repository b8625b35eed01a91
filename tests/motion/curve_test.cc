#include "saker/motion/curve.h"

#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::motion {
namespace {

const Geofence kFence{GeofenceConfig{}};

FreeSpace space_of(const made::World& world) {
  return FreeSpace(*world.grid(), {}, kFence, {.vehicle = {0, 0, 5}});
}
made::World block() { return made::World({-20, -20, 0}, {20, 20, 10}); }

double sharpest(const Curve& curve) {
  double most = 0;
  for (const CurvePoint& point : curve) most = std::max(most, point.curvature);
  return most;
}
bool stops(const Curve& curve) {
  return std::any_of(curve.begin(), curve.end(), [](const CurvePoint& p) { return p.stop; });
}

TEST(Curve, OfOneLegIsStraight) {
  const Curve curve = rounded({{0, 0, 5}, {3, 4, 5}}, space_of(block()), 3, 1);
  EXPECT_NEAR(curve.back().s, 5, 1e-9);
  EXPECT_EQ(sharpest(curve), 0);
  EXPECT_TRUE(curve.front().leaving.isApprox(Eigen::Vector3d(0.6, 0.8, 0)));
}

TEST(Curve, RoundsARightAngleByAQuarterCircle) {
  const Curve curve = rounded({{0, 0, 5}, {8, 0, 5}, {8, 8, 5}}, space_of(block()), 3, 1);
  EXPECT_NEAR(curve.back().s, 5 + M_PI / 2 * 3 + 5, 1e-3);
  EXPECT_NEAR(sharpest(curve), 1.0 / 3, 1e-9);
  for (const CurvePoint& p : curve) {
    if (p.curvature == 0) continue;
    EXPECT_NEAR((p.position - Eigen::Vector3d(5, 3, 5)).norm(), 3, 1e-9);
  }
}

TEST(Curve, ItsDirectionIsThatOfItsChords) {
  const Waypoints path{{0, 0, 5}, {8, 0, 5}, {8, 8, 6}, {1, 9, 4}, {0, 0, 5}};
  const Curve curve = rounded(path, space_of(block()), 3, 1);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const Eigen::Vector3d chord = curve[i].position - curve[i - 1].position;
    EXPECT_GT(chord.normalized().dot(curve[i - 1].leaving), 0.998);
    EXPECT_GT(chord.normalized().dot(curve[i].arriving), 0.998);
    EXPECT_LE(chord.norm(), 0.05 + 1e-9);
    EXPECT_NEAR(curve[i].s - curve[i - 1].s, chord.norm(), 1e-12);
  }
}

TEST(Curve, CutsACornerLessWhereAnObstacleIsInIt) {
  made::World world = block();
  world.add(made::Box{{-20, 1.5, 0}, {6, 20, 10}});
  const FreeSpace space = space_of(world);
  const Curve curve = rounded({{0, 0, 5}, {8, 0, 5}, {8, 8, 5}}, space, 6, 1);
  EXPECT_FALSE(stops(curve));
  EXPECT_GT(sharpest(curve), 1.0 / 6);
  for (const CurvePoint& p : curve) EXPECT_TRUE(space.free(p.position));
}

TEST(Curve, StopsWhereItTurnsBack) {
  const Curve curve = rounded({{0, 0, 5}, {8, 0, 5}, {0, 0.1, 5}}, space_of(block()), 3, 1);
  EXPECT_TRUE(stops(curve));
}

TEST(Curve, GivesTheFirstCornerOnlyItsShare) {
  const Waypoints path{{0, 0, 5}, {8, 0, 5}, {8, 8, 5}};
  EXPECT_NEAR(sharpest(rounded(path, space_of(block()), 3, 0.5)), 1 / 1.5, 1e-9);
  EXPECT_TRUE(stops(rounded(path, space_of(block()), 3, 0)));
}

TEST(Curve, LeavesATinyCornerAsItIs) {
  const Curve curve = rounded({{0, 0, 5}, {5, 0, 5}, {10, 0.1, 5}}, space_of(block()), 3, 1);
  EXPECT_FALSE(stops(curve));
  EXPECT_EQ(sharpest(curve), 0);
}

TEST(Curve, OfOnePlaceIsOnePoint) {
  const Curve curve = rounded({{1, 2, 3}, {1, 2, 3}}, space_of(block()), 3, 1);
  ASSERT_EQ(curve.size(), 1U);
  EXPECT_EQ(curve.front().position, Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace saker::motion
