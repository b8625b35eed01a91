#include "saker/autonomy/contact_sense.h"

#include <gtest/gtest.h>

#include "saker/core/rng.h"
#include "saker/lidar/mount.h"
#include "saker/simulation/vehicle/quadrotor.h"

namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 100;
constexpr double kGravity = simulation::kStandardGravity;

SE3 mount() { return lidar::mount_pose({{0.1, -0.05, 0.12}, {2, -3, 30}}); }

/// A body that hovers, and what its accelerometer says beside.
class ContactSenseTest : public testing::Test {
 protected:
  /// m/s², rad/s, body: beside gravity.
  void feel(const Eigen::Vector3d& force, const Eigen::Vector3d& rate = Eigen::Vector3d::Zero()) {
    now += kStep;
    lidar::ImuSample sample;
    sample.stamp = now;
    const Eigen::Matrix3d R_lidar_body = T_body_lidar.linear().transpose();
    sample.acceleration = R_lidar_body * (force + Eigen::Vector3d(0, 0, kGravity));
    sample.angular_velocity = R_lidar_body * rate;
    sense.add(sample);
  }
  void hover(double seconds) {
    for (double t = 0; t < seconds; t += 0.01) feel(Eigen::Vector3d::Zero());
  }
  [[nodiscard]] bool felt() const { return sense.last().stamp != 0; }

  const SE3 T_body_lidar = mount();
  ContactSense sense{ContactConfig{}, T_body_lidar};
  Time now = 100 * kNanosecondsPerSecond;
};

TEST_F(ContactSenseTest, FeelsAnyOfSixSidesWithinSomeSamples) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  for (const Eigen::Vector3d& side : {x, y, Eigen::Vector3d(-x), Eigen::Vector3d(-y)}) {
    sense = ContactSense(ContactConfig{}, T_body_lidar);
    hover(2);
    const Time touched = now;
    for (int i = 0; i < 5; ++i) feel(15 * side);
    ASSERT_TRUE(felt());
    EXPECT_LE(to_seconds(sense.last().stamp - touched), 0.06);
    EXPECT_NEAR(sense.last().force_mps2, 15, 0.1);
  }
  for (const double along : {60.0, -25.0}) {
    sense = ContactSense(ContactConfig{}, T_body_lidar);
    hover(2);
    for (int i = 0; i < 6; ++i) feel({0, 0, along});
    EXPECT_TRUE(felt()) << along;
  }
}

TEST_F(ContactSenseTest, OneBrokenReadingIsNone) {
  hover(2);
  feel({150, -80, 200});
  hover(1);
  EXPECT_FALSE(felt());
}

TEST_F(ContactSenseTest, VibrationIsNone) {
  core::Rng rng(5);
  for (int i = 0; i < 3000; ++i) feel({rng.normal(0, 3), rng.normal(0, 3), rng.normal(0, 5)});
  EXPECT_FALSE(felt());
}

TEST_F(ContactSenseTest, ABiasOrASteadyWindIsNone) {
  for (int i = 0; i < 500; ++i) feel({std::min(8.0, 0.04 * i), 0, 0});
  EXPECT_FALSE(felt());
}

TEST_F(ContactSenseTest, TurningAtTheLeverOfTheMountIsNone) {
  hover(2);
  const Eigen::Vector3d lever = T_body_lidar.translation();
  for (int i = 1; i <= 20; ++i) {
    const Eigen::Vector3d turn(0, 0, 60);  // rad/s²
    const Eigen::Vector3d rate = 0.01 * i * turn;
    feel(turn.cross(lever) + rate.cross(rate.cross(lever)), rate);
  }
  EXPECT_FALSE(felt());
}

TEST_F(ContactSenseTest, AfterAGapItBeginsAnew) {
  hover(2);
  feel({15, 0, 0});
  now += kNanosecondsPerSecond;
  for (int i = 0; i < 2; ++i) feel({15, 0, 0});
  EXPECT_FALSE(felt());
}

/// Full thrust, none, and gusts of 12 m/s from one moment to the next; and then a wall.
TEST(ContactSenseOfAQuadrotor, HardFlightIsNoneAndAWallIsOne) {
  const simulation::AirframeConfig airframe;
  SE3 start = SE3::Identity();
  start.translation().z() = 500;
  simulation::Quadrotor body(airframe, start);
  ContactSense sense({}, SE3::Identity());
  core::Rng rng(7);
  simulation::MotorThrusts thrusts = simulation::MotorThrusts::Constant(8);
  const Eigen::Vector3d still = Eigen::Vector3d::Zero();
  Eigen::Vector3d wind = still;
  const auto step = [&](int i, const Eigen::Vector3d& push) {
    body.step(1e-3, thrusts, wind, {0, 0, 0, 0});
    if (i % 10 != 0) return;
    lidar::ImuSample sample;
    sample.stamp = (1000 + i) * kNanosecondsPerSecond / 1000;
    const Eigen::Vector3d g(0, 0, -kGravity);
    sample.acceleration =
        body.state().pose.linear().transpose() * (body.state().acceleration - g) + push;
    sample.angular_velocity = body.state().angular_velocity;
    sense.add(sample);
  };
  int i = 0;
  for (; i < 6000; ++i) {
    if (i % 400 == 0) thrusts.setConstant(rng.uniform(0, 16));
    if (i % 1500 == 0) wind = i % 3000 == 0 ? Eigen::Vector3d(7.2, -9.6, 0) : still;
    step(i, Eigen::Vector3d::Zero());
  }
  ASSERT_EQ(sense.last().stamp, 0) << sense.last().force_mps2;
  for (const int end = i + 60; i < end; ++i) step(i, {0, -15, 0});
  EXPECT_NE(sense.last().stamp, 0);
}

}  // namespace
}  // namespace saker::autonomy
