#include <gtest/gtest.h>

#include "made_vehicle.h"

namespace saker::simulation {
namespace {

using enum VehicleMode;

TEST(FlightCommands, ArmingWithoutOdometryIsRefusedWithTheReason) {
  MadeVehicle vehicle;
  vehicle.odometry_on = false;
  vehicle.run(1);
  const CommandAck ack = vehicle.command(CommandKind::arm);
  EXPECT_FALSE(ack.accepted);
  EXPECT_EQ(ack.reason, "no odometry");
  EXPECT_TRUE(vehicle.state().faults & kNoOdometry);
}

TEST(FlightCommands, ArmingOnLowBatteryIsRefused) {
  MadeVehicle vehicle;
  vehicle.battery_share = 0.1;
  vehicle.run(1);
  EXPECT_EQ(vehicle.command(CommandKind::arm).reason, "battery low");
}

TEST(FlightCommands, TakeoffNeedsArmingAndAPossibleHeight) {
  MadeVehicle vehicle;
  vehicle.run(1);
  EXPECT_EQ(vehicle.command(CommandKind::takeoff, 3).reason, "not armed");
  ASSERT_TRUE(vehicle.command(CommandKind::arm).accepted);
  EXPECT_EQ(vehicle.command(CommandKind::takeoff, NAN).reason, "height out of its limits");
  EXPECT_EQ(vehicle.command(CommandKind::takeoff, 1000).reason, "height out of its limits");
  EXPECT_TRUE(vehicle.command(CommandKind::takeoff, 2).accepted);
  EXPECT_EQ(vehicle.command(CommandKind::takeoff, 2).reason, "in flight already");
}

TEST(FlightCommands, TakeoffClimbsStraightUpAndHolds) {
  MadeVehicle vehicle(windy());
  ASSERT_TRUE(vehicle.fly(2.5));
  vehicle.run(2);
  EXPECT_LT((vehicle.position() - Eigen::Vector3d(0, 0, 2.5)).norm(), 0.2);
  EXPECT_NEAR(vehicle.state().height_m, 2.5, 0.4);
}

TEST(FlightCommands, NoDisarmingInFlightAndNoHoldingOnTheGround) {
  MadeVehicle vehicle;
  vehicle.run(1);
  EXPECT_EQ(vehicle.command(CommandKind::hold).reason, "on the ground");
  EXPECT_EQ(vehicle.command(CommandKind::land).reason, "on the ground");
  ASSERT_TRUE(vehicle.fly(2));
  EXPECT_EQ(vehicle.command(CommandKind::disarm).reason, "in flight");
}

TEST(FlightCommands, TheSameIdIsAnsweredAgainAndObeyedOnce) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(2));
  const Command land_now{vehicle.now, ++vehicle.last_id, CommandKind::land, NAN};
  vehicle.controller.receive(land_now);
  vehicle.run(0.5);
  ASSERT_TRUE(vehicle.command(CommandKind::hold).accepted);
  const Command hold_again{vehicle.now, vehicle.last_id, CommandKind::land, NAN};
  vehicle.controller.receive(hold_again);
  EXPECT_TRUE(vehicle.controller.take_acks().back().accepted);
  EXPECT_EQ(vehicle.state().mode, hold);
  vehicle.controller.receive(land_now);
  EXPECT_EQ(vehicle.controller.take_acks().back().reason, "older than the last command");
  EXPECT_EQ(vehicle.state().mode, hold);
}

TEST(FlightCommands, LandingComesDownWhereItIsAndDisarms) {
  MadeVehicle vehicle(windy());
  ASSERT_TRUE(vehicle.fly(3));
  ASSERT_TRUE(vehicle.command(CommandKind::land).accepted);
  EXPECT_TRUE(vehicle.run_until([&] { return !vehicle.state().armed; }, 15));
  EXPECT_EQ(vehicle.state().mode, idle);
  EXPECT_LT(vehicle.position().head<2>().norm(), 0.4);
  EXPECT_LT(vehicle.body.touchdown_speed(), 1.0);
  EXPECT_GT(vehicle.body.touchdown_speed(), 0.1);
}

TEST(FlightCommands, AfterAHoldCommandOnlyNewerSetpointsAreObeyed) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(2));
  vehicle.setpoint({0, 0, 2}, 0, 5);
  vehicle.run(0.1);
  EXPECT_EQ(vehicle.state().mode, guided);
  ASSERT_TRUE(vehicle.command(CommandKind::hold).accepted);
  vehicle.run(0.1);
  EXPECT_EQ(vehicle.state().mode, hold);
  vehicle.setpoint({0, 0, 2});
  vehicle.run(0.02);
  EXPECT_EQ(vehicle.state().mode, guided);
}

TEST(FlightCommands, ASetpointThatIsNotFiniteIsNotObeyed) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(2));
  vehicle.setpoint({NAN, 0, 2});
  vehicle.run(0.1);
  EXPECT_EQ(vehicle.state().mode, hold);
}

TEST(FlightCommands, ArmedAndForgottenOnTheGroundItDisarms) {
  MadeVehicle vehicle(calm());
  vehicle.run(1);
  ASSERT_TRUE(vehicle.command(CommandKind::arm).accepted);
  vehicle.run(59);
  EXPECT_TRUE(vehicle.state().armed);
  vehicle.run(2);
  EXPECT_FALSE(vehicle.state().armed);
}

TEST(FlightCommands, ALowBatteryIsAFaultAndACriticalOneLands) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(2));
  vehicle.battery_share = 0.15;
  vehicle.run(0.1);
  EXPECT_TRUE(vehicle.state().faults & kBatteryLow);
  EXPECT_EQ(vehicle.state().mode, hold);
  vehicle.battery_share = 0.05;
  vehicle.guide({0, 0, 2}, 0.1);
  EXPECT_EQ(vehicle.state().mode, land);
}

}  // namespace
}  // namespace saker::simulation
