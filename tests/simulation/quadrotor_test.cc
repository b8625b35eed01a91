#include "saker/simulation/vehicle/quadrotor.h"

#include <gtest/gtest.h>

#include "readings.h"
#include "saker/core/error.h"
#include "saker/simulation/vehicle/instruments.h"
#include "saker/simulation/world/mesh.h"

namespace saker::simulation {
namespace {

constexpr double kTick = 0.001;
const Quadrotor::GroundHeights kFarBelow = {-1e3, -1e3, -1e3, -1e3};
const Quadrotor::GroundHeights kPlain = {0, 0, 0, 0};
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

AirframeConfig dragless() {
  AirframeConfig airframe;
  airframe.rotor_drag = airframe.air_drag = 0;
  return airframe;
}

void run(Quadrotor& q, double seconds, const MotorThrusts& thrusts,
         const Quadrotor::GroundHeights& ground, const Eigen::Vector3d& wind = kStill) {
  for (int i = 0; i < std::lround(seconds / kTick); ++i) q.step(kTick, thrusts, wind, ground);
}

MotorThrusts hovering(const AirframeConfig& airframe) {
  return MotorThrusts::Constant(airframe.mass_kg * kStandardGravity / 4);
}

TEST(Quadrotor, WithoutThrustItFallsByHalfGTSquared) {
  Quadrotor q(dragless(), SE3::Identity());
  run(q, 2, MotorThrusts::Zero(), kFarBelow);
  EXPECT_NEAR(q.state().pose.translation().z(), -0.5 * kStandardGravity * 4, 0.02);
  EXPECT_NEAR(q.state().acceleration.z(), -kStandardGravity, 1e-9);
}

TEST(Quadrotor, ThrustOfItsWeightEndsTheFall) {
  Quadrotor q(dragless(), SE3::Identity());
  run(q, 1, hovering(dragless()), kFarBelow);
  EXPECT_NEAR(q.state().acceleration.norm(), 0, 1e-6);
}

TEST(Quadrotor, ThrustFollowsAStepWithTheMotorsTimeConstant) {
  Quadrotor q({}, SE3::Identity());
  run(q, 0.04, MotorThrusts::Constant(10), kFarBelow);
  EXPECT_NEAR(q.thrusts()[0], 10 * (1 - std::exp(-1)), 0.01);
}

TEST(Quadrotor, ThrustsOutOfTheLimitsAreCut) {
  Quadrotor q({}, SE3::Identity());
  run(q, 1, {1e6, -5, 1, 1}, kFarBelow);
  EXPECT_NEAR(q.thrusts()[0], AirframeConfig().most_thrust_n, 1e-6);
  EXPECT_EQ(q.thrusts()[1], 0);
}

TEST(Quadrotor, EachAxisTurnsAsItsTorqueSays) {
  const AirframeConfig airframe = dragless();
  const Eigen::Matrix4d inverse = allocation(airframe).inverse();
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector4d wrench(airframe.mass_kg * kStandardGravity, 0, 0, 0);
    wrench[axis + 1] = 0.05;
    Quadrotor q(airframe, SE3::Identity());
    run(q, 0.5, (inverse * wrench).array(), kFarBelow);
    const double expected = 0.05 / airframe.inertia()[axis];
    EXPECT_NEAR(q.state().angular_acceleration[axis], expected, 0.01 * expected);
  }
}

TEST(Quadrotor, TorqueFreeTurningKeepsItsAngularMomentum) {
  const AirframeConfig airframe = dragless();
  Quadrotor q(airframe, SE3::Identity());
  const Eigen::Matrix4d inverse = allocation(airframe).inverse();
  run(q, 0.3, (inverse * Eigen::Vector4d(30, 0.2, 0.1, 0.1)).array(), kFarBelow);
  run(q, 1, MotorThrusts::Zero(), kFarBelow);
  const auto momentum = [&] {
    return Eigen::Vector3d(q.state().pose.linear() *
                           airframe.inertia().cwiseProduct(q.state().angular_velocity));
  };
  const Eigen::Vector3d before = momentum();
  ASSERT_GT(before.norm(), 0.02);
  run(q, 2, MotorThrusts::Zero(), kFarBelow);
  EXPECT_LT((momentum() - before).norm(), 0.02 * before.norm());
}

TEST(Quadrotor, WindCarriesItUpToItsSpeed) {
  Quadrotor q({}, SE3::Identity());
  run(q, 60, hovering({}), kFarBelow, {3, 0, 0});
  EXPECT_NEAR(q.state().velocity.x(), 3, 0.1);
}

TEST(Quadrotor, OnTheGroundItStandsStillInWind) {
  AirframeConfig airframe;
  Quadrotor q(airframe, SE3(Eigen::Translation3d(0, 0, airframe.leg_m)));
  run(q, 1, MotorThrusts::Zero(), kPlain);
  const Eigen::Vector3d before = q.state().pose.translation();
  run(q, 20, MotorThrusts::Zero(), kPlain, {5, 3, 0});
  EXPECT_LT((q.state().pose.translation() - before).norm(), 1e-3);
  EXPECT_TRUE(q.on_ground());
  EXPECT_NEAR(before.z(), airframe.leg_m, 0.01);
}

TEST(Quadrotor, TouchdownSpeedIsTheSpeedBeforeTheContact) {
  AirframeConfig airframe = dragless();
  Quadrotor q(airframe, SE3(Eigen::Translation3d(0, 0, airframe.leg_m + 0.2)));
  run(q, 1, MotorThrusts::Zero(), kPlain);
  EXPECT_NEAR(q.touchdown_speed(), std::sqrt(2 * kStandardGravity * 0.2), 0.03);
}

TEST(Quadrotor, TheInertialUnitReadsGAtRestAndNothingInFreeFall) {
  InertialUnit imu(kExact, {0.1, 0, 0}, Eigen::Matrix3d::Identity(), core::Rng(1));
  AirframeConfig airframe = dragless();
  Quadrotor standing(airframe, SE3(Eigen::Translation3d(0, 0, airframe.leg_m)));
  run(standing, 2, MotorThrusts::Zero(), kPlain);
  EXPECT_LT((imu.sample(standing.state(), 0).acceleration - Eigen::Vector3d(0, 0, kStandardGravity))
                .norm(),
            0.01);
  Quadrotor falling(airframe, SE3::Identity());
  run(falling, 0.1, MotorThrusts::Zero(), kFarBelow);
  EXPECT_LT(imu.sample(falling.state(), 0).acceleration.norm(), 1e-9);
}

TEST(Quadrotor, AnImpossibleMassIsRefusedByName) {
  AirframeConfig airframe;
  airframe.mass_kg = -1;
  EXPECT_THROW(Quadrotor(airframe, SE3::Identity()), Error);
}

TEST(Battery, AFullOneHoversForAboutAQuarterOfAnHour) {
  Battery battery({});
  double seconds = 0;
  for (; !battery.empty() && seconds < 1e5; ++seconds) battery.drain(1, hovering({}));
  EXPECT_GT(seconds, 12 * 60);
  EXPECT_LT(seconds, 30 * 60);
}

TEST(Battery, MoreThrustDrainsItFaster) {
  Battery gentle({}), hard({});
  gentle.drain(60, hovering({}));
  hard.drain(60, 1.5 * hovering({}));
  EXPECT_LT(hard.share(), gentle.share());
  EXPECT_LT(gentle.share(), 1);
}

TEST(Allocation, EachMotorLiftsAndTurnsByItsPlace) {
  const AirframeConfig airframe;
  const Eigen::Matrix4d m = allocation(airframe);
  const double a = airframe.arm_m / std::sqrt(2.0);
  EXPECT_TRUE(m.row(0).isApprox(Eigen::RowVector4d::Ones()));
  EXPECT_TRUE(m.row(1).isApprox(a * Eigen::RowVector4d(1, 1, -1, -1)));  // left ones roll right
  EXPECT_TRUE(m.row(2).isApprox(a * Eigen::RowVector4d(-1, 1, 1, -1)));  // rear ones pitch down
}

TEST(Allocation, RotorsOnADiagonalTurnAlikeAndTheOthersTheOtherWay) {
  const Eigen::Matrix4d m = allocation({});
  EXPECT_DOUBLE_EQ(m(3, 0), m(3, 2));
  EXPECT_DOUBLE_EQ(m(3, 1), m(3, 3));
  EXPECT_DOUBLE_EQ(m.row(3).sum(), 0);
}

TEST(Allocation, EveryWrenchHasOneSetOfThrusts) {
  core::Rng rng(5);
  const Eigen::Matrix4d m = allocation({});
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector4d wrench(rng.normal(30, 5), rng.normal(), rng.normal(), rng.normal(0, 0.1));
    EXPECT_LT((m * (m.inverse() * wrench) - wrench).norm(), 1e-9);
  }
}

/// Without drag and thrust, kinetic and potential energy are one.
TEST(Quadrotor, AThrownOneKeepsItsEnergy) {
  const AirframeConfig airframe = dragless();
  Quadrotor q(airframe, SE3::Identity());
  run(q, 1, 2 * hovering(airframe), kFarBelow);
  run(q, 1, MotorThrusts::Zero(), kFarBelow);  // the rotors run out
  const auto energy = [&] {
    const RigidState& s = q.state();
    return 0.5 * airframe.mass_kg * s.velocity.squaredNorm() +
           airframe.mass_kg * kStandardGravity * s.pose.translation().z();
  };
  const double before = energy();
  run(q, 2, MotorThrusts::Zero(), kFarBelow);
  EXPECT_NEAR(energy(), before, 0.005 * std::abs(before));
}

TEST(Quadrotor, ItFallsNoFasterThanTheAirLetsIt) {
  AirframeConfig airframe;
  airframe.rotor_drag = 0;
  Quadrotor q(airframe, SE3::Identity());
  run(q, 20, MotorThrusts::Zero(), kFarBelow);
  const double terminal = std::sqrt(airframe.mass_kg * kStandardGravity / airframe.air_drag);
  EXPECT_NEAR(q.state().velocity.z(), -terminal, 0.01 * terminal);
}

TEST(Quadrotor, TheRotorsDragOnlyInTheirPlane) {
  AirframeConfig airframe;
  airframe.air_drag = 0;
  Quadrotor q(airframe, SE3::Identity());
  run(q, 2, MotorThrusts::Zero(), kFarBelow);
  EXPECT_NEAR(q.state().acceleration.z(), -kStandardGravity, 1e-9);
}

TEST(Quadrotor, TiltedItAcceleratesByGTimesTheTangent) {
  const AirframeConfig airframe = dragless();
  const double tilt = 0.2;
  SE3 T = SE3::Identity();
  T.linear() = core::so3_exp({0, tilt, 0});
  Quadrotor q(airframe, T);
  run(q, 1, hovering(airframe) / std::cos(tilt), kFarBelow);
  EXPECT_NEAR(q.state().acceleration.x(), kStandardGravity * std::tan(tilt), 1e-3);
  EXPECT_NEAR(q.state().acceleration.z(), 0, 1e-3);
}

TEST(Quadrotor, ItsFeetAreBelowItsMotors) {
  const AirframeConfig airframe;
  const Quadrotor q(airframe, placed(1, 2, 3, 0.4));
  for (const Eigen::Vector3d& foot : q.feet()) {
    EXPECT_NEAR(foot.z(), 3 - airframe.leg_m, 1e-12);
    EXPECT_NEAR((foot - Eigen::Vector3d(1, 2, 3)).head<2>().norm(), airframe.arm_m, 1e-12);
  }
}

TEST(Quadrotor, OnItsLegsItStandsAFewMillimetresDeep) {
  const AirframeConfig airframe;
  Quadrotor q(airframe, SE3(Eigen::Translation3d(0, 0, airframe.leg_m + 0.01)));
  run(q, 3, MotorThrusts::Zero(), kPlain);
  EXPECT_NEAR(q.state().pose.translation().z(),
              airframe.leg_m - airframe.mass_kg * kStandardGravity / (4 * 2500), 5e-4);
}

TEST(Quadrotor, OnASlopeItTiltsAlong) {
  const AirframeConfig airframe;
  const double a = airframe.arm_m / std::sqrt(2.0), rise = 0.1;
  const Quadrotor::GroundHeights slope = {a * rise, -a * rise, -a * rise, a * rise};  // along x
  Quadrotor q(airframe, SE3(Eigen::Translation3d(0, 0, airframe.leg_m + 0.02)));
  run(q, 3, MotorThrusts::Zero(), slope);
  EXPECT_NEAR(std::asin(-q.state().pose.linear()(2, 0)), -std::atan(rise), 0.02);
}

TEST(Quadrotor, ItsAttitudeStaysARotation) {
  Quadrotor q({}, SE3::Identity());
  run(q, 5, {9, 7, 8, 7.5}, kFarBelow);
  const Eigen::Matrix3d& R = q.state().pose.linear();
  EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_NEAR(R.determinant(), 1, 1e-9);
}

}  // namespace
}  // namespace saker::simulation
