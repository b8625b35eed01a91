#include "saker/slam/sight.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_world.h"
#include "saker/slam/slam.h"

namespace saker::slam {
namespace {

using namespace made;

TEST(Sight, IsHiddenByACuboidBetweenAlone) {
  const Cuboid turned = car(10, 0, 0.6);
  const Eigen::Vector3d eye(0, 0, 1);
  EXPECT_TRUE(between(turned, eye, {20, 0, 0.75}));
  EXPECT_FALSE(between(turned, eye, {7, 0, 0.75})) << "it stands behind";
  EXPECT_FALSE(between(turned, eye, {-20, 0, 0.75})) << "it stands on the other side";
  EXPECT_FALSE(between(turned, eye, {20, 8, 0.75})) << "it stands beside";
  EXPECT_FALSE(between(turned, {0, 0, 6}, {20, 0, 0.75})) << "one looks over it";
  EXPECT_FALSE(between(turned, eye, {10, 0, 0.75})) << "of what is in it, it hides nothing";
  EXPECT_FALSE(between(turned, {10, 0, 0.75}, {20, 0, 0.75})) << "one looks out of it";
}

TEST(Sight, AlongAFaceIsDecidedByWhichSideOfItOneLooks) {
  const Cuboid straight = car(10, 0, 0);
  EXPECT_TRUE(between(straight, {0, 0.89, 1}, {20, 0.89, 1}));
  EXPECT_FALSE(between(straight, {0, 0.91, 1}, {20, 0.91, 1}));
}

Landmark measured_at_20_m(const Model& model) {
  Landmark landmark;
  landmark.model = model;
  landmark.nearest = landmark.farthest = 21;
  return landmark;
}

TEST(Sight, OfAPoleBehindAVehicleOneSeesTheUpperPart) {
  const std::vector<Cuboid> cars = {car(17, 0, 1.57)};
  const Eigen::Vector3d eye(0, 0, 2.5);
  EXPECT_TRUE(in_view(measured_at_20_m(trunk(20, 0)), eye, cars, {}));
  EXPECT_FALSE(in_view(measured_at_20_m(car(20, 0, 1.57)), eye, cars, {}));
}

TEST(Sight, WhatIsNotBelievedHidesNothing) {
  Landmark landmark = measured_at_20_m(car(10, 0, 0));
  EXPECT_TRUE(believed_cuboids({&landmark, 1}, {}).empty());
}

/// Whether a car that was measured from aside is in the map after it was not measured from where
/// another one, if there is one, stands before it.
bool stays(bool another_before_it) {
  std::vector<TrueObject> world = {{car(20, 0, 0), kVehicle}};
  if (another_before_it) world.push_back({car(10, 0, 1.57), kVehicle});
  Robot robot(world, {}, 1);
  robot.range = 30;
  Slam slam({}, {});
  double seconds = 0;
  const auto look = [&](const SE3& from, int windows, bool sees_it) {
    for (int i = 0; i < windows; ++i) {
      SlamInput input = robot.step(seconds += 0.5, from);
      auto& all = input.detections.measurements;
      if (!sees_it) all.erase(all.begin());
      if (all.empty()) all.push_back(robot.measure({trunk(5, 10), kTrunk}, input.stamp));
      (void)slam.update(input, core::Budget::iterations(5));
    }
  };
  look(flat_pose(0, 10, 1, 0), 10, true);
  look(flat_pose(0, 0, 1, 0), 40, false);
  const auto map = slam.map();
  return std::ranges::any_of(map.objects, [](const objects::MapObject& object) {
    return (objects::place(object.model) - Eigen::Vector3d(20, -10, -0.25)).norm() < 1;
  });
}

TEST(Sight, WhatAnotherHidesStaysInTheMapWhatIsNotThereDoesNot) {
  EXPECT_TRUE(stays(true));
  EXPECT_FALSE(stays(false));
}

}  // namespace
}  // namespace saker::slam
