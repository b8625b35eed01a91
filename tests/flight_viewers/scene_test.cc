#include <gtest/gtest.h>

#include "flight/viewers/foxglove_parts.h"
#include "flight_viewers/made_robot.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

/// The entity of that id of a scene; null where there is none.
Json entity_of(RobotView& view, const std::string& id) {
  const Json scene = *view.message(Topic::scene, 1);
  for (const Json& entity : scene["entities"]) {
    if (entity["id"] == id) return entity;
  }
  return {};
}

Eigen::Vector3d vector(const Json& json) {
  return {json["x"].get<double>(), json["y"].get<double>(), json["z"].get<double>()};
}

TEST(Scene, AVehicleIsACuboidOfItsSizeWithItsFrontMarked) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(3, 10, 2)}), 1);  // its x is the map's y
  const Json entity = entity_of(view, "objects/3");
  EXPECT_EQ(entity["frame_id"], "R1/world");
  ASSERT_EQ(entity["cubes"].size(), 1u);
  EXPECT_TRUE(vector(entity["cubes"][0]["size"]).isApprox(Eigen::Vector3d(4, 2, 1.5), 1e-6));
  EXPECT_TRUE(
      vector(entity["cubes"][0]["pose"]["position"]).isApprox(Eigen::Vector3d(10, 2, 0.75), 1e-6));
  EXPECT_TRUE(
      vector(entity["arrows"][0]["pose"]["position"]).isApprox(Eigen::Vector3d(10, 4, 0.75), 1e-5));
}

TEST(Scene, APoleIsACylinderAboutItsMiddle) {
  RobotView view = made_view();
  view.hear(made_objects({made_pole(5, 1, 2)}), 1);
  const Json cylinder = entity_of(view, "objects/5")["cylinders"][0];
  EXPECT_TRUE(vector(cylinder["pose"]["position"]).isApprox(Eigen::Vector3d(1, 2, 3), 1e-6));
  EXPECT_TRUE(vector(cylinder["size"]).isApprox(Eigen::Vector3d(0.2, 0.2, 6), 1e-6));
}

TEST(Scene, APoleThatLeansLeansInTheScene) {
  objects::MapObject pole = made_pole(5, 0, 0);
  auto& cylinder = std::get<objects::Cylinder>(pole.model);
  cylinder.axis = Eigen::Vector3d(0.6, 0, 0.8);
  RobotView view = made_view();
  view.set_map({.objects = {pole}, .ground = {}}, 1, 1);
  const Json pose = entity_of(view, "objects/5")["cylinders"][0]["pose"];
  EXPECT_TRUE(vector(pose["position"]).isApprox(Eigen::Vector3d(1.8, 0, 2.4), 1e-6));
  const Json& q = pose["orientation"];
  const Eigen::Quaterniond turn(q["w"].get<double>(), q["x"].get<double>(), q["y"].get<double>(),
                                q["z"].get<double>());
  EXPECT_TRUE((turn * Eigen::Vector3d::UnitZ()).isApprox(cylinder.axis, 1e-5));
}

TEST(Scene, WithoutDeviationsThereIsNoEllipse) {
  RobotView view = made_view();
  view.hear(made_objects({made_pole(5, 1, 2)}), 1);
  EXPECT_TRUE(entity_of(view, "objects/5")["lines"].empty());
}

TEST(Scene, WhatHasNoSizeIsNotDrawn) {
  objects::MapObject vehicle = made_vehicle(3, 10, 2);
  std::get<objects::Cuboid>(vehicle.model).size.z() = NAN;
  RobotView view = made_view();
  view.set_map({.objects = {vehicle, made_pole(5, 0, 0)}, .ground = {}}, 1, 1);
  EXPECT_TRUE(entity_of(view, "objects/3").is_null());
  EXPECT_FALSE(entity_of(view, "objects/5").is_null());
}

TEST(Scene, TheGeofenceIsItsPolygonBelowAndAbove) {
  auto site = made_site();
  site->geofence.lowest_m = 1;
  site->geofence.highest_m = 12;
  RobotView view = made_view(site);
  view.hear(made_odometry(1, 0, 0), 1);
  const Json lines = entity_of(view, "geofence")["lines"];
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["type"], 1);  // a loop
  EXPECT_EQ(lines[0]["points"].size(), 4u);
  EXPECT_TRUE(vector(lines[1]["points"][2]).isApprox(Eigen::Vector3d(5, 5, 12), 1e-6));
}

TEST(Scene, ThePathIsDrawnFromItsSecondPointOn) {
  RobotView view = made_view();
  view.hear(made_odometry(1, 0, 0), 1);
  EXPECT_TRUE(entity_of(view, "path")["lines"].empty());
  view.hear(made_odometry(2, 1, 0), 1);
  const Json line = entity_of(view, "path")["lines"][0];
  EXPECT_EQ(line["points"].size(), 2u);
  EXPECT_EQ(line["type"], 0);  // a strip
}

TEST(Scene, TheCommittedWayIsThinned) {
  RobotView view = made_view();
  view.hear(made_odometry(1, 0, 0), 1);
  view.hear(made_trajectory(1, 1000), 1);
  const std::size_t points = entity_of(view, "trajectory")["lines"][0]["points"].size();
  EXPECT_GE(points, 100u);
  EXPECT_LE(points, 400u);
}

TEST(Scene, OfViewpointsTheChosenOneIsSolid) {
  RobotView view = made_view();
  plan_t plan = made_plan({4, 7}, 1);
  plan.candidates[1].yaw = NAN;  // no place to stand
  plan.candidates.push_back(plan.candidates[0]);
  plan.choice = 2;
  view.hear(plan, 1);
  const Json arrows = entity_of(view, "viewpoints")["arrows"];
  ASSERT_EQ(arrows.size(), 2u);
  EXPECT_LT(arrows[0]["color"]["a"].get<double>(), 1);
  EXPECT_EQ(arrows[1]["color"]["a"], 1);
}

TEST(Scene, RefusedViewpointsAreNotDrawn) {
  RobotView view = made_view();
  plan_t plan = made_plan({4, 7}, 1);
  plan.candidates[1].gain = -4;
  view.hear(plan, 1);
  EXPECT_EQ(entity_of(view, "viewpoints")["arrows"].size(), 1u);
}

TEST(Scene, EveryEntityIsInAFrameOfItsRobot) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(3, 10, 2)}), 1);
  view.hear(made_odometry(1, 0, 0), 1);
  const Json scene = *view.message(Topic::scene, 1);
  for (const Json& entity : scene["entities"])
    EXPECT_TRUE(entity["frame_id"].get<std::string>().starts_with("R1/")) << entity["id"];
}

TEST(Scene, AnObjectIsDeletedOnce) {
  RobotView view = made_view();
  view.set_map({.objects = {made_vehicle(3, 0, 0)}, .ground = {}}, 1, 1);
  static_cast<void>(view.message(Topic::scene, 1));
  view.set_map({}, 2, 2);
  EXPECT_EQ((*view.message(Topic::scene, 2))["deletions"].size(), 1u);
  EXPECT_EQ((*view.message(Topic::scene, 3))["deletions"].size(), 0u);
}

TEST(Transforms, AreAChainFromTheMapToTheLidar) {
  auto site = made_site();
  site->T_body_lidar.translation() << 0, 0, 0.2;
  RobotView view = made_view(site);
  EXPECT_EQ(view.message(Topic::transforms, 1), std::nullopt);
  view.hear(made_odometry(1, 4, 5), 1);
  const Json list = (*view.message(Topic::transforms, 1.5))["transforms"];
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[0]["parent_frame_id"], "map");
  for (std::size_t i = 1; i < list.size(); ++i)
    EXPECT_EQ(list[i]["parent_frame_id"], list[i - 1]["child_frame_id"]);
  EXPECT_EQ(list[3]["child_frame_id"], "R1/lidar");
  EXPECT_TRUE(vector(list[2]["translation"]).isApprox(Eigen::Vector3d(4, 5, 3), 1e-6));
  EXPECT_TRUE(vector(list[3]["translation"]).isApprox(Eigen::Vector3d(0, 0, 0.2), 1e-6));
  EXPECT_EQ(list[2]["timestamp"], Json({{"sec", 1}, {"nsec", 500000000}}));
}

TEST(FoxgloveParts, ATimeThatIsNoneIsZero) {
  const Json zero = {{"sec", 0}, {"nsec", 0}};
  for (const double t : {0.0, -1.0, double{NAN}, double{INFINITY}, 1e300})
    EXPECT_EQ(time_json(t), zero) << t;
  EXPECT_EQ(time_json(4294967294.5), Json({{"sec", 4294967294}, {"nsec", 500000000}}));
}

TEST(FoxgloveParts, AColourIsSharesOf255) {
  EXPECT_EQ(colour_json({255, 0, 51}, 0.5), Json({{"r", 1.0}, {"g", 0.0}, {"b", 0.2}, {"a", 0.5}}));
}

}  // namespace
}  // namespace saker::flight::viewers
