#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "flight/bus/messages.h"

namespace saker::flight {
namespace {

constexpr Time kStamp = 1'234'567'891'234'000;
constexpr double kSingle = 1e-6;  // relative, of a float

/// What is left of a message after the wire.
template <class Message>
Message through_the_wire(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), bytes.size());
  Message result{};
  EXPECT_EQ(result.decode(bytes.data(), 0, static_cast<int>(bytes.size())), bytes.size());
  return result;
}

SE3 some_pose() {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  T.translation() << 123.456789, -7.5, 4.25;
  return T;
}

motion::Trajectory some_trajectory(int states) {
  motion::Trajectory trajectory{.id = 42, .start = kStamp, .step_s = 0.05, .states = {}};
  for (int i = 0; i < states; ++i) {
    const double s = i;
    trajectory.states.push_back({.position = {300 + 0.1 * s, -0.03 * s, 3},
                                 .velocity = {2, -0.6, 0},
                                 .acceleration = {0.1, 0.2, -0.3},
                                 .yaw = -1.5,
                                 .yaw_rate = 0.25});
  }
  return trajectory;
}

TEST(Utime, LosesWhatIsBelowAMicrosecondDownwards) {
  EXPECT_EQ(from_utime(to_utime(1999)), 1000);
  EXPECT_EQ(from_utime(to_utime(-1)), -1000);
  EXPECT_EQ(from_utime(to_utime(kStamp)), kStamp);
}

TEST(Utime, AForgedOneDoesNotOverflow) {
  EXPECT_GT(from_utime(std::numeric_limits<std::int64_t>::max()), 0);
  EXPECT_LT(from_utime(std::numeric_limits<std::int64_t>::min()), 0);
}

TEST(Messages, AVehicleStateComesBack) {
  VehicleState state;
  state.stamp = kStamp;
  state.armed = true;
  state.mode = VehicleMode::descend;
  state.attitude = Eigen::Quaterniond(some_pose().rotation());
  state.height_m = 3.5;
  state.battery_share = 0.75;
  state.faults = kBatteryLow | kNoOdometry;
  const auto back = from_lcm(through_the_wire(to_lcm(state)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->stamp, kStamp);
  EXPECT_TRUE(back->armed);
  EXPECT_EQ(back->mode, VehicleMode::descend);
  EXPECT_LT(back->attitude.angularDistance(state.attitude), 1e-9);
  EXPECT_EQ(back->height_m, 3.5);
  EXPECT_EQ(back->battery_share, 0.75);
  EXPECT_EQ(back->faults, state.faults);
}

TEST(Messages, WhatIsUnknownStaysUnknown) {
  const auto back = from_lcm(to_lcm(VehicleState{}));
  ASSERT_TRUE(back);
  EXPECT_TRUE(std::isnan(back->height_m));
  EXPECT_TRUE(std::isnan(back->battery_share));
}

TEST(Messages, ACommandComesBack) {
  const auto back = from_lcm(through_the_wire(
      to_lcm(Command{.stamp = kStamp, .id = 7, .kind = CommandKind::takeoff, .height_m = 2.5})));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->id, 7);
  EXPECT_EQ(back->kind, CommandKind::takeoff);
  EXPECT_EQ(back->height_m, 2.5);
}

TEST(Messages, ATakeOffToNowhereIsRefused) {
  EXPECT_FALSE(from_lcm(to_lcm(Command{.stamp = 0, .id = 1, .kind = CommandKind::takeoff})));
  EXPECT_FALSE(from_lcm(
      to_lcm(Command{.stamp = 0, .id = 1, .kind = CommandKind::takeoff, .height_m = INFINITY})));
}

TEST(Messages, AnAcknowledgementKeepsItsReasonUpToTheCeiling) {
  const CommandAck ack{
      .stamp = kStamp, .id = 7, .accepted = false, .reason = std::string(999, 'x')};
  const auto back = from_lcm(through_the_wire(to_lcm(ack)));
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->accepted);
  EXPECT_EQ(back->reason, std::string(command_ack_t::MAX_REASON, 'x'));
}

TEST(Messages, ASetpointComesBack) {
  const Setpoint setpoint{.stamp = kStamp,
                          .expiry = kStamp + 200'000'000,
                          .position = {1, 2, 3},
                          .velocity = {0.5, 0, -0.25},
                          .acceleration = {0, 1, 0},
                          .yaw = 3,
                          .yaw_rate = -0.5};
  const auto back = from_lcm(through_the_wire(to_lcm(setpoint)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->expiry, setpoint.expiry);
  EXPECT_EQ(back->position, setpoint.position);
  EXPECT_EQ(back->velocity, setpoint.velocity);
  EXPECT_EQ(back->acceleration, setpoint.acceleration);
  EXPECT_EQ(back->yaw, 3);
  EXPECT_EQ(back->yaw_rate, -0.5);
}

TEST(Messages, ASetpointThatIsNotANumberIsRefused) { EXPECT_FALSE(from_lcm(to_lcm(Setpoint{}))); }

TEST(Messages, OdometryComesBackWithItsCovariance) {
  VehicleOdometry odometry;
  odometry.stamp = kStamp;
  odometry.T_odom_body = some_pose();
  odometry.velocity = {1, 2, 3};
  odometry.angular_velocity = {-1, 0.5, 0.25};
  for (int i = 0; i < 36; ++i) odometry.covariance(i / 6, i % 6) = i / 64.0;
  odometry.status = VehicleOdometryStatus::predicted;
  odometry.reset_counter = 3;
  const auto back = from_lcm(through_the_wire(to_lcm(odometry)));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->T_odom_body.isApprox(odometry.T_odom_body, 1e-12));
  EXPECT_EQ(back->velocity, odometry.velocity);
  EXPECT_EQ(back->angular_velocity, odometry.angular_velocity);
  EXPECT_EQ(back->covariance, odometry.covariance);
  EXPECT_EQ(back->status, VehicleOdometryStatus::predicted);
  EXPECT_EQ(back->reset_counter, 3);
}

TEST(Messages, APoseThatIsNoneIsRefused) {
  odometry_t message = to_lcm(VehicleOdometry{});
  ASSERT_TRUE(from_lcm(message));
  message.orientation[3] = 2;
  EXPECT_FALSE(from_lcm(message));
  message.orientation[3] = NAN;
  EXPECT_FALSE(from_lcm(message));
}

TEST(Messages, EnumeratorsThatDoNotExistAreRefused) {
  vehicle_state_t state = to_lcm(VehicleState{});
  odometry_t odometry = to_lcm(VehicleOdometry{});
  verdict_t verdict = to_lcm(motion::Verdict{});
  command_t command = to_lcm(Command{});
  for (const std::int8_t wrong : std::array<std::int8_t, 3>{-1, 6, 127}) {
    state.mode = odometry.status = verdict.reason = command.kind = wrong;
    EXPECT_FALSE(from_lcm(state));
    EXPECT_FALSE(from_lcm(odometry));
    EXPECT_FALSE(from_lcm(verdict));
    EXPECT_FALSE(from_lcm(command));
  }
}

TEST(Messages, ATrajectoryComesBackToTheMicrometre) {
  const motion::Trajectory trajectory = some_trajectory(600);
  const auto message = to_lcm(trajectory, kStamp);
  ASSERT_TRUE(message);
  const auto back = from_lcm(through_the_wire(*message));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->id, 42);
  EXPECT_EQ(back->start, kStamp);
  EXPECT_EQ(back->step_s, 0.05);
  ASSERT_EQ(back->states.size(), 600u);
  for (std::size_t i = 0; i < 600; ++i) {
    const motion::MotionState &a = trajectory.states[i], &b = back->states[i];
    EXPECT_LT((a.position - b.position).norm(), 400 * kSingle);
    EXPECT_LT((a.velocity - b.velocity).norm(), 2 * kSingle);
    EXPECT_LT((a.acceleration - b.acceleration).norm(), kSingle);
    EXPECT_NEAR(a.yaw, b.yaw, kSingle);
    EXPECT_NEAR(a.yaw_rate, b.yaw_rate, kSingle);
  }
}

TEST(Messages, ATrajectoryIsNotCutShort) {
  EXPECT_TRUE(to_lcm(some_trajectory(trajectory_t::MAX_STATES), 0));
  EXPECT_FALSE(to_lcm(some_trajectory(trajectory_t::MAX_STATES + 1), 0));
}

TEST(Messages, NoTrajectoryIsAnAnswer) {
  const auto back = from_lcm(*to_lcm(motion::Trajectory{}, 0));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->empty());
}

TEST(Messages, ATrajectoryWhoseEndIsNoTimeIsRefused) {
  const trajectory_t good = *to_lcm(some_trajectory(3), 0);
  ASSERT_TRUE(from_lcm(good).has_value());
  for (const double step_s : {0.0, -0.05, 1e12, double{INFINITY}, double{NAN}}) {
    trajectory_t wrong = good;
    wrong.step_s = step_s;
    EXPECT_FALSE(from_lcm(wrong).has_value()) << step_s;
  }
  for (const std::int64_t start : {std::int64_t{-1}, std::int64_t{9'000'000'000'000'001}}) {
    trajectory_t wrong = good;
    wrong.start_utime = start;
    EXPECT_FALSE(from_lcm(wrong).has_value()) << start;
  }
}

TEST(Messages, ATrajectoryWithAStateThatIsNotANumberIsRefused) {
  motion::Trajectory trajectory = some_trajectory(3);
  trajectory.states[1].velocity.y() = NAN;
  EXPECT_FALSE(from_lcm(*to_lcm(trajectory, 0)));
}

TEST(Messages, AVerdictComesBack) {
  const motion::Verdict verdict{.stamp = kStamp,
                                .trajectory_id = 42,
                                .clear = false,
                                .reason = motion::VerdictReason::occupied,
                                .clear_until = kStamp + 1'500'000'000,
                                .first_hit = {10, -5, 2.5},
                                .clearance_m = 0.375};
  const auto back = from_lcm(through_the_wire(to_lcm(verdict)));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->trajectory_id, 42);
  EXPECT_FALSE(back->clear);
  EXPECT_EQ(back->reason, motion::VerdictReason::occupied);
  EXPECT_EQ(back->clear_until, verdict.clear_until);
  EXPECT_EQ(back->first_hit, verdict.first_hit);
  EXPECT_EQ(back->clearance_m, 0.375);
}

TEST(Messages, PeriodicOnesFitIntoOneDatagram) {
  EXPECT_LE(to_lcm(VehicleOdometry{}).getEncodedSize(), 1400);
  EXPECT_LE(to_lcm(Setpoint{}).getEncodedSize(), 1400);
  EXPECT_LE(to_lcm(VehicleState{}).getEncodedSize(), 1400);
  EXPECT_LE(to_lcm(motion::Verdict{}).getEncodedSize(), 1400);
}

}  // namespace
}  // namespace saker::flight
