#include "saker/core/vehicle.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>
#include <string>

namespace saker {
namespace {

TEST(Vehicle, EachModeHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const VehicleMode mode : {VehicleMode::idle, VehicleMode::takeoff, VehicleMode::guided,
                                 VehicleMode::hold, VehicleMode::land, VehicleMode::descend}) {
    names.insert(to_string(mode));
  }
  EXPECT_EQ(names.size(), 6u);
  EXPECT_STREQ(to_string(VehicleMode::idle), "idle");
  EXPECT_STREQ(to_string(VehicleMode::descend), "descend");
}

TEST(Vehicle, EachCommandHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const CommandKind kind : {CommandKind::arm, CommandKind::disarm, CommandKind::takeoff,
                                 CommandKind::hold, CommandKind::land}) {
    names.insert(to_string(kind));
  }
  EXPECT_EQ(names.size(), 5u);
  EXPECT_STREQ(to_string(CommandKind::arm), "arm");
  EXPECT_STREQ(to_string(CommandKind::land), "land");
}

TEST(Vehicle, EachFaultIsABitOfItsOwn) {
  std::uint32_t all = 0;
  for (const VehicleFault fault :
       {kNoOdometry, kOdometryRejected, kSetpointExpired, kBatteryLow, kCollision}) {
    EXPECT_EQ(std::popcount(static_cast<std::uint32_t>(fault)), 1);
    EXPECT_EQ(all & fault, 0u);
    all |= fault;
  }
}

TEST(Vehicle, WhatWasForgottenIsNotANumber) {
  const Setpoint setpoint;
  EXPECT_TRUE(setpoint.position.array().isNaN().all());
  EXPECT_TRUE(setpoint.velocity.array().isNaN().all());
  EXPECT_TRUE(std::isnan(setpoint.yaw));
  EXPECT_TRUE(VehicleOdometry().covariance.array().isNaN().all());
  EXPECT_TRUE(std::isnan(VehicleState().height_m));
  EXPECT_TRUE(std::isnan(Command().height_m));
}

TEST(Vehicle, ASetpointThatNobodyFilledHasExpired) {
  EXPECT_LE(Setpoint().expiry, Setpoint().stamp);
}

TEST(Vehicle, OdometryIsLostAndACommandNotAcceptedUntilSomebodySaysOtherwise) {
  EXPECT_EQ(VehicleOdometry().status, VehicleOdometryStatus::lost);
  EXPECT_FALSE(CommandAck().accepted);
  EXPECT_EQ(Command().kind, CommandKind::hold);
}

}  // namespace
}  // namespace saker
