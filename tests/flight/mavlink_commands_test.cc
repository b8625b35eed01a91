#include <gtest/gtest.h>

#include "flight/mavlink/commands.h"

namespace saker::flight::mavlink {
namespace {

constexpr Time kMs = kNanosecondsPerSecond / 1000;
const Dialect kArdupilot = dialect_of(Autopilot::ardupilot);
const Dialect kPx4 = dialect_of(Autopilot::px4);

flight::mavlink::CommandAck answer(std::uint16_t command, AckResult result) {
  flight::mavlink::CommandAck ack;
  ack.command = command;
  ack.result = static_cast<std::uint8_t>(result);
  return ack;
}

Command order(CommandKind kind, double height_m = NAN) {
  return {.stamp = 1, .id = 7, .kind = kind, .height_m = height_m};
}

class MavlinkCommands : public ::testing::Test {
 protected:
  void begin(CommandKind kind, const Dialect& dialect, std::int64_t id = 7) {
    commander_.begin(id, steps_of(order(kind, 3), dialect), now_);
  }
  /// What is sent until `end`, in steps of 10 ms.
  std::vector<CommandLong> sent_until(Time end) {
    std::vector<CommandLong> sent;
    for (; now_ < end; now_ += 10 * kMs)
      if (auto message = commander_.due(now_)) sent.push_back(*message);
    return sent;
  }

  Commander commander_;
  Time now_ = kNanosecondsPerSecond;
};

TEST_F(MavlinkCommands, ModesAreThoseOfEachAutopilot) {
  const auto land = steps_of(order(CommandKind::land), kArdupilot);
  ASSERT_EQ(land.size(), 1u);
  EXPECT_EQ(land[0].command, 176);
  EXPECT_EQ(land[0].parameters[0], 1);
  EXPECT_EQ(land[0].parameters[1], 9);
  const auto px4_land = steps_of(order(CommandKind::land), kPx4);
  EXPECT_EQ(px4_land[0].parameters[1], 4);
  EXPECT_EQ(px4_land[0].parameters[2], 6);
  EXPECT_EQ(kPx4.guided.custom, 0x60000u);
  EXPECT_EQ(kPx4.hold.custom, 0x3040000u);
  const auto takeoff = steps_of(order(CommandKind::takeoff, 3), kArdupilot);
  EXPECT_EQ(takeoff[0].command, 22);
  EXPECT_EQ(takeoff[0].parameters[6], 3);
  EXPECT_EQ(steps_of(order(CommandKind::takeoff, 3), kPx4)[0].parameters[1], 6);  // offboard
}

TEST_F(MavlinkCommands, ArmingIsAModeThenTheArmingAndIsAcknowledgedOnce) {
  begin(CommandKind::arm, kArdupilot);
  auto mode = commander_.due(now_);
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->command, 176);
  EXPECT_FALSE(commander_.hear(answer(400, AckResult::accepted), now_));  // not asked yet
  EXPECT_TRUE(commander_.hear(answer(176, AckResult::accepted), now_));
  auto arm = commander_.due(now_);
  ASSERT_TRUE(arm);
  EXPECT_EQ(arm->command, 400);
  EXPECT_EQ(arm->param1, 1);
  EXPECT_TRUE(commander_.hear(answer(400, AckResult::accepted), now_));
  const auto done = commander_.take_done(now_);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_TRUE(done[0].accepted);
  EXPECT_EQ(done[0].id, 7);
  EXPECT_FALSE(commander_.busy());
  begin(CommandKind::arm, kArdupilot);  // the same order again
  EXPECT_FALSE(commander_.busy());
  EXPECT_TRUE(commander_.take_done(now_)[0].accepted);
}

TEST_F(MavlinkCommands, WithoutAnAnswerItIsSentAgainSixTimes) {
  begin(CommandKind::land, kArdupilot);
  const auto sent = sent_until(now_ + 5 * kNanosecondsPerSecond);
  ASSERT_EQ(sent.size(), 6u);
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(sent[i].confirmation, i);
  const auto done = commander_.take_done(now_);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_FALSE(done[0].accepted);
  EXPECT_EQ(done[0].reason, "the autopilot does not answer");
}

TEST_F(MavlinkCommands, ARefusalsCauseIsTheTextBeforeOrAfterIt) {
  for (const Time after : {-5 * kMs, 5 * kMs}) {
    Commander commander;
    commander.begin(1, steps_of(order(CommandKind::arm), kPx4), now_);
    (void)commander.due(now_);
    const Time text = now_ + 20 * kMs + after;
    if (after < 0) commander.hear_text(2, "Arm: Battery failsafe", text);
    commander.hear(answer(176, AckResult::failed), now_ + 20 * kMs);
    if (after > 0) commander.hear_text(2, "Arm: Battery failsafe", text);
    EXPECT_TRUE(commander.take_done(now_ + 100 * kMs).empty());
    const auto done = commander.take_done(now_ + 300 * kMs);
    ASSERT_EQ(done.size(), 1u);
    EXPECT_EQ(done[0].reason, "Arm: Battery failsafe");
  }
}

TEST_F(MavlinkCommands, AnOldTextIsNoCause) {
  commander_.hear_text(2, "long ago", now_ - 5 * kNanosecondsPerSecond);
  begin(CommandKind::disarm, kArdupilot);
  (void)commander_.due(now_);
  commander_.hear(answer(400, AckResult::unsupported), now_);
  EXPECT_EQ(commander_.take_done(now_ + 300 * kMs)[0].reason, "not supported");
}

/// What passes by itself is tried for a minute, every two seconds.
TEST_F(MavlinkCommands, InconsistentSensorsAreWaitedForAMinute) {
  begin(CommandKind::arm, kArdupilot);
  const Time begin_at = now_;
  int arms = 0;
  while (commander_.busy() && now_ < begin_at + 100 * kNanosecondsPerSecond) {
    if (const auto sent = commander_.due(now_)) {
      const bool arm = sent->command == kArmDisarm;
      arms += arm;
      if (arm) commander_.hear_text(2, "Arm: Accels inconsistent", now_);
      commander_.hear(answer(sent->command, arm ? AckResult::failed : AckResult::accepted), now_);
    }
    now_ += 10 * kMs;
  }
  EXPECT_NEAR(arms, 31, 1);
  EXPECT_NEAR(to_seconds(now_ - begin_at), 61, 2);
  const auto done = commander_.take_done(now_);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_EQ(done[0].reason, "Arm: Accels inconsistent");
}

TEST_F(MavlinkCommands, ANewerOrderEndsTheOneThatRuns) {
  begin(CommandKind::arm, kArdupilot, 1);
  (void)commander_.due(now_);
  begin(CommandKind::land, kArdupilot, 2);
  const auto done = commander_.take_done(now_);
  ASSERT_EQ(done.size(), 1u);
  EXPECT_EQ(done[0].id, 1);
  EXPECT_FALSE(done[0].accepted);
  EXPECT_EQ(commander_.due(now_)->param2, 9);
}

TEST_F(MavlinkCommands, ACommandInProgressIsWaitedFor) {
  begin(CommandKind::takeoff, kArdupilot);
  (void)commander_.due(now_);
  commander_.hear(answer(22, AckResult::in_progress), now_);
  EXPECT_TRUE(sent_until(now_ + 1900 * kMs).empty());
  commander_.hear(answer(22, AckResult::accepted), now_);
  EXPECT_TRUE(commander_.take_done(now_)[0].accepted);
}

}  // namespace
}  // namespace saker::flight::mavlink
