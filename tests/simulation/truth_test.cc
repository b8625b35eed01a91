#include "saker/simulation/mission/truth.h"

#include <gtest/gtest.h>

#include <sstream>

#include "drawn.h"
#include "saker/objects/class_table.h"

namespace saker::simulation {
namespace {

TEST(Levelled, KeepsPlaceAndHeadingAndStandsUpright) {
  core::Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    SE3 T = placed(rng.normal(), rng.normal(), rng.normal(), rng.uniform(-3, 3));
    T.linear() = T.linear() * core::so3_exp({rng.normal(0, 0.2), rng.normal(0, 0.2), 0});
    const SE3 level = levelled(T);
    EXPECT_EQ(level.translation(), T.translation());
    EXPECT_NEAR(level.linear()(2, 2), 1, 1e-12);
    EXPECT_NEAR(std::remainder(core::yaw(level.linear()) - core::yaw(T.linear()), 2 * M_PI), 0,
                1e-9);
  }
}

TEST(Levelled, WhatIsLevelStaysAsItIs) {
  const SE3 T = placed(1, 2, 3, 0.7);
  EXPECT_TRUE(levelled(T).isApprox(T, 1e-12));
}

TEST(TumRow, HoldsTimePlaceAndAUnitQuaternion) {
  std::istringstream row(tum_row(from_seconds(12.5), placed(1, -2, 3.25, 0.5)));
  double t = 0, x = 0, y = 0, z = 0;
  Eigen::Quaterniond q;
  row >> t >> x >> y >> z >> q.x() >> q.y() >> q.z() >> q.w();
  ASSERT_TRUE(row);
  EXPECT_DOUBLE_EQ(t, 12.5);
  EXPECT_EQ(Eigen::Vector3d(x, y, z), Eigen::Vector3d(1, -2, 3.25));
  EXPECT_NEAR(q.norm(), 1, 1e-6);
  EXPECT_NEAR(core::yaw(q.toRotationMatrix()), 0.5, 1e-6);
}

TEST(TumRow, EndsWithTheLine) {
  const std::string row = tum_row(0, SE3::Identity());
  EXPECT_EQ(row.back(), '\n');
  EXPECT_EQ(std::count(row.begin(), row.end(), ' '), 7);
}

/// A car, a car that drives, a trunk and a pole.
World world_of_four() {
  World world;
  objects::Cuboid car;
  car.pose = placed(10, 0, 0.75);
  car.size = {4.5, 1.8, 1.5};
  objects::Cylinder stem;
  stem.root = {0, 5, 0};
  stem.axis = Eigen::Vector3d::UnitZ();
  stem.radius = 0.2;
  stem.height = 3;
  world.add({"vehicle", "sedan", car});
  world.add({"vehicle", "sedan", car, true});
  world.add({"trunk", "broadleaf", stem});
  world.add({"pole", "lamp", stem});
  return world;
}

TEST(TruthMap, HoldsEverythingButWhatMoves) {
  const World world = world_of_four();
  const objects::ObjectMap map = truth_map(world, SE3::Identity(), {0, 1, 2, 3, 4});
  ASSERT_EQ(map.objects.size(), 3U);
  EXPECT_EQ(map.objects[0].id, 1);
  EXPECT_EQ(map.objects[1].id, 3);
  EXPECT_EQ(map.objects[2].id, 4);
}

TEST(TruthMap, CountsTheReturnsOfEachObject) {
  const objects::ObjectMap map = truth_map(world_of_four(), SE3::Identity(), {0, 11, 12, 13, 14});
  EXPECT_EQ(map.objects[0].points, 11);
  EXPECT_EQ(map.objects[1].points, 13);
  EXPECT_EQ(map.objects[2].points, 14);
}

TEST(TruthMap, IsSeenFromTheWorldsFrame) {
  const SE3 T_world_sim = placed(1, 2, 3, M_PI / 2);
  const objects::ObjectMap map = truth_map(world_of_four(), T_world_sim, {0, 0, 0, 0, 0});
  const Eigen::Vector3d place = objects::place(map.objects[0].model);
  EXPECT_LT((place - T_world_sim * Eigen::Vector3d(10, 0, 0.75)).norm(), 1e-9);
}

TEST(TruthMap, IsCertainOfEachClass) {
  const objects::ClassTable table;
  for (const auto& object : truth_map(world_of_four(), SE3::Identity(), {0, 0, 0, 0, 0}).objects) {
    double sum = 0;
    for (const double p : object.class_probability) sum += p;
    EXPECT_EQ(sum, 1);
    EXPECT_EQ(object.class_probability[object.class_id], 1);
  }
}

/// Of a trunk's object the crown's returns do not count.
TEST(CountHits, CountsTheReturnsThatTheModelDescribes) {
  const World world = world_of_four();
  CastScan scan;
  scan.rows = 1;
  scan.columns = 6;
  scan.objects = {1, 1, 3, 3, 4, 0};
  scan.labels = {kCar, kCar, kTrunk, kVegetation, kPole, kRoad};
  scan.range_m = {5, 0, 6, 7, 8, 9};  // the second beam is lost
  std::vector<int> hits(5, 0);
  count_hits(world, scan, hits);
  EXPECT_EQ(hits, (std::vector<int>{0, 1, 0, 1, 1}));
}

TEST(CountHits, AddsToWhatWasCountedBefore) {
  const World world = world_of_four();
  CastScan scan;
  scan.rows = scan.columns = 1;
  scan.objects = {4};
  scan.labels = {kPole};
  scan.range_m = {5};
  std::vector<int> hits(5, 10);
  count_hits(world, scan, hits);
  EXPECT_EQ(hits[4], 11);
  EXPECT_EQ(hits[1], 10);
}

}  // namespace
}  // namespace saker::simulation
