#include <gtest/gtest.h>

#include "flight/mavlink/authority.h"
#include "flight/mavlink/state_in.h"

namespace saker::flight::mavlink {
namespace {

constexpr Time kMs = kNanosecondsPerSecond / 1000;
constexpr Time kNow = 100 * kNanosecondsPerSecond;
constexpr std::uint32_t kGuided = 4, kLand = 9, kLoiter = 5;

template <class Message>
Frame framed(const Message& message, std::uint8_t system = 1, std::uint8_t component = 1) {
  Frame frame;
  frame.system = system;
  frame.component = component;
  frame.id = Message::kId;
  frame.payload = *encode(message);
  return frame;
}

Heartbeat heartbeat(bool armed, std::uint32_t mode, std::uint8_t kind = 3) {
  Heartbeat message;
  message.autopilot = kind;
  message.custom_mode = mode;
  message.base_mode = armed ? kArmedFlag : 0;
  message.system_status = 4;
  return message;
}

class MavlinkState : public ::testing::Test {
 protected:
  template <class Message>
  bool hear(const Message& message, Time now = kNow) {
    return state_.hear(framed(message), now);
  }

  StateIn state_{dialect_of(Autopilot::ardupilot), 0};
};

TEST_F(MavlinkState, OnlyTheConfiguredAutopilotIsBelieved) {
  EXPECT_FALSE(hear(heartbeat(false, 0, 12)));
  EXPECT_FALSE(state_.connected(kNow));
  EXPECT_EQ(state_.refusal(), "mavlink.autopilot is ardupilot, but system 1 is px4 (HEARTBEAT 12)");
}

TEST_F(MavlinkState, OthersOnTheLineAreNotTheAutopilot) {
  ExtendedSysState landed;
  landed.landed_state = 2;
  EXPECT_FALSE(hear(landed));                                            // before its HEARTBEAT
  EXPECT_FALSE(state_.hear(framed(heartbeat(false, 0, 8)), kNow));       // a ground station
  EXPECT_FALSE(state_.hear(framed(heartbeat(false, 0), 1, 100), kNow));  // a camera
  EXPECT_TRUE(hear(heartbeat(false, 0)));
  EXPECT_FALSE(state_.hear(framed(heartbeat(true, 4), 2), kNow));  // another aircraft
  EXPECT_FALSE(state_.hear(framed(landed, 2), kNow));
  EXPECT_FALSE(state_.state().armed);
  EXPECT_TRUE(hear(landed));
  EXPECT_EQ(state_.state().landed, Landed::in_air);
}

TEST_F(MavlinkState, AnAutopilotThatIsSilentIsGone) {
  hear(heartbeat(false, 0));
  EXPECT_TRUE(state_.connected(kNow + 2400 * kMs));
  EXPECT_FALSE(state_.connected(kNow + 2600 * kMs));
}

TEST_F(MavlinkState, OfSeveralPacksTheEmptiestCountsAndWhatIsUnknownDoesNot) {
  hear(heartbeat(false, 0));
  BatteryStatus pack;
  pack.battery_remaining = -1;
  pack.voltages.fill(0xFFFF);
  hear(pack);
  EXPECT_TRUE(std::isnan(state_.state().battery_share));
  EXPECT_TRUE(std::isnan(state_.state().cell_volts));
  pack.battery_remaining = 80;
  pack.voltages[0] = 4000;
  pack.voltages[1] = 3900;
  hear(pack);
  pack.id = 1;
  pack.battery_remaining = 30;
  pack.voltages.fill(0xFFFF);
  hear(pack);
  EXPECT_DOUBLE_EQ(state_.state().battery_share, 0.3);
  EXPECT_DOUBLE_EQ(state_.state().cell_volts, 3.9);
  pack.id = 200;
  pack.battery_remaining = 1;
  hear(pack);
  EXPECT_DOUBLE_EQ(state_.state().battery_share, 0.3);
}

TEST_F(MavlinkState, HeightIsAboveWhereItWasArmedAndNonsenseIsNotBelieved) {
  hear(heartbeat(false, 0));
  LocalPositionNed place;
  place.z = -10;
  hear(place);
  hear(heartbeat(true, kGuided));
  place.z = -13;
  hear(place);
  EXPECT_DOUBLE_EQ(state_.height_m(), 3);
  place.z = 1e7F;
  hear(place);
  EXPECT_DOUBLE_EQ(state_.height_m(), 3);
  AttitudeQuaternion attitude;
  attitude.q1 = 3;
  hear(attitude);
  EXPECT_DOUBLE_EQ(state_.state().attitude.w(), 1);
  ExtendedSysState landed;
  landed.landed_state = 9;
  EXPECT_FALSE(hear(landed));
}

TEST_F(MavlinkState, WithoutAPlaceTheEstimatorIsNotGood) {
  hear(heartbeat(false, 0));
  EXPECT_FALSE(state_.estimator_good());
  EkfStatusReport report;
  report.flags = 0x33F;  // as flown
  hear(report);
  EXPECT_TRUE(state_.estimator_good());
  report.flags = 0xA7;
  hear(report);
  EXPECT_FALSE(state_.estimator_good());
}

class MavlinkAuthority : public ::testing::Test {
 protected:
  MavlinkAuthority() {
    authority_.asked(kGuided, kNow);
    authority_.hear(false, kGuided, 3, kNow);
    authority_.hear(true, kGuided, 4, kNow);
  }

  RcChannels sticks(std::uint16_t roll) {
    RcChannels message;
    message.chan1_raw = roll;
    message.chan2_raw = message.chan3_raw = message.chan4_raw = 1500;
    return message;
  }

  Authority authority_;
};

TEST_F(MavlinkAuthority, AModeThatWasAskedForIsOurs) {
  authority_.asked(kLand, kNow + 100 * kMs);
  authority_.hear(true, kLand, 4, kNow + 200 * kMs);
  EXPECT_TRUE(authority_.ours());
}

TEST_F(MavlinkAuthority, APilotsModeIsThePilotsForGood) {
  authority_.hear(true, kLoiter, 4, kNow + 100 * kMs);
  EXPECT_EQ(authority_.holder(), Authority::Holder::pilot);
  EXPECT_EQ(authority_.cause(), "the pilot took over, mode 5");
  authority_.hear(true, kGuided, 4, kNow + 200 * kMs);  // the switch goes back
  EXPECT_FALSE(authority_.ours());
  authority_.hear(false, kGuided, 4, kNow + 300 * kMs);
  EXPECT_FALSE(authority_.ours());
  authority_.give_back();
  EXPECT_TRUE(authority_.ours());
}

TEST_F(MavlinkAuthority, AModeAskedForLongAgoIsNotOurs) {
  authority_.asked(kLand, kNow);
  authority_.hear(true, kLand, 4, kNow + 4000 * kMs);
  EXPECT_EQ(authority_.holder(), Authority::Holder::pilot);
}

/// "EKF Failsafe: changed to LAND Mode": HEARTBEAT says mode 9 and status 5 at once.
TEST_F(MavlinkAuthority, AFailsafeIsTheAutopilotsAndAPilotMayTakeItFromThere) {
  authority_.hear(true, kLand, 5, kNow + 100 * kMs);
  EXPECT_EQ(authority_.holder(), Authority::Holder::failsafe);
  authority_.hear(true, kLoiter, 4, kNow + 300 * kMs);
  EXPECT_EQ(authority_.holder(), Authority::Holder::pilot);
}

TEST_F(MavlinkAuthority, SticksThatMoveAreAPilotsAndNoiseIsNot) {
  authority_.hear(sticks(1500));
  authority_.hear(sticks(1700));
  EXPECT_TRUE(authority_.ours());  // once may be noise
  authority_.hear(sticks(1520));
  authority_.hear(sticks(1700));
  authority_.hear(sticks(1710));
  EXPECT_EQ(authority_.cause(), "the pilot took the sticks");
}

TEST_F(MavlinkAuthority, WithoutAReceiverThereAreNoSticks) {
  authority_.hear(sticks(1500));
  for (int i = 0; i < 5; ++i) authority_.hear(sticks(i % 2 ? 0 : 65535));
  EXPECT_TRUE(authority_.ours());
}

TEST(MavlinkAuthorityOnTheGround, AnybodyMayChooseAMode) {
  Authority authority;
  authority.hear(false, 0, 3, kNow);
  authority.hear(false, kLoiter, 3, kNow);
  authority.hear(true, kLoiter, 4, kNow);
  EXPECT_TRUE(authority.ours());
}

}  // namespace
}  // namespace saker::flight::mavlink
