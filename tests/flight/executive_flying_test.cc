#include <gtest/gtest.h>

#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "flight/bus/messages.h"
#include "flight/executive/guidance_loop.h"
#include "flight/executive/safety_loop.h"

namespace saker::flight {
namespace {

using autonomy::GuidanceOrder;
using autonomy::PlanningOrder;
using std::chrono::milliseconds;

/// A blackboard whose clock runs, and what is published.
class ExecutiveFlying : public testing::Test {
 protected:
  ExecutiveFlying() {
    board.clock.hear(100 * kNanosecondsPerSecond);
    bus.subscribe<command_t>([this](const command_t& message) {
      commands.push_back(message);
      return true;
    });
    bus.subscribe<setpoint_t>([this](const setpoint_t& message) {
      setpoints.push_back(message);
      return true;
    });
    say_vehicle(true);
    say_odometry(0);
  }

  void say_vehicle(bool armed) {
    VehicleState state;
    state.stamp = board.clock.now();
    state.armed = armed;
    board.vehicle.put(state);
  }
  void say_odometry(double x) {
    VehicleOdometry odometry;
    odometry.stamp = board.clock.now();
    odometry.T_odom_body.translation() = Eigen::Vector3d(x, 0, 3);
    board.odometry.put(odometry);
  }
  void order(GuidanceOrder guidance, int anchors) {
    board.orders.put({{guidance, PlanningOrder::tour}, anchors, board.clock.now()});
  }
  /// 8 m along x at 1 m/s, from where guidance is.
  void propose() {
    autonomy::Planning::Output plan;
    plan.proposal.emplace();
    plan.proposal->from_id = board.committed.latest()->id;
    plan.proposal->trajectory.start = board.clock.now() + from_seconds(0.1);
    plan.proposal->trajectory.step_s = 1;
    for (int i = 0; i <= 8; ++i) {
      motion::MotionState state{Eigen::Vector3d(i, 0, 3), Eigen::Vector3d(1, 0, 0),
                                Eigen::Vector3d::Zero(), 0, 0};
      plan.proposal->trajectory.states.push_back(state);
    }
    board.plan.put(std::move(plan));
  }
  /// The checker clears whatever is flown.
  void clear() {
    motion::Verdict verdict;
    verdict.stamp = board.clock.now();
    verdict.trajectory_id = board.committed.latest()->id;
    verdict.clear = true;
    board.verdict.put(verdict);
  }
  void handle() {
    while (bus.handle(milliseconds(0)) > 0) {
    }
  }

  Blackboard board;
  Bus bus = Bus::in_memory("R1");
  std::vector<command_t> commands;
  std::vector<setpoint_t> setpoints;
};

/// The safety loop over a mission that a test throws out of.
class ExecutiveSafety : public ExecutiveFlying {
 protected:
  autonomy::Mission::Output step(const autonomy::SupervisorInput& input) {
    ++steps;
    land_ordered = input.land_ordered;
    marked = input.marked;
    if (throws) throw std::bad_alloc();
    autonomy::Mission::Output output;
    output.orders = {GuidanceOrder::follow, PlanningOrder::tour};
    output.command = Command{.stamp = input.now, .id = 7, .kind = CommandKind::takeoff};
    return output;
  }
  void answer(std::int64_t id, bool accepted) {
    board.acks.push({board.clock.now(), id, accepted, accepted ? "" : "not now"});
  }
  /// Runs of the loop at its rate, which go on whatever is thrown.
  void run(int runs) {
    for (int i = 0; i < runs; ++i) {
      try {
        (void)loop.run();
      } catch (const std::bad_alloc&) {
        ++thrown;
      }
      handle();
      std::this_thread::sleep_for(milliseconds(20));
    }
  }

  bool throws = false, land_ordered = false, signalled = false, marked = true;
  int steps = 0, thrown = 0;
  SafetyLoop loop{{.step = [this](autonomy::SupervisorInput input) { return step(input); },
                   .mission_done = [] { return false; },
                   .land_ordered = [this] { return signalled; },
                   .has_targets = true},
                  board,
                  bus};
};

TEST_F(ExecutiveSafety, WhatWasOrderedHoldsWhereItThrowsOnce) {
  run(1);
  throws = true;
  run(SafetyLoop::kMostThrows - 1);
  throws = false;
  run(1);
  throws = true;
  run(SafetyLoop::kMostThrows - 1);
  EXPECT_EQ(thrown, 2 * (SafetyLoop::kMostThrows - 1));
  EXPECT_FALSE(loop.lands_alone());
  EXPECT_EQ(board.orders.latest()->orders.guidance, GuidanceOrder::follow);
}

TEST_F(ExecutiveSafety, LandsWithoutTheMissionWhereItThrowsAgainAndAgain) {
  run(1);
  throws = true;
  run(SafetyLoop::kMostThrows);
  EXPECT_TRUE(loop.lands_alone());
  throws = false;
  commands.clear();
  const int before = steps;
  run(25);
  EXPECT_EQ(steps, before);  // no way leads back
  EXPECT_EQ(board.orders.latest()->orders, autonomy::MissionOrders{});
  ASSERT_GE(commands.size(), 2U);  // half a second at 5 Hz
  EXPECT_LE(commands.size(), 4U);
  for (const command_t& command : commands) {
    EXPECT_EQ(command.kind, static_cast<int>(CommandKind::land));
    EXPECT_EQ(command.id, 8);  // a new one, the same until it is answered
  }
  EXPECT_FALSE(board.mission_done);
  say_vehicle(false);
  run(1);
  EXPECT_TRUE(board.mission_done);
}

// Hazard: Stages and links | safety throws again and again, and the landing is refused | it is told
//   to land by a new command | –
TEST_F(ExecutiveSafety, LandingAloneARefusedCommandIsFollowedByAnotherOneAnAgreedOneIsNot) {
  run(1);
  throws = true;
  run(SafetyLoop::kMostThrows + 1);
  commands.clear();
  answer(8, false);
  answer(8, false);  // the repeat, from memory
  run(25);
  ASSERT_GE(commands.size(), 2U);
  for (const command_t& command : commands) EXPECT_EQ(command.id, 9);
  commands.clear();
  answer(8, false);  // late
  answer(9, true);
  run(25);
  ASSERT_GE(commands.size(), 2U);
  for (const command_t& command : commands) EXPECT_EQ(command.id, 9);
}

TEST_F(ExecutiveSafety, OnTheGroundItEndsWhereItThrowsAgainAndAgain) {
  say_vehicle(false);
  throws = true;
  run(SafetyLoop::kMostThrows + 1);
  EXPECT_TRUE(board.mission_done);
  EXPECT_TRUE(commands.empty());
}

TEST_F(ExecutiveSafety, ASignalIsHeardWhateverElseHangs) {
  run(1);
  EXPECT_FALSE(land_ordered);
  signalled = true;
  run(1);
  EXPECT_TRUE(land_ordered);
}

TEST_F(ExecutiveSafety, TheMissionKnowsWhetherTheFlightIsMarked) {
  run(1);
  EXPECT_FALSE(marked);
  board.marked = true;
  run(1);
  EXPECT_TRUE(marked);
}

class ExecutiveGuidance : public ExecutiveFlying {
 protected:
  /// Runs at its rate; safety orders with each.
  void follow(int runs) {
    for (int i = 0; i < runs; ++i) {
      order(GuidanceOrder::follow, 1);
      if (board.committed.latest()) clear();
      run();
    }
  }
  void run() {
    (void)loop.run();
    handle();
    std::this_thread::sleep_for(milliseconds(20));
  }
  double speed() const { return Eigen::Vector3f(setpoints.back().velocity).cast<double>().norm(); }

  GuidanceLoop loop{autonomy::GuidanceConfig{}, board, bus};
};

TEST_F(ExecutiveGuidance, FliesWhatIsProposed) {
  follow(3);
  propose();
  follow(30);
  EXPECT_GT(speed(), 0.8);
  EXPECT_GT(setpoints.back().position[0], 0.2);
  EXPECT_NEAR(to_seconds(board.clock.now() - board.guided), 0, 0.2);
}

TEST_F(ExecutiveGuidance, HoldsWhereSafetyDoesNotRun) {
  follow(3);
  propose();
  follow(30);
  ASSERT_GT(speed(), 0.8);
  for (int i = 0; i < 90; ++i) {
    clear();
    run();  // nobody orders any more
  }
  EXPECT_LT(speed(), 0.05);
  EXPECT_EQ(board.stop.latest()->reason, "told to hold");
}

TEST_F(ExecutiveGuidance, BeginsAnewWhereTheVehicleIsAfterAPause) {
  follow(3);
  propose();
  follow(30);
  say_odometry(0.5);  // there it holds by itself, since setpoints expired
  std::this_thread::sleep_for(milliseconds(1500));
  follow(1);
  EXPECT_DOUBLE_EQ(setpoints.back().position[0], 0.5);
  EXPECT_LT(speed(), 0.01);
}

TEST_F(ExecutiveGuidance, IsSilentWhereItIsToldTo) {
  follow(3);
  order(GuidanceOrder::silent, 1);
  const std::size_t before = setpoints.size();
  run();
  EXPECT_EQ(setpoints.size(), before);
  EXPECT_FALSE(board.setpoint.latest());
}

}  // namespace
}  // namespace saker::flight
