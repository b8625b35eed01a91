#include "saker/autonomy/guidance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;
constexpr Time kStart = 5 * kNanosecondsPerSecond;

/// From `from` at a constant speed along x, with a second at either end to get there.
motion::Trajectory straight(Time start, const Eigen::Vector3d& from, double speed,
                            double cruise_s) {
  motion::Trajectory trajectory;
  trajectory.start = start;
  trajectory.step_s = 0.05;
  double x = 0;
  const int steps = static_cast<int>((cruise_s + 2) / 0.05);
  for (int i = 0; i <= steps; ++i) {
    const double t = 0.05 * i;
    const double ramp = std::min({1.0, t, cruise_s + 2 - t});
    const double acceleration = t < 1 ? speed : t > cruise_s + 1 ? -speed : 0;
    trajectory.states.push_back({from + Eigen::Vector3d(x, 0, 0),
                                 Eigen::Vector3d(speed * std::max(ramp, 0.0), 0, 0),
                                 Eigen::Vector3d(acceleration, 0, 0), 0.1 * t, 0.1});
    const double next = std::min({1.0, t + 0.05, std::max(0.0, cruise_s + 1.95 - t)});
    x += speed * (std::max(ramp, 0.0) + next) / 2 * 0.05;
  }
  return trajectory;
}

VehicleOdometry hovering() {
  VehicleOdometry odometry;
  odometry.T_odom_body.translation() = Eigen::Vector3d(0, 0, 3);
  return odometry;
}

/// Guidance that hovers, told to follow.
class GuidanceTest : public testing::Test {
 protected:
  GuidanceTest() : guidance(GuidanceConfig{}) {
    guidance.anchor(kStart, hovering());
    (void)fly_to(kStart, true);
  }

  motion::Verdict clear() const {
    motion::Verdict said;
    said.stamp = now;
    said.trajectory_id = guidance.committed()->id;
    said.clear = true;
    said.clear_until = guidance.committed()->end();
    return said;
  }
  /// 14 m along x at 2 m/s.
  CommitStatus propose() {
    const Time start = now + from_seconds(0.4);
    return guidance.commit({straight(start, {0, 0, 3}, 2, 6), guidance.committed()->id}, now);
  }
  /// The last setpoint; checks that no step between two is a jump.
  Setpoint fly_to(Time end, bool verdicts, GuidanceOrder order = GuidanceOrder::follow) {
    for (; now <= end; now += kStep) {
      if (verdicts) verdict = clear();
      const auto setpoint = guidance.update(now, order, verdict);
      if (!setpoint) continue;
      if (last.stamp != 0) {
        EXPECT_LT((setpoint->position - last.position).norm(), 0.06);
        EXPECT_LT((setpoint->velocity - last.velocity).norm(), 0.15);
      }
      last = *setpoint;
    }
    return last;
  }
  bool at_rest() const { return last.velocity.norm() < 1e-9; }

  Guidance guidance;
  Time now = kStart;
  std::optional<motion::Verdict> verdict;
  Setpoint last;
};

TEST_F(GuidanceTest, SaysNothingWhileSilent) {
  EXPECT_FALSE(guidance.update(now, GuidanceOrder::silent, clear()));
  EXPECT_FALSE(Guidance(GuidanceConfig{}).update(now, GuidanceOrder::follow, std::nullopt));
}

TEST_F(GuidanceTest, StaysWhereItWasAnchored) {
  const Setpoint setpoint = fly_to(kStart + 3 * kNanosecondsPerSecond, false);
  EXPECT_EQ(setpoint.position, Eigen::Vector3d(0, 0, 3));
  EXPECT_EQ(setpoint.velocity, Eigen::Vector3d::Zero());
  EXPECT_EQ(setpoint.expiry - setpoint.stamp, from_seconds(0.3));
}

TEST_F(GuidanceTest, FliesACommittedTrajectoryToItsEndWithoutAJump) {
  ASSERT_EQ(propose(), CommitStatus::committed);
  const Setpoint end = fly_to(guidance.committed()->end() + kStep, true);
  EXPECT_NEAR(end.position.x(), 14, 0.01);
  EXPECT_TRUE(at_rest());
  EXPECT_EQ(guidance.last_stop().count, 0);
}

TEST_F(GuidanceTest, SplicesAProposalToWhatIsFlown) {
  ASSERT_EQ(propose(), CommitStatus::committed);
  (void)fly_to(kStart + 3 * kNanosecondsPerSecond, true);
  const Time begin = now + from_seconds(0.43);
  const motion::MotionState at = guidance.committed()->sample(begin);
  motion::Trajectory next = motion::braked(*guidance.committed(), begin, {});
  ASSERT_EQ(guidance.commit({next, guidance.committed()->id}, now), CommitStatus::committed);
  EXPECT_LE(guidance.committed()->start, now);
  EXPECT_NEAR((guidance.committed()->sample(begin).position - at.position).norm(), 0, 1e-3);
  (void)fly_to(guidance.committed()->end() + kStep, true);
  EXPECT_TRUE(at_rest());
  EXPECT_NEAR(last.position.x(), next.states.back().position.x(), 1e-6);
}

TEST_F(GuidanceTest, RefusesWhatIsLateOrBeginsOnWhatIsNoLongerFlown) {
  Proposal late{straight(now - kStep, {0, 0, 3}, 2, 2), guidance.committed()->id};
  EXPECT_EQ(guidance.commit(late, now), CommitStatus::late);
  Proposal other{straight(now + kStep, {0, 0, 3}, 2, 2), guidance.committed()->id - 1};
  EXPECT_EQ(guidance.commit(other, now), CommitStatus::other);
  (void)guidance.update(now, GuidanceOrder::hold, clear());
  EXPECT_EQ(propose(), CommitStatus::refused);
}

TEST_F(GuidanceTest, StopsOnTheTrajectoryWhenVerdictsFallSilent) {
  ASSERT_EQ(propose(), CommitStatus::committed);
  (void)fly_to(kStart + 3 * kNanosecondsPerSecond, true);
  (void)fly_to(now + 2 * kNanosecondsPerSecond, false);
  EXPECT_TRUE(at_rest());
  EXPECT_EQ(guidance.last_stop().count, 1);
  EXPECT_EQ(guidance.last_stop().reason, "no verdict");
}

TEST_F(GuidanceTest, StopsWhenANewTrajectoryIsNeverJudged) {
  verdict = clear();
  ASSERT_EQ(propose(), CommitStatus::committed);
  const std::int64_t old = verdict->trajectory_id;
  while (now < kStart + 3 * kNanosecondsPerSecond) {
    verdict->stamp = now;
    verdict->trajectory_id = old;
    (void)fly_to(now, false);
  }
  EXPECT_TRUE(at_rest());
  EXPECT_EQ(guidance.last_stop().reason, "no verdict on this trajectory");
}

TEST_F(GuidanceTest, StandsBeforeTheTimeToWhichItIsClear) {
  ASSERT_EQ(propose(), CommitStatus::committed);
  const Time until = kStart + 4 * kNanosecondsPerSecond;
  const double limit = guidance.committed()->sample(until).position.x();
  const std::int64_t id = guidance.committed()->id;
  while (now < kStart + 8 * kNanosecondsPerSecond) {
    verdict = clear();
    verdict->clear = guidance.committed()->id != id;
    if (guidance.committed()->id == id) verdict->clear_until = until;
    verdict->first_hit = {9, 0, 3};
    (void)fly_to(now, false);
  }
  EXPECT_TRUE(at_rest());
  EXPECT_LT(last.position.x(), limit);
  EXPECT_GT(last.position.x(), limit - 1.0);  // it flies what may be flown
  EXPECT_EQ(guidance.last_stop().reason, "blocked at (9.0, 0.0, 3.0)");
}

TEST_F(GuidanceTest, StopsAtOnceWhenTheObstacleIsNearerThanItCanBrake) {
  ASSERT_EQ(propose(), CommitStatus::committed);
  (void)fly_to(kStart + 3 * kNanosecondsPerSecond, true);
  const Setpoint before = last;
  verdict = clear();
  verdict->clear = false;
  verdict->clear_until = now;
  (void)fly_to(now + 2 * kNanosecondsPerSecond, false);
  EXPECT_TRUE(at_rest());
  EXPECT_LT(last.position.x() - before.position.x(), 1.15);  // v²/2a = 1 m
}

TEST_F(GuidanceTest, HoldsWhenToldTo) {
  ASSERT_EQ(propose(), CommitStatus::committed);
  (void)fly_to(kStart + 3 * kNanosecondsPerSecond, true);
  (void)fly_to(now + 2 * kNanosecondsPerSecond, true, GuidanceOrder::hold);
  EXPECT_TRUE(at_rest());
  EXPECT_EQ(guidance.last_stop().reason, "told to hold");
}

/// The acceleration grows by the jerk at most, from the last verdict to rest.
TEST_F(GuidanceTest, AStopHasNoJumpInAcceleration) {
  ASSERT_EQ(propose(), CommitStatus::committed);
  (void)fly_to(kStart + 3 * kNanosecondsPerSecond, true);
  const double most = motion::BrakingConfig{}.jerk_mps3 * to_seconds(kStep) * 1.01;
  Setpoint before = last;
  double hardest = 0;
  for (int i = 0; i < 100; ++i) {
    const Setpoint next = fly_to(now, false);
    EXPECT_LE((next.acceleration - before.acceleration).norm(), most);
    hardest = std::max(hardest, next.acceleration.norm());
    before = next;
  }
  EXPECT_TRUE(at_rest());
  EXPECT_NEAR(hardest, motion::BrakingConfig{}.deceleration_mps2, 0.05);
}

}  // namespace
}  // namespace saker::autonomy
