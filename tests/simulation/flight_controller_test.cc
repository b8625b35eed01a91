#include "saker/simulation/vehicle/flight_controller.h"

#include <gtest/gtest.h>

#include "made_vehicle.h"

namespace saker::simulation {
namespace {

using enum VehicleMode;

/// The largest distance from `place` over `seconds` of setpoints there.
double worst_error(MadeVehicle& vehicle, const Eigen::Vector3d& place, double seconds) {
  double worst = 0;
  for (int i = 0; i < static_cast<int>(seconds * 50); ++i) {
    vehicle.guide(place, 0.02);
    worst = std::max(worst, (vehicle.position() - place).norm());
  }
  return worst;
}

TEST(FlightController, HoversWithin20CentimetresInGustyWindOnLateOdometry) {
  MadeVehicle vehicle(windy());
  vehicle.latency_s = 0.1;
  ASSERT_TRUE(vehicle.fly(3));
  vehicle.guide({0, 0, 3}, 5);
  EXPECT_LT(worst_error(vehicle, {0, 0, 3}, 30), 0.2);
  EXPECT_EQ(vehicle.state().mode, guided);
  EXPECT_EQ(vehicle.state().faults, 0U);
}

TEST(FlightController, AStepIsReachedWithLittleOvershoot) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(3));
  double most = 0;
  for (int i = 0; i < 350; ++i) {
    vehicle.guide({1, 0, 3}, 0.02);
    most = std::max(most, vehicle.position().x());
  }
  EXPECT_LT(most, 1.3);
  EXPECT_NEAR((vehicle.position() - Eigen::Vector3d(1, 0, 3)).norm(), 0, 0.08);
}

/// Speeds up at 2 m/s², then brakes as hard at once, to a standstill.
TEST(FlightController, AStopEndsWithoutASwing) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(3));
  vehicle.guide({0, 0, 3}, 2);
  const double step_s = 0.02, speeding_up_s = 0.8, settled_s = 1.8;
  double x = 0, v = 0, fastest = 0;
  for (double t = 0; t < 6; t += step_s) {
    const double a = t < speeding_up_s ? 2 : v > 1e-9 ? -2 : 0;
    vehicle.setpoint({x, 0, 3}, 0, 0.2, {v, 0, 0}, {a, 0, 0});
    vehicle.run(step_s);
    x += step_s * (v + step_s * a / 2);
    v = std::max(0.0, v + step_s * a);
    if (t > settled_s) fastest = std::max(fastest, vehicle.body.state().velocity.norm());
  }
  EXPECT_EQ(v, 0);
  EXPECT_LT(fastest, 0.15);
}

TEST(FlightController, YawFollowsTheSetpoint) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(2));
  vehicle.guide({0, 0, 2}, 4, 1.2);
  EXPECT_NEAR(core::yaw(vehicle.body.state().pose.linear()), 1.2, 0.05);
}

TEST(FlightController, AMovingSetpointIsFollowedWithoutLag) {
  MadeVehicle vehicle(windy());
  ASSERT_TRUE(vehicle.fly(3));
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const double t = i * 0.02;
    const double v = std::min(2.0, t);
    const double x = t < 2 ? t * t / 2 : 2 + 2 * (t - 2);
    vehicle.setpoint({x, 0, 3}, 0, 0.2, {v, 0, 0});
    vehicle.run(0.02);
    if (t > 4) worst = std::max(worst, std::abs(vehicle.position().x() - x - 0.02 * v));
  }
  EXPECT_LT(worst, 0.25);
}

TEST(FlightController, WhenSetpointsStopItHoldsThenLandsAndDisarms) {
  MadeVehicle vehicle(windy());
  ASSERT_TRUE(vehicle.fly(3));
  vehicle.guide({0, 0, 3}, 1);
  for (int i = 0; i < 100; ++i) {
    vehicle.setpoint({i * 0.03, 0, 3}, 0, 0.2, {1.5, 0, 0});
    vehicle.run(0.02);
  }
  vehicle.run(0.3);
  EXPECT_EQ(vehicle.state().mode, hold);
  EXPECT_TRUE(vehicle.state().faults & kSetpointExpired);
  vehicle.run(2);
  EXPECT_LT(vehicle.body.state().velocity.norm(), 0.3);
  const Eigen::Vector3d stopped = vehicle.position();
  EXPECT_TRUE(vehicle.run_until([&] { return vehicle.state().mode == land; }, 7));
  EXPECT_TRUE(vehicle.run_until([&] { return !vehicle.state().armed; }, 12));
  EXPECT_LT((vehicle.position() - stopped).head<2>().norm(), 0.5);
  EXPECT_LT(vehicle.body.touchdown_speed(), 1.0);
  EXPECT_NEAR(vehicle.position().z(), 0, 0.02);
}

TEST(FlightController, WhenOdometryStopsItBrakesDescendsAndDisarms) {
  MadeVehicle vehicle(windy());
  ASSERT_TRUE(vehicle.fly(3));
  for (int i = 0; i < 100; ++i) {
    vehicle.setpoint({i * 0.03, 0, 3}, 0, 0.2, {1.5, 0, 0});
    vehicle.run(0.02);
  }
  vehicle.odometry_on = false;
  vehicle.run(0.7);
  EXPECT_EQ(vehicle.state().mode, descend);
  EXPECT_TRUE(vehicle.state().faults & kNoOdometry);
  vehicle.run(1.2);
  EXPECT_LT(vehicle.body.state().velocity.head<2>().norm(), 0.7);
  EXPECT_TRUE(vehicle.run_until([&] { return !vehicle.state().armed; }, 15));
  EXPECT_LT(vehicle.body.touchdown_speed(), 1.2);
  EXPECT_NEAR(vehicle.position().z(), 0, 0.02);
}

TEST(FlightController, ItDoesNotComeBackFromDescending) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(3));
  vehicle.odometry_on = false;
  vehicle.run(1);
  vehicle.odometry_on = true;
  vehicle.guide({0, 0, 3}, 1);
  EXPECT_EQ(vehicle.state().mode, descend);
  EXPECT_EQ(vehicle.command(CommandKind::hold).reason, "no odometry to hold by");
  EXPECT_TRUE(vehicle.run_until([&] { return !vehicle.state().armed; }, 15));
}

/// What odometry may say instead of the truth; t: seconds since it began to lie.
struct Lie {
  const char* name;
  std::function<void(VehicleOdometry&, double t)> tell;
};

class LyingOdometry : public testing::TestWithParam<int> {};

std::vector<Lie> lies() {
  return {{"jumps", [](VehicleOdometry& o, double) { o.T_odom_body.translation().x() += 1.5; }},
          {"drifts sideways",
           [](VehicleOdometry& o, double t) {
             o.T_odom_body.translation().y() += 0.6 * t * t;
             o.velocity.y() += 1.2 * t;
           }},
          {"climbs",
           [](VehicleOdometry& o, double t) {
             o.T_odom_body.translation().z() += 0.35 * t;
             o.velocity.z() += 0.35;
           }},
          {"leans",
           [](VehicleOdometry& o, double t) {
             o.T_odom_body.linear() = core::so3_exp({0.2 * t, 0, 0}) * o.T_odom_body.linear();
           }},
          {"turns",
           [](VehicleOdometry& o, double t) {
             o.T_odom_body.linear() = core::so3_exp({0, 0, 2 * t}) * o.T_odom_body.linear();
           }},
          {"is not a number", [](VehicleOdometry& o, double) { o.velocity.setConstant(NAN); }}};
}

TEST_P(LyingOdometry, IsRejectedAndTheVehicleComesDown) {
  const Lie lie = lies()[static_cast<std::size_t>(GetParam())];
  SCOPED_TRACE(lie.name);
  MadeVehicle vehicle(windy());
  ASSERT_TRUE(vehicle.fly(3));
  vehicle.guide({0, 0, 3}, 3);
  const Time since = vehicle.now;
  vehicle.distort = [&](VehicleOdometry& o) {
    if (o.stamp > since) lie.tell(o, to_seconds(o.stamp - since));
  };
  bool descends = false;
  for (int i = 0; i < 400 && !descends; ++i) {
    vehicle.guide({0, 0, 3}, 0.02);
    descends = vehicle.state().mode == descend;
  }
  EXPECT_TRUE(descends);
  EXPECT_TRUE(vehicle.state().faults & kOdometryRejected);
  EXPECT_LT((vehicle.position() - Eigen::Vector3d(0, 0, 3)).norm(), 2.0);
  EXPECT_TRUE(vehicle.run_until([&] { return !vehicle.state().armed; }, 20));
  EXPECT_LT(vehicle.body.touchdown_speed(), 1.2);
}

INSTANTIATE_TEST_SUITE_P(Kinds, LyingOdometry, testing::Range(0, 6));

/// The pose stands still while the stamps go on.
TEST(FlightController, FrozenOdometryInFlightIsRejected) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(3));
  std::optional<VehicleOdometry> frozen;
  bool freeze = false;
  vehicle.distort = [&](VehicleOdometry& o) {
    if (!freeze) return;
    if (!frozen) frozen = o;
    const Time stamp = o.stamp;
    o = *frozen;
    o.stamp = stamp;
  };
  double descended_after = NAN;
  for (int i = 0; i < 400 && std::isnan(descended_after); ++i) {
    freeze = i >= 100;
    vehicle.setpoint({i * 0.03, 0, 3}, 0, 0.2, {1.5, 0, 0});
    vehicle.run(0.02);
    if (vehicle.state().mode == descend) descended_after = (i - 100) * 0.02;
  }
  EXPECT_LT(descended_after, 2.0);
  vehicle.run(1.5);
  EXPECT_LT(vehicle.body.state().velocity.head<2>().norm(), 0.3);  // what was a lie is taken back
}

TEST(FlightController, AnnouncedJumpsOfOdomMoveTheReferenceAlong) {
  MadeVehicle vehicle(calm());
  ASSERT_TRUE(vehicle.fly(3));
  const Eigen::Vector3d before = vehicle.position();
  const Time since = vehicle.now;
  vehicle.distort = [&](VehicleOdometry& o) {
    if (o.stamp <= since) return;
    SE3 jump(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
    jump.translation() = Eigen::Vector3d(4, -2, 1);
    o.T_odom_body = jump * o.T_odom_body;
    o.velocity = jump.linear() * o.velocity;
    o.reset_counter = 1;
  };
  vehicle.run(4);
  EXPECT_EQ(vehicle.state().mode, hold);
  EXPECT_LT((vehicle.position() - before).norm(), 0.2);
}

TEST(FlightController, TheSameInputsGiveTheSameThrustsWhateverTheTruth) {
  FlightController a({}, {});
  FlightController b({}, {});
  Quadrotor far_away({}, SE3(Eigen::Translation3d(500, -200, 90)));
  for (int i = 0; i < 500; ++i) {
    const lidar::ImuSample sample{1 + i * 2'000'000LL, {0.1, 0, 9.8}, {0, 0.01, 0}};
    far_away.step(0.002, MotorThrusts::Constant(3), {9, 9, 9}, {0, 0, 0, 0});
    EXPECT_TRUE((a.update(sample, 12.0, 1) == b.update(sample, 12.0, 1)).all());
  }
}

}  // namespace
}  // namespace saker::simulation
