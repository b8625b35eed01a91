#include "saker/motion/trajectory_check.h"

#include <gtest/gtest.h>

#include "made_world.h"

namespace saker::motion {
namespace {

const MotionConfig kConfig;
const MotionPlanner kPlanner{kConfig};
const Eigen::Vector3d kStart(-8, 0, 3), kGoal(8, 0, 3);

made::World block() { return made::World({-20, -20, 0}, {20, 20, 10}); }

Trajectory flight() {
  return kPlanner.plan(made::request(block(), made::resting_at(kStart), kGoal), made::ample())
      .trajectory;
}

TrajectoryCheck examined_in(const made::World& world, const Trajectory& trajectory) {
  const FreeSpace space(*world.grid(), kConfig.clearance, kPlanner.geofence(), {});
  return examined(trajectory, space, kConfig.limits);
}

TEST(TrajectoryCheck, AcceptsWhatThePlannerMadeAndTellsItsClearance) {
  made::World world = block();
  world.add(made::Box{{0, 1.5, 0}, {1, 4, 10}});
  const TrajectoryCheck check = examined_in(world, flight());
  EXPECT_EQ(check.fault, "");
  EXPECT_NEAR(check.clearance_m, 1.5, 0.03);
}

TEST(TrajectoryCheck, RefusesOneThatPassesTooNear) {
  made::World world = block();
  world.add(made::Box{{0, 0.5, 0}, {0.25, 0.75, 10}});
  EXPECT_NE(examined_in(world, flight()).fault.find("too near"), std::string::npos);
}

TEST(TrajectoryCheck, RefusesEveryKindOfExcess) {
  const auto fault_with = [](auto change) {
    Trajectory bad = flight();
    change(bad.states[bad.states.size() / 2]);
    return examined_in(block(), bad).fault;
  };
  EXPECT_NE(fault_with([](auto& s) { s.velocity.x() = 3; }), "");
  EXPECT_NE(fault_with([](auto& s) { s.velocity.z() = 1.2; }), "");
  EXPECT_NE(fault_with([](auto& s) { s.acceleration.y() = 2.5; }), "");
  EXPECT_NE(fault_with([](auto& s) { s.yaw_rate = 2; }), "");
  EXPECT_NE(fault_with([](auto& s) { s.position.x() = NAN; }), "");
  EXPECT_NE(fault_with([](auto& s) { s.velocity.x() = NAN; }), "");
  EXPECT_EQ(fault_with([](auto&) {}), "");
}

TEST(TrajectoryCheck, RefusesOneThatDoesNotEndAtRest) {
  Trajectory cut = flight();
  cut.states.resize(cut.states.size() / 2);
  EXPECT_NE(examined_in(block(), cut).fault.find("not at rest"), std::string::npos);
}

TEST(TrajectoryCheck, RefusesAnEmptyOne) {
  EXPECT_NE(examined_in(block(), Trajectory{}).fault, "");
}

}  // namespace
}  // namespace saker::motion
