#include "saker/simulation/mission/takeoff.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/error.h"
#include "saker/simulation/mission/mission_world.h"
#include "saker/simulation/vehicle/collision.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"

namespace saker::simulation {
namespace {

constexpr std::uint64_t kSeed = 3;

TakeoffPlace at(double x, double y) { return {.x_m = x, .y_m = y, .yaw_deg = 30, .within_m = 8}; }

TEST(Takeoff, RobotsOfATeamStandInOneWorldWithOnePrior) {
  const MissionWorld a = build_mission_world({}, kSeed, at(-4, 0));
  const MissionWorld b = build_mission_world({}, kSeed, at(6, 0));
  EXPECT_TRUE(a.T_sim_base.isApprox(b.T_sim_base, 0));
  EXPECT_EQ(a.targets, b.targets);
  ASSERT_EQ(a.prior.objects.size(), b.prior.objects.size());
  for (std::size_t i = 0; i < a.prior.objects.size(); ++i) {
    EXPECT_EQ(objects::place(a.prior.objects[i].model), objects::place(b.prior.objects[i].model));
  }
  EXPECT_GT((a.T_sim_world.translation() - b.T_sim_world.translation()).norm(), 1);
}

TEST(Takeoff, IsNearWhereItWasAskedForOnFreeGround) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MissionWorld site = build_mission_world({}, seed, at(5, 1));
    const SE3 T_base_world = site.T_sim_base.inverse() * site.T_sim_world;
    EXPECT_LE((T_base_world.translation().head<2>() - Eigen::Vector2d(5, 1)).norm(), 8);
    EXPECT_NEAR(core::yaw(T_base_world.linear()), 30 * std::numbers::pi / 180, 1e-9);
    const RayCaster caster(site.world());
    const Eigen::Vector3f over = (site.T_sim_world * Eigen::Vector3d(0, 0, 1)).cast<float>();
    EXPECT_FALSE(caster.nearest(over, 1.8F, ground_materials(site.world())));
  }
}

TEST(Takeoff, WhereNothingIsFreeIsAnError) {
  // Far outside there is no ground at all.
  EXPECT_THROW((void)build_mission_world({}, kSeed, at(900, 900)), Error);
}

TEST(Takeoff, AVehicleOfATeamStandsWhereItWasPut) {
  SimulatedVehicle vehicle({}, kSeed, at(6, 0), 1);
  vehicle.step_to(vehicle.now() + from_seconds(0.2));
  EXPECT_NEAR(vehicle.truth().T_world_body.translation().norm(), 0, 0.1);
  EXPECT_FALSE(vehicle.truth().airborne);
}

}  // namespace
}  // namespace saker::simulation
