#include "saker/simulation/vehicle/geometric_controller.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::simulation {
namespace {

const Eigen::Vector3d kZero = Eigen::Vector3d::Zero();
const Eigen::Vector3d kUp(0, 0, kStandardGravity);

FlightReference at(const Eigen::Vector3d& position) {
  FlightReference reference;
  reference.position = position;
  return reference;
}

Eigen::Vector4d wrench_of(const MotorThrusts& thrusts) { return allocation({}) * thrusts.matrix(); }

TEST(GeometricController, WithoutErrorItCarriesTheWeight) {
  GeometricController controller({}, {});
  const Eigen::Vector3d wanted = controller.track(at(kZero), kZero, kZero, 0.002);
  EXPECT_LT((wanted - kUp).norm(), 1e-9);
  const MotorThrusts thrusts =
      controller.thrusts(wanted, 0, kZero, Eigen::Matrix3d::Identity(), kZero);
  const double weight = AirframeConfig().mass_kg * kStandardGravity;
  EXPECT_LT((wrench_of(thrusts) - Eigen::Vector4d(weight, 0, 0, 0)).norm(), 1e-9);
}

TEST(GeometricController, TorqueTurnsTowardsTheWantedAttitude) {
  const GeometricController controller({}, {});
  core::Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d off(rng.normal(0, 0.2), rng.normal(0, 0.2), rng.normal(0, 0.2));
    const Eigen::Matrix3d R = core::so3_exp(off);
    const Eigen::Vector4d wrench = wrench_of(controller.thrusts(kUp, 0, kZero, R, kZero));
    EXPECT_LT(wrench.tail<3>().dot(off), 0);
  }
}

TEST(GeometricController, TorqueBrakesATurn) {
  const GeometricController controller({}, {});
  const Eigen::Vector3d rate(0.5, -0.3, 0.2);
  const Eigen::Vector4d wrench =
      wrench_of(controller.thrusts(kUp, 0, kZero, Eigen::Matrix3d::Identity(), rate));
  EXPECT_LT(wrench.tail<3>().dot(rate), 0);
}

/// A wanted attitude that turns steadily about y.
TEST(GeometricController, KnowsHowFastTheWantedAttitudeTurns) {
  GeometricController controller({}, {});
  const double rate = 0.8, dt = 0.002;
  Eigen::Vector3d turn = kZero;
  for (int i = 0; i < 250; ++i) {
    turn = controller.turn(core::so3_exp({0, rate * i * dt, 0}) * kUp, 0.3, dt);
  }
  EXPECT_LT((turn - Eigen::Vector3d(0, rate, 0.3)).norm(), 0.02);
}

/// Already turning as the wanted attitude does, it asks for no torque.
TEST(GeometricController, ATurnThatIsWantedIsNotBraked) {
  const GeometricController controller({}, {});
  const Eigen::Vector3d rate(0.5, -0.3, 0);
  const Eigen::Vector4d wrench =
      wrench_of(controller.thrusts(kUp, 0, rate, Eigen::Matrix3d::Identity(), rate));
  EXPECT_LT(wrench.head<3>().tail<2>().norm(), 1e-9);
}

TEST(GeometricController, TheTiltThatIsAskedForIsLimited) {
  GeometricController controller({}, {});
  const Eigen::Vector3d wanted = controller.track(at({100, 0, 0}), kZero, {-9, 4, 0}, 0.002);
  const double tilt = std::atan2(wanted.head<2>().norm(), wanted.z());
  EXPECT_LE(tilt, GeometricControllerConfig().most_tilt_deg * std::numbers::pi / 180 + 1e-9);
  EXPECT_GT(tilt, 0.3);
}

TEST(GeometricController, TheIntegralTakesAConstantErrorUpToItsLimit) {
  GeometricController controller({}, {});
  for (int i = 0; i < 100000; ++i) (void)controller.track(at({0.3, 0, 0}), kZero, kZero, 0.002);
  const GeometricControllerConfig config;
  const Eigen::Vector3d wanted = controller.track(at(kZero), kZero, kZero, 0.002);
  EXPECT_NEAR(wanted.x(), config.most_integral, 1e-6);
  controller.forget();
  EXPECT_NEAR(controller.track(at(kZero), kZero, kZero, 0.002).x(), 0, 1e-12);
}

TEST(GeometricController, EveryDemandIsWithinTheMotorsLimits) {
  GeometricController controller({}, {});
  core::Rng rng(5);
  const auto any = [&](double sd) {
    return Eigen::Vector3d(rng.normal(0, sd), rng.normal(0, sd), rng.normal(0, sd));
  };
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d wanted = controller.track(at(any(5)), any(5), any(5), 0.002);
    const MotorThrusts thrusts =
        controller.thrusts(wanted, rng.uniform(-3, 3), any(3), core::so3_exp(any(0.8)), any(3));
    EXPECT_GE(thrusts.minCoeff(), -1e-9);
    EXPECT_LE(thrusts.maxCoeff(), AirframeConfig().most_thrust_n + 1e-9);
  }
}

/// Much yaw torque is asked for: roll and pitch get theirs all the same.
TEST(GeometricController, YawGivesWayToRollAndPitch) {
  const GeometricController controller({}, {});
  const Eigen::Matrix3d R = core::so3_exp({0.1, 0, 0});
  const Eigen::Vector4d calm = wrench_of(controller.thrusts(kUp, 0, kZero, R, kZero));
  const Eigen::Vector4d turning = wrench_of(controller.thrusts(kUp, 0, {0, 0, 40}, R, kZero));
  EXPECT_NEAR(turning[1], calm[1], 0.05 * std::abs(calm[1]));
  EXPECT_GT(turning[3], calm[3]);
}

TEST(GeometricController, AGainOutOfItsBoundsIsRefused) {
  GeometricControllerConfig config;
  config.attitude_gain = -1;
  EXPECT_THROW(GeometricController(config, {}), Error);
}

}  // namespace
}  // namespace saker::simulation
