#include <gtest/gtest.h>

#include "flight/link/session.h"

namespace saker::flight {
namespace {

using Outcome = Session::Outcome;
using Steady = Session::Steady;
using std::chrono::milliseconds;

constexpr double kLost_s = 3, kHello_s = 1;

/// One end as it lives now: what it says carries its epoch and a counter, as if it were unsealed.
struct Life {
  explicit Life(std::uint64_t its_epoch) : epoch(its_epoch) {}

  [[nodiscard]] exchange::Opened says(const std::string& body = "") {
    return {exchange::Verdict::genuine, "R1", session.payload(body), epoch, ++counter};
  }
  [[nodiscard]] exchange::Opened says_goodbye() {
    return {exchange::Verdict::genuine, "R1", session.goodbye(), epoch, ++counter};
  }
  [[nodiscard]] exchange::Opened answers(const exchange::Opened& message) {
    return {exchange::Verdict::genuine, "BASE", session.answer(message), epoch, ++counter};
  }

  Session session{kLost_s, kHello_s};
  std::uint64_t epoch, counter = 0;
};

class TwoEndsOfALink : public testing::Test {
 protected:
  /// Until both know that the other one lives.
  void join(Life& robot, Life& ground) {
    if (!robot.session.alive(now)) robot.session.end();  // as its end does when it notices
    const auto call = robot.says();
    ASSERT_EQ(ground.session.open(now, call).outcome, Outcome::asks);
    ASSERT_EQ(robot.session.open(now, ground.answers(call)).outcome, Outcome::begun);
    ASSERT_EQ(ground.session.open(now, robot.says()).outcome, Outcome::begun);
  }

  Steady::time_point now = Steady::now();
};

TEST_F(TwoEndsOfALink, KnowAfterThreeDatagramsThatBothLive) {
  Life robot(1), ground(2);
  EXPECT_FALSE(ground.session.alive(now));
  join(robot, ground);
  EXPECT_TRUE(robot.session.alive(now) && ground.session.alive(now));
  const Session::Heard heard = ground.session.open(now, robot.says("a message"));
  EXPECT_EQ(heard.outcome, Outcome::taken);
  EXPECT_EQ(heard.body, "a message");
}

TEST_F(TwoEndsOfALink, TakeEachDatagramOnceInAnyOrder) {
  Life robot(1), ground(2);
  join(robot, ground);
  const auto first = robot.says(), second = robot.says(), third = robot.says();
  EXPECT_EQ(ground.session.open(now, third).outcome, Outcome::taken);
  EXPECT_TRUE(ground.session.newest());
  EXPECT_EQ(ground.session.open(now, first).outcome, Outcome::taken);
  EXPECT_FALSE(ground.session.newest());
  for (const auto& message : {first, third})
    EXPECT_EQ(ground.session.open(now, message).outcome, Outcome::replayed);
  EXPECT_EQ(ground.session.open(now, second).outcome, Outcome::taken);
}

TEST_F(TwoEndsOfALink, ARecordingBeginsNoLifeWhicheverEndWasRestarted) {
  Life robot(1), ground(2);
  std::vector<exchange::Opened> recorded = {robot.says()};
  join(robot, ground);
  for (int i = 0; i < 50; ++i) {
    recorded.push_back(robot.says());
    (void)robot.session.open(now, ground.says());
  }
  Life other_ground(3);
  for (const auto& message : recorded)
    EXPECT_EQ(other_ground.session.open(now, message).outcome, Outcome::asks);
  now += milliseconds(3100);
  Life other_robot(4);
  const auto call = other_robot.says();
  EXPECT_EQ(ground.session.open(now, call).outcome, Outcome::asks);
  EXPECT_EQ(other_robot.session.open(now, ground.answers(call)).outcome, Outcome::begun);
  EXPECT_EQ(ground.session.open(now, other_robot.says()).outcome, Outcome::begun);
  for (const auto& message : recorded)
    EXPECT_EQ(ground.session.open(now, message).outcome, Outcome::asks);
  EXPECT_EQ(ground.session.open(now, other_robot.says()).outcome, Outcome::taken);
}

TEST_F(TwoEndsOfALink, WhatARobotSaidToAnEarlierGroundIsNotTakenByTheNext) {
  Life robot(1), ground(2), next(3);
  join(robot, ground);
  const auto said = robot.says("to the first");
  EXPECT_EQ(ground.session.open(now, said).outcome, Outcome::taken);
  now += milliseconds(3100);
  join(robot, next);
  EXPECT_EQ(next.session.open(now, said).outcome, Outcome::replayed);
}

TEST_F(TwoEndsOfALink, WhatWasHeldBackDoesNotComeAfterASilence) {
  Life robot(1), ground(2);
  join(robot, ground);
  (void)robot.session.open(now, ground.says());  // the challenge that is open now
  const auto held = robot.says("land");
  now += milliseconds(3100);
  EXPECT_FALSE(ground.session.alive(now));
  EXPECT_EQ(ground.session.open(now, held).outcome, Outcome::asks);
}

TEST_F(TwoEndsOfALink, OfTwoOfOneNameTheFirstIsHeardUntilItIsSilent) {
  Life first(1), second(5), ground(2);
  join(first, ground);
  const auto call = second.says();
  EXPECT_EQ(ground.session.open(now, call).outcome, Outcome::asks);
  EXPECT_EQ(second.session.open(now, ground.answers(call)).outcome, Outcome::begun);
  const auto refused = second.says();
  EXPECT_EQ(ground.session.open(now, refused).outcome, Outcome::second);
  EXPECT_EQ(ground.session.open(now, first.says()).outcome, Outcome::taken);
  now += milliseconds(3100);
  EXPECT_EQ(ground.session.open(now, refused).outcome, Outcome::asks) << "its challenge is used";
  second.session.end();
  const auto again = second.says();
  EXPECT_EQ(ground.session.open(now, again).outcome, Outcome::asks);
  (void)second.session.open(now, ground.answers(again));
  EXPECT_EQ(ground.session.open(now, second.says()).outcome, Outcome::begun);
}

TEST_F(TwoEndsOfALink, AfterAGoodbyeTheNextLifeBeginsAtOnce) {
  Life first(1), second(5), ground(2);
  join(first, ground);
  const auto goodbye = first.says_goodbye();
  EXPECT_EQ(ground.session.open(now, goodbye).outcome, Outcome::goodbye);
  EXPECT_FALSE(ground.session.alive(now));
  join(second, ground);
  EXPECT_EQ(ground.session.open(now, goodbye).outcome, Outcome::asks) << "a recording of it";
  EXPECT_TRUE(ground.session.alive(now));
}

TEST_F(TwoEndsOfALink, OneThatLetItsHelloPassGivesWayToOneThatProvedItLives) {
  Life first(1), second(5), stranger(6), ground(2);
  join(first, ground);
  const auto call = second.says();
  EXPECT_EQ(ground.session.open(now, call).outcome, Outcome::asks);
  (void)second.session.open(now, ground.answers(call));
  const auto proof = second.says();
  EXPECT_EQ(ground.session.open(now, proof).outcome, Outcome::second);
  now += milliseconds(1000);
  EXPECT_EQ(ground.session.open(now, second.says()).outcome, Outcome::second);
  now += milliseconds(200);
  EXPECT_EQ(ground.session.open(now, proof).outcome, Outcome::asks) << "a recording of it";
  EXPECT_EQ(ground.session.open(now, stranger.says()).outcome, Outcome::asks);
  EXPECT_EQ(ground.session.open(now, second.says()).outcome, Outcome::begun);
  EXPECT_EQ(ground.session.open(now, first.says()).outcome, Outcome::asks);
}

TEST_F(TwoEndsOfALink, WhatIsTooShortForChallengesIsNothing) {
  Life ground(2);
  for (std::size_t size = 0; size < 16; ++size) {
    const exchange::Opened message{exchange::Verdict::genuine, "R1", std::string(size, 'x'), 1, 1};
    EXPECT_EQ(ground.session.open(now, message).outcome, Outcome::malformed);
  }
}

}  // namespace
}  // namespace saker::flight
