#include <gtest/gtest.h>

#include <random>

#include "flight/mavlink/clocks.h"

namespace saker::flight::mavlink {
namespace {

constexpr Time kMs = kNanosecondsPerSecond / 1000;

TEST(MavlinkSensorClock, TheLeastLateStampCounts) {
  SensorToHost clock;
  EXPECT_FALSE(clock.host(5));
  const Time offset = 123 * kNanosecondsPerSecond;
  std::mt19937 random(1);
  for (int i = 1; i < 500; ++i) {
    const Time stamp = 10 * kMs * i;
    clock.hear(stamp, stamp + offset + 20 * kMs + random() % (30 * kMs));
  }
  const Time found = *clock.host(5000 * kMs) - 5000 * kMs - offset;
  EXPECT_GE(found, 20 * kMs);
  EXPECT_LT(found, 22 * kMs);
  EXPECT_EQ(*clock.sensor(*clock.host(77 * kMs)), 77 * kMs);
}

TEST(MavlinkSensorClock, FollowsADriftAndASensorThatBeginsAnew) {
  SensorToHost clock;
  for (int i = 1; i <= 60'000; ++i) {  // ten minutes, the sensor slow by 20 ppm
    const Time stamp = 10 * kMs * i;
    clock.hear(stamp, stamp + stamp / 50'000 + 5 * kMs);
  }
  const Time end = 600 * kNanosecondsPerSecond;
  EXPECT_NEAR(to_seconds(*clock.host(end) - end), 12e-3 + 5e-3, 1e-3);
  clock.hear(kMs, end);
  EXPECT_EQ(*clock.host(kMs), end);
}

/// As a simulator does that cannot keep up: what is later by 0.4 s for good is so.
TEST(MavlinkSensorClock, FollowsASensorWhoseClockStoodStillForAMoment) {
  SensorToHost clock;
  for (int i = 1; i <= 1000; ++i) {
    const Time host = 10 * kMs * i, stood = i > 300 ? 400 * kMs : 0;
    clock.hear(host - stood, host + (i % 10) * kMs);
    const double off = to_seconds(*clock.sensor(host) - (host - stood));
    const bool may_be_a_delay = i > 300 && i < 480;
    if (!may_be_a_delay && i > 300 && i <= 710) continue;
    EXPECT_NEAR(off, may_be_a_delay ? 0.4 : 0, 0.01) << i;
  }
}

/// An autopilot whose clock differs, at the end of a line with delays.
struct Autopilot {
  Time began;  // host's time at which its clock was zero

  Timesync answer(const Timesync& question, Time host_then) const {
    Timesync message = question;
    message.tc1 = host_then - began;
    return message;
  }
};

TEST(MavlinkTimeSync, TheOffsetIsWithinItsBoundWhateverTheDelays) {
  std::mt19937 random(5);
  const Autopilot autopilot{-42 * kNanosecondsPerSecond + 17};
  TimeSync sync;
  Time now = kNanosecondsPerSecond;
  for (int i = 0; i < 200; ++i) {
    now += TimeSync::kPeriod;
    const auto question = sync.question(now);
    ASSERT_TRUE(question);
    EXPECT_EQ(question->tc1, 0);
    EXPECT_FALSE(sync.question(now + kMs));
    const Time there = now + random() % (20 * kMs), back = there + random() % (20 * kMs);
    EXPECT_TRUE(sync.hear(autopilot.answer(*question, there), back));
    const auto offset = sync.offset(back);
    ASSERT_TRUE(offset);
    EXPECT_LE(std::abs(offset->host_minus_autopilot - autopilot.began), offset->bound);
    EXPECT_LE(offset->bound, 21 * kMs);
  }
  EXPECT_LT(sync.offset(now)->bound, 6 * kMs);
}

TEST(MavlinkTimeSync, WhatWasNotAskedIsNoAnswer) {
  TimeSync sync;
  const Time now = 50 * kNanosecondsPerSecond;
  Timesync answer;
  answer.tc1 = 7;
  answer.ts1 = now;
  EXPECT_FALSE(sync.hear(answer, now));
  ASSERT_TRUE(sync.question(now));
  EXPECT_FALSE(sync.hear(answer, now - 1));                             // before the question
  EXPECT_FALSE(sync.hear(answer, now + TimeSync::kMostRoundTrip + 1));  // too late
  answer.tc1 = -7;
  EXPECT_FALSE(sync.hear(answer, now + kMs));
  answer.tc1 = 7;
  EXPECT_TRUE(sync.hear(answer, now + kMs));
}

TEST(MavlinkTimeSync, AQuestionOfTheAutopilotIsAnsweredInOurTime) {
  Timesync question;
  question.ts1 = 99;
  const auto answer = TimeSync::answer(question, 1234);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->ts1, 99);
  EXPECT_EQ(answer->tc1, 1234);
  EXPECT_FALSE(TimeSync::answer(*answer, 1234));  // an answer is no question
}

TEST(MavlinkTimeSync, ARebootBeginsAnew) {
  TimeSync sync;
  Autopilot autopilot{0};
  Time now = 100 * kNanosecondsPerSecond;
  for (int i = 0; i < 10; ++i) {
    now += TimeSync::kPeriod;
    if (i == 5) autopilot.began = now - 2 * kNanosecondsPerSecond;
    const auto question = sync.question(now);
    EXPECT_TRUE(sync.hear(autopilot.answer(*question, now + kMs), now + 2 * kMs));
    EXPECT_NEAR(to_seconds(sync.offset(now)->host_minus_autopilot - autopilot.began), 0, 2e-3);
  }
  EXPECT_EQ(sync.restarts(), 1);
}

}  // namespace
}  // namespace saker::flight::mavlink
