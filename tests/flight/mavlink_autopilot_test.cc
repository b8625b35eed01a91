#include <gtest/gtest.h>

#include "made_flight.h"

/// The simulator's autopilot against the table of its quirks.
namespace saker::tools {
namespace {

using flight::mavlink::Landed;

class Ardupilot : public ::testing::Test {
 protected:
  MadeFlight flight_{quirks_of(Autopilot::ardupilot, false)};
};

class Px4 : public ::testing::Test {
 protected:
  MadeFlight flight_{quirks_of(Autopilot::px4)};
};

TEST_F(Ardupilot, AnOriginBeforeItsEstimatorRunsIsForgotten) {
  flight_.run_to(4);
  flight_.send_origin();
  flight_.run_to(10);
  flight_.command(400, {1});
  EXPECT_TRUE(flight_.said("TEXT Arm: AHRS: waiting for home"));
  EXPECT_TRUE(flight_.said("ACK 400 4"));
  EXPECT_EQ(flight_.flags & 16, 0);
  flight_.send_origin();
  flight_.run_to(11);
  EXPECT_EQ(flight_.flags, 0x33F);
  flight_.command(400, {1});
  EXPECT_TRUE(flight_.said("ACK 400 0"));
}

TEST_F(Ardupilot, DoesNotArmWithoutOdometry) {
  flight_.odometry = false;
  flight_.run_to(8);
  flight_.send_origin();
  flight_.run_to(9);
  flight_.command(400, {1});
  EXPECT_TRUE(flight_.said("TEXT Arm: VisOdom: not healthy"));
  EXPECT_FALSE(flight_.autopilot.armed());
}

TEST_F(Ardupilot, ClimbsByItsOwnTakeOff) {
  flight_.take_off();
  EXPECT_EQ(flight_.autopilot.landed(), Landed::in_air);
  EXPECT_NEAR(flight_.craft.place().z(), 3, 0.1);
}

TEST_F(Ardupilot, ASetpointCancelsItsTakeOff) {
  flight_.run_to(8);
  flight_.send_origin();
  flight_.run_to(9);
  flight_.command(176, {1, 4});
  flight_.command(400, {1});
  flight_.command(22, {0, 0, 0, 0, 0, 0, 3});
  flight_.run_to(10);
  flight_.target = MadeFlight::to(0, -3);
  flight_.run_to(18);
  EXPECT_EQ(flight_.autopilot.cancelled(), 1);
  EXPECT_EQ(flight_.craft.place().z(), 0);
  EXPECT_TRUE(flight_.autopilot.armed());
  flight_.run_to(20);
  EXPECT_TRUE(flight_.said("TEXT Disarming motors"));
}

TEST_F(Ardupilot, FliesOnForItsTimeOutWhenSetpointsStopAndStandsThere) {
  flight_.take_off();
  flight_.target = MadeFlight::to(0, -3, 1);
  flight_.run_to(23);
  const double last = static_cast<double>(flight_.target->x);
  flight_.target.reset();
  flight_.run_to(28);
  EXPECT_NEAR(flight_.craft.place().x(), last + 0.5, 0.05);
  EXPECT_EQ(flight_.autopilot.mode(), 4u);
}

TEST_F(Ardupilot, DropsAnAccelerationWithoutVelocity) {
  flight_.take_off();
  flight_.target = MadeFlight::to(5, -3);
  flight_.target->type_mask = 0x838;
  flight_.run_to(21);
  EXPECT_NEAR(flight_.craft.place().x(), 0, 0.01);
  flight_.target->type_mask = 0x9C0;
  flight_.run_to(25);
  EXPECT_NEAR(flight_.craft.place().x(), 5, 0.1);
}

TEST_F(Ardupilot, FliesAJumpBackWhereTheTargetDoesNotFollow) {
  flight_.take_off();
  flight_.target = MadeFlight::to(0, -3);
  flight_.run_to(20);
  flight_.offset.x() = 3;
  flight_.reset_counter = 1;
  flight_.run_to(26);
  EXPECT_NEAR(flight_.craft.place().x(), -3, 0.1);
}

TEST_F(Ardupilot, TakesOdometryInOneFrameAlone) {
  const Quirks quirks = quirks_of(Autopilot::ardupilot);
  EstimatorModel model(quirks);
  flight::mavlink::Odometry m;
  m.q = {1, 0, 0, 0};
  m.frame_id = 20;
  m.child_frame_id = 12;
  const Time now = 20 * kNanosecondsPerSecond;
  EXPECT_TRUE(model.hear(m, now));
  EXPECT_FALSE(model.hear(m, now + 10'000'000));  // within 20 ms
  EXPECT_TRUE(model.hear(m, now + 30'000'000));
  m.frame_id = 1;
  EXPECT_FALSE(model.hear(m, now + 60'000'000));
  m.frame_id = 20;
  m.child_frame_id = 1;
  EXPECT_FALSE(model.hear(m, now + 90'000'000));
}

TEST_F(Ardupilot, DiesOfANumberThatIsNone) {
  flight_.take_off();
  flight_.send_nan();
  EXPECT_TRUE(flight_.autopilot.dead());
  const int frames = flight_.frames;
  flight_.run_to(25);
  EXPECT_EQ(flight_.frames, frames);
}

TEST_F(Ardupilot, ANumberOfOurFramesIsTurnedOnce) {
  flight::mavlink::Odometry m;
  const Quirks quirks = quirks_of(Autopilot::ardupilot);
  EstimatorModel model(quirks);
  m.x = 1;
  m.y = 2;
  m.z = -3;
  m.vy = 1;
  m.q = {0.9238795F, 0, 0, 0.3826834F};  // heads 45° to the right
  m.frame_id = 20;
  m.child_frame_id = 12;
  const auto o = model.hear(m, 20 * kNanosecondsPerSecond);
  ASSERT_TRUE(o);
  EXPECT_TRUE(o->T_odom_body.translation().isApprox(Eigen::Vector3d(1, -2, 3)));
  EXPECT_NEAR(core::yaw(o->T_odom_body.linear()), -M_PI / 4, 1e-6);
  EXPECT_TRUE(o->velocity.isApprox(Eigen::Vector3d(-1, -1, 0) / std::sqrt(2), 1e-5));
}

TEST_F(Px4, TakesOffboardOnlyAfterSetpointsAndClimbsByThem) {
  flight_.run_to(8);
  flight_.command(176, {1, 6});
  EXPECT_TRUE(flight_.said("ACK 176 1"));
  flight_.take_off();
  EXPECT_EQ(flight_.autopilot.mode(), 6U << 16);
  EXPECT_EQ(flight_.autopilot.landed(), Landed::in_air);
  EXPECT_NEAR(flight_.craft.place().z(), 3, 0.1);
}

TEST_F(Px4, DoesNotArmOrFlyInHoldWithoutAGlobalPlace) {
  flight_.run_to(8);
  flight_.command(176, {1, 4, 3});
  flight_.command(400, {1});
  EXPECT_TRUE(flight_.said("ACK 400 1"));
  flight_.send_origin();
  flight_.run_to(9);
  flight_.command(400, {1});
  EXPECT_TRUE(flight_.said("ACK 400 0"));
}

TEST_F(Px4, LandsWhenSetpointsStop) {
  flight_.take_off();
  flight_.target.reset();
  flight_.run_to(18.9);
  EXPECT_EQ(flight_.autopilot.mode(), 6U << 16);
  flight_.run_to(19.2);
  EXPECT_EQ(flight_.autopilot.mode(), 4U << 16 | 6U << 24);
  flight_.run_to(32);
  EXPECT_FALSE(flight_.autopilot.armed());
}

TEST_F(Px4, TakesNoOdometryAfterAGapNorOfALidar) {
  const Quirks quirks = quirks_of(Autopilot::px4);
  EstimatorModel model(quirks);
  flight::mavlink::Odometry m;
  m.q = {1, 0, 0, 0};
  m.frame_id = 20;
  m.child_frame_id = 12;
  const Time now = 20 * kNanosecondsPerSecond, ms = 1'000'000;
  EXPECT_FALSE(model.hear(m, now));
  EXPECT_TRUE(model.hear(m, now + 30 * ms));
  EXPECT_FALSE(model.hear(m, now + 300 * ms));
  EXPECT_TRUE(model.hear(m, now + 330 * ms));
  m.estimator_type = 5;
  EXPECT_FALSE(model.hear(m, now + 360 * ms));
}

TEST_F(Px4, BelievesStampsAfterFiveHundredExchanges) {
  const Quirks quirks = quirks_of(Autopilot::px4);
  EstimatorModel model(quirks);
  flight::mavlink::Odometry m;
  m.q = {1, 0, 0, 0};
  m.frame_id = 20;
  m.child_frame_id = 12;
  Time now = 20 * kNanosecondsPerSecond;
  const Time ahead = 5 * kNanosecondsPerSecond, ms = 1'000'000;
  for (int i = 0; i < 500; ++i) {
    m.time_usec = static_cast<std::uint64_t>(now + ahead - 50 * ms) / 1000;  // 50 ms old
    (void)model.hear(m, now - 30 * ms);
    const auto before = model.hear(m, now);
    ASSERT_TRUE(before);
    EXPECT_EQ(before->stamp, now - 10 * ms);
    const auto question = model.question(now);
    ASSERT_TRUE(question);
    model.hear({.tc1 = question->ts1 + ahead + ms, .ts1 = question->ts1}, now + 2 * ms);
    now += 100 * ms;
  }
  m.time_usec = static_cast<std::uint64_t>(now + ahead - 50 * ms) / 1000;
  (void)model.hear(m, now - 30 * ms);
  const auto after = model.hear(m, now);
  ASSERT_TRUE(after);
  EXPECT_NEAR(to_seconds(after->stamp - (now - 60 * ms)), 0, 1e-4);
}

}  // namespace
}  // namespace saker::tools
