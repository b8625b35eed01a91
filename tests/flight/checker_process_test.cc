#include "flight/collision_checker/checker_process.h"

#include <gtest/gtest.h>

#include <ctime>

#include "flight/bus/occupancy_messages.h"
#include "made_hall.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr Time kPeriod = 100'000'000;
const Time kSensorStart = from_seconds(1000);

/// The process on a bus in memory, on a clock of the test.
class CheckerOnTheBus : public testing::Test {
 protected:
  CheckerOnTheBus() {
    bus_.subscribe<verdict_t>([this](const verdict_t& message) {
      const auto verdict = from_lcm(message);
      if (verdict) verdicts_.push_back(*verdict);
      return verdict.has_value();
    });
    bus_.subscribe<occupancy_t>([this](const occupancy_t& chunk) {
      if (auto grid = joiner_.add(chunk)) grids_.push_back(std::move(*grid));
      return joiner_.accepted();
    });
    bus_.subscribe<health_t>([this](const health_t& message) {
      health_ = message;
      return true;
    });
  }

  void send_scan(bool with_pillar = false) {
    stamp_ += kPeriod;
    for (const scan_t& chunk : to_lcm(made::hall_scan(stamp_, with_pillar, rng_), sequence_++))
      bus_.publish(chunk);
  }
  void send_trajectory(std::int64_t id) {
    bus_.publish(*to_lcm(made::along_the_hall(id, stamp_), stamp_));
  }
  /// What was sent is heard; the process works; what it says is heard.
  void turn(milliseconds later = milliseconds(1)) {
    bus_.handle(milliseconds(0));
    now_ += later;
    checker_.step(now_);
    bus_.handle(milliseconds(0));
  }
  /// Scans that see the hall, and a trajectory through it.
  void hover() {
    for (int i = 0; i < 3; ++i) {
      send_scan();
      turn();
    }
    send_trajectory(1);
    turn();
  }
  [[nodiscard]] std::int64_t count(const std::string& name) const {
    for (const counter_t& counter : health_.counters)
      if (counter.name == name) return counter.value;
    return -1;
  }

  Bus bus_ = Bus::in_memory("R1");
  const ProcessConfig config_;
  CheckerProcess checker_{config_, bus_};
  CheckerProcess::Steady::time_point now_ = CheckerProcess::Steady::now();
  core::Rng rng_{1};
  Time stamp_ = kSensorStart;
  std::int32_t sequence_ = 0;
  OccupancyJoiner joiner_;
  std::vector<motion::Verdict> verdicts_;
  std::vector<occupancy::OccupancyGrid> grids_;
  health_t health_{};
};

TEST_F(CheckerOnTheBus, ATrajectoryThroughWhatScansHaveSeenIsClearAtOnce) {
  hover();
  ASSERT_FALSE(verdicts_.empty());
  EXPECT_TRUE(verdicts_.back().clear) << to_string(verdicts_.back().reason);
  EXPECT_EQ(verdicts_.back().trajectory_id, 1);
}

TEST_F(CheckerOnTheBus, APillarIsInTheVerdictThatFollowsTheNextScan) {
  hover();
  verdicts_.clear();
  send_scan(true);
  turn();
  ASSERT_EQ(verdicts_.size(), 1u);
  EXPECT_EQ(verdicts_[0].reason, motion::VerdictReason::occupied);
  EXPECT_NEAR(verdicts_[0].first_hit.x(), 6, 0.3);
}

TEST_F(CheckerOnTheBus, VerdictsComeTenTimesASecondAndGoStaleWithoutScans) {
  hover();
  verdicts_.clear();
  for (int i = 0; i < 10; ++i) turn(milliseconds(100));
  EXPECT_EQ(verdicts_.size(), 10u);
  EXPECT_EQ(verdicts_.back().reason, motion::VerdictReason::stale_scan);
  EXPECT_FALSE(verdicts_.back().clear);
}

TEST_F(CheckerOnTheBus, BlocksComeTwiceASecondAndHealthOnceASecond) {
  hover();
  grids_.clear();
  health_ = {};
  for (int i = 0; i < 20; ++i) {
    send_scan();
    turn(milliseconds(100));
  }
  EXPECT_EQ(grids_.size(), 4u);
  EXPECT_EQ(grids_.back().stamp, stamp_);
  EXPECT_EQ(grids_.back().at({3, 0.1, 3.1}), occupancy::Cell::free);
  EXPECT_EQ(grids_.back().at({-10.2, 0.1, 3.1}), occupancy::Cell::occupied);
  EXPECT_EQ(health_.process, "saker-collision-checker");
  EXPECT_EQ(health_.num_loops, 3);
  EXPECT_GT(count("scans"), 10);
  EXPECT_GT(count("nodes"), 1000);
  EXPECT_EQ(count("not_sent"), 0);
}

TEST_F(CheckerOnTheBus, ABlockThatKnowsNoNewScanIsNotSaidAgain) {
  hover();
  grids_.clear();
  for (int i = 0; i < 20; ++i) turn(milliseconds(100));
  EXPECT_LE(grids_.size(), 1u);
}

TEST_F(CheckerOnTheBus, OfTwoScansThatWaitTheNewerCounts) {
  hover();
  send_scan(false);
  send_scan(true);
  turn();
  EXPECT_EQ(verdicts_.back().reason, motion::VerdictReason::occupied);
  turn(milliseconds(1100));
  EXPECT_EQ(health_.loops[0].drops, 1);
}

TEST_F(CheckerOnTheBus, BeforeAnythingIsHeardNothingIsSaidButHealth) {
  turn();
  turn(milliseconds(600));
  turn(milliseconds(600));
  EXPECT_TRUE(verdicts_.empty());
  EXPECT_TRUE(grids_.empty());
  EXPECT_EQ(count("scans"), 0);
}

TEST_F(CheckerOnTheBus, AnExecutiveThatBeganAnewFindsAnEmptyMapAndMayCountFromOne) {
  hover();
  send_trajectory(900);
  turn();
  sequence_ = 0;
  send_scan();
  turn();
  EXPECT_EQ(verdicts_.back().reason, motion::VerdictReason::no_trajectory);
  send_trajectory(1);
  turn();
  EXPECT_EQ(verdicts_.back().trajectory_id, 1);
  turn(milliseconds(1100));
  EXPECT_EQ(count("restarts"), 1);
}

TEST_F(CheckerOnTheBus, AnOutdatedTrajectoryIsRefusedAndCounted) {
  hover();
  send_trajectory(5);
  turn();
  send_trajectory(3);
  turn();
  EXPECT_EQ(verdicts_.back().trajectory_id, 5);
  turn(milliseconds(1100));
  EXPECT_EQ(count("trajectories_refused"), 1);
}

TEST_F(CheckerOnTheBus, WhatIsDueNextIsNeverInThePast) {
  hover();
  turn(milliseconds(12345));
  EXPECT_GT(checker_.next_due(), now_);
  EXPECT_LE(checker_.next_due(), now_ + milliseconds(100));
}

TEST(SensorClock, GoesOnFromTheLeastLateStamp) {
  SensorClock clock;
  const auto t0 = SensorClock::Steady::now();
  EXPECT_FALSE(clock.at(t0));
  clock.hear(1'000'000'000, t0);
  clock.hear(1'050'000'000, t0 + milliseconds(80));  // 30 ms later than the first one
  EXPECT_EQ(*clock.at(t0 + milliseconds(100)), 1'100'000'000);
  clock.hear(1'120'000'000, t0 + milliseconds(110));  // 10 ms less late
  EXPECT_EQ(*clock.at(t0 + milliseconds(200)), 1'210'000'000);
}

TEST(SensorClock, AStampThatGoesFarBackIsOfAClockThatBeganAnew) {
  SensorClock clock;
  const auto t0 = SensorClock::Steady::now();
  clock.hear(from_seconds(500), t0);
  clock.hear(from_seconds(3), t0 + milliseconds(10));
  EXPECT_EQ(*clock.at(t0 + milliseconds(10)), from_seconds(3));
}

/// Of 16 runs of 2 ms four are asked for theirs.
TEST(LoopMeter, SampledProcessorTimeIsThatOfAllRuns) {
  LoopMeter meter("line", 5, 4);
  for (int i = 0; i < 16; ++i) {
    const LoopMeter::Run run(meter);
    const std::clock_t begin = std::clock();
    while (std::clock() - begin < CLOCKS_PER_SEC / 500) {
    }
  }
  EXPECT_NEAR(meter.totals().cpu_s, 0.032, 0.004);
  EXPECT_EQ(meter.totals().runs, 16);
}

TEST(LoopMeter, TellsRateMedianLatenessAndMisses) {
  LoopMeter meter("scan", 5);
  for (int i = 0; i < 4; ++i) LoopMeter::Run run(meter);
  meter.began_late(milliseconds(2));
  meter.began_late(milliseconds(7));
  const loop_health_t health = meter.take_period(std::chrono::seconds(2), 30, 1);
  EXPECT_EQ(health.name, "scan");
  EXPECT_FLOAT_EQ(health.rate_hz, 2);
  EXPECT_EQ(health.misses, 1);
  EXPECT_FLOAT_EQ(health.worst_lateness_ms, 7);
  EXPECT_GE(health.median_ms, 0);
  EXPECT_EQ(health.drops, 1);
  const loop_health_t idle = meter.take_period(std::chrono::seconds(1), 30, 1);
  EXPECT_EQ(idle.rate_hz, 0);
  EXPECT_TRUE(std::isnan(idle.median_ms));
  EXPECT_EQ(idle.misses, 1);
}

}  // namespace
}  // namespace saker::flight
