#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::slam {
namespace {

using namespace made;

const core::Budget kPlenty = core::Budget::iterations(20);
constexpr double kStep = 0.5;  // s between windows

/// The robot stands and looks; vehicles[i] is at `at(i, seconds)`. \return the map at the end.
template <class At>
objects::ObjectMap watch(int windows, bool flagged, const At& at) {
  Slam slam(honest_config(), {});
  Robot robot({{car(0, 0, 0), kVehicle}}, {}, 8);
  for (int i = 0; i < windows; ++i) {
    robot.world()[0].model = at(kStep * i);
    SlamInput input = robot.step(kStep * (i + 1), flat_pose(0, -8, 1.5, 0));
    for (auto& m : input.detections.measurements) m.moving = flagged;
    (void)slam.update(input, kPlenty);
  }
  return slam.map();
}

TEST(Moving, WhatDetectionSawMoveNeverEntersTheMap) {
  EXPECT_TRUE(watch(10, true, [](double) { return car(0, 0, 0); }).objects.empty());
}

TEST(Moving, AVehicleThatPassesByLeavesNothing) {
  for (const double speed : {1.5, 3.0, 5.0, 8.0}) {
    EXPECT_TRUE(
        watch(12, false, [&](double t) { return car(-12 + speed * t, 0, 0); }).objects.empty())
        << speed;
  }
}

TEST(Moving, AParkedOneStays) {
  EXPECT_EQ(watch(12, false, [](double) { return car(0, 0, 0); }).objects.size(), 1U);
}

TEST(Moving, WhatWasSeenOnlyOnceInALongLookIsNotBelieved) {
  Slam slam(honest_config(), {});
  Robot robot({{car(0, 0, 0), kVehicle}, {trunk(2, -4), kTrunk}}, {}, 8);
  for (int i = 0; i < 40; ++i) {
    robot.world()[0].model = car(i % 8 == 0 ? 0 : 100, 0, 0);  // one window in eight
    (void)slam.update(robot.step(kStep * (i + 1), flat_pose(0, -8 - 0.1 * (i % 3), 1.5, 0)),
                      kPlenty);
  }
  ASSERT_EQ(slam.map().objects.size(), 1U);
  EXPECT_FALSE(is_cuboid(slam.map().objects[0].model));
}

TEST(Moving, VehicleSplitInTwoAtFirstBecomesOne) {
  Slam slam(honest_config(), {});
  Robot robot({{car(0, 0, 0), kVehicle}}, {}, 8);
  for (int i = 0; i < 20; ++i) {
    robot.world() = {{car(0, 0, 0), kVehicle}};
    if (i < 4) robot.world() = {{car(-1.5, 0, 0, 1.4), kVehicle}, {car(1.5, 0, 0, 1.4), kVehicle}};
    (void)slam.update(robot.step(kStep * (i + 1), flat_pose(0, -8, 1.5, 0)), kPlenty);
  }
  ASSERT_EQ(slam.map().objects.size(), 1U);
  const auto& vehicle = std::get<Cuboid>(slam.map().objects[0].model);
  EXPECT_NEAR(vehicle.size.x(), 4.4, 0.4);
  EXPECT_NEAR(vehicle.pose.translation().x(), 0, 0.4);
}

}  // namespace
}  // namespace saker::slam
