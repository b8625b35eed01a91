#include <gtest/gtest.h>

#include "flight/bus/messages.h"
#include "flight/executive/bus_listener.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr Time kHour = 3600 * kNanosecondsPerSecond;
constexpr Time kAhead = kNanosecondsPerSecond / 5;  // of a clock that is a little off

/// A blackboard whose clock runs, and what others say.
class ExecutiveListener : public testing::Test {
 protected:
  void know_the_time() { board.clock.hear(100 * kNanosecondsPerSecond); }
  void say_vehicle(Time stamp) {
    VehicleState state;
    state.stamp = stamp;
    state.armed = true;
    publish(to_lcm(state));
  }
  void say_verdict(Time stamp) {
    motion::Verdict verdict;
    verdict.stamp = stamp;
    verdict.trajectory_id = 7;
    verdict.clear = true;
    publish(to_lcm(verdict));
  }
  void say_grid(Time stamp) {
    occupancy::OccupancyGrid grid;
    grid.stamp = stamp;
    grid.resolution_m = 0.2;
    grid.origin = Eigen::Vector3d::Zero();
    grid.size = {2, 2, 2};
    grid.cells.resize(8);
    for (const occupancy_t& chunk : to_lcm(grid, ++sequence)) publish(chunk);
  }
  template <class Message>
  void publish(const Message& message) {
    bus.publish(message);
    while (bus.handle(milliseconds(0)) > 0) {
    }
  }
  [[nodiscard]] double age_s(Time stamp) const { return to_seconds(board.clock.now() - stamp); }

  Blackboard board;
  Bus bus = Bus::in_memory("R1");
  BusListener listener{board, bus};
  std::int32_t sequence = 0;
};

TEST_F(ExecutiveListener, WhatCameHasTheAgeOfItsStamp) {
  know_the_time();
  const Time before = board.clock.now() - kAhead;
  say_vehicle(before);
  say_verdict(before);
  say_grid(before);
  EXPECT_NEAR(to_seconds(board.vehicle.latest()->stamp - before), 0, 1e-6);
  EXPECT_NEAR(to_seconds(board.verdict.latest()->stamp - before), 0, 1e-6);
  EXPECT_NEAR(to_seconds(board.newest_grid - before), 0, 1e-6);
  EXPECT_EQ(listener.ahead(), 0);
}

TEST_F(ExecutiveListener, NothingIsYoungerThanItsArrival) {
  know_the_time();
  say_vehicle(board.clock.now() + kAhead);
  say_verdict(board.clock.now() + kAhead);
  say_grid(board.clock.now() + kAhead);
  EXPECT_GE(age_s(board.vehicle.latest()->stamp), 0);
  EXPECT_GE(age_s(board.verdict.latest()->stamp), 0);
  EXPECT_GE(age_s(board.newest_grid), 0);
  EXPECT_GE(age_s(board.grid.latest()->stamp), 0);
  EXPECT_EQ(listener.ahead(), 0);
}

// Hazard: Stages and links | a state, a verdict or an occupancy block is stamped an hour ahead |
//   refused and counted, as if it had not come | –
TEST_F(ExecutiveListener, WhatComesFromTheFutureIsRefusedAndCounted) {
  know_the_time();
  say_vehicle(board.clock.now());
  const Time heard = board.vehicle.latest()->stamp;
  say_vehicle(board.clock.now() + kHour);
  say_verdict(board.clock.now() + kHour);
  say_grid(board.clock.now() + kHour);
  EXPECT_EQ(board.vehicle.latest()->stamp, heard);
  EXPECT_FALSE(board.verdict.latest());
  EXPECT_EQ(board.grid.latest(), nullptr);
  EXPECT_EQ(board.newest_grid, 0);
  EXPECT_EQ(listener.ahead(), 3);
}

TEST_F(ExecutiveListener, BeforeTheTimeIsKnownNothingIsKept) {
  say_vehicle(50 * kNanosecondsPerSecond);
  EXPECT_FALSE(board.vehicle.latest());
  know_the_time();
  say_vehicle(board.clock.now());
  EXPECT_TRUE(board.vehicle.latest()->armed);
}

TEST_F(ExecutiveListener, AnAcknowledgementIsHeardWheneverItComes) {
  publish(to_lcm(CommandAck{board.clock.now() + kHour, 5, true, ""}));
  const auto ack = board.acks.pop();
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->id, 5);
}

}  // namespace
}  // namespace saker::flight
