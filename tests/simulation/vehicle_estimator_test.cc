#include "saker/simulation/vehicle/vehicle_estimator.h"

#include <gtest/gtest.h>

#include "readings.h"
#include "saker/simulation/world/mesh.h"

namespace saker::simulation {
namespace {

const Eigen::Vector3d kZero = Eigen::Vector3d::Zero();

/// A vehicle that stands, with a barometer and odometry at 100 Hz.
class StandingVehicle {
 public:
  explicit StandingVehicle(const VehicleEstimatorConfig& config = {}) : estimator(config) {}

  /// Runs on; `say` may change each odometry.
  template <class Say>
  void run(double seconds, Say say) {
    for (const int end = step_ + steps_of(seconds); step_ < end; ++step_) {
      estimator.propagate(reading(step_, kRest, kZero), kStep);
      if (step_ % 10 == 0) estimator.correct_height(barometer_m, 10 * kStep);
      if (step_ % 5 != 0) continue;
      VehicleOdometry odometry = odometry_at(step_, kZero, kZero);
      if (say(odometry)) jump = estimator.receive(odometry);
    }
  }
  void run(double seconds) {
    run(seconds, [](VehicleOdometry&) { return true; });
  }

  VehicleEstimator estimator;
  double barometer_m = 30;
  std::optional<SE3> jump;

 private:
  int step_ = 0;
};

TEST(VehicleEstimator, OdometryThatFitsIsTrusted) {
  StandingVehicle vehicle;
  vehicle.run(5);
  EXPECT_TRUE(vehicle.estimator.trusted());
  EXPECT_STREQ(vehicle.estimator.doubt(), "");
  EXPECT_FALSE(vehicle.jump.has_value());
}

TEST(VehicleEstimator, ItIsStaleHalfASecondAfterTheLastOne) {
  StandingVehicle vehicle;
  vehicle.run(1);
  const auto silent = [](VehicleOdometry&) { return false; };
  vehicle.run(0.45, silent);
  EXPECT_EQ(vehicle.estimator.faults(), 0U);
  vehicle.run(0.1, silent);
  EXPECT_EQ(vehicle.estimator.faults(), kNoOdometry);
}

TEST(VehicleEstimator, ALieIsRejectedAfterTheTimeOfDoubt) {
  StandingVehicle vehicle;
  vehicle.run(2);
  const auto lie = [](VehicleOdometry& o) {
    o.T_odom_body.translation().x() = 3;
    return true;
  };
  vehicle.run(0.2, lie);
  EXPECT_EQ(vehicle.estimator.faults(), 0U);
  vehicle.run(0.1, lie);
  EXPECT_EQ(vehicle.estimator.faults(), kOdometryRejected);
  EXPECT_STREQ(vehicle.estimator.doubt(), "position jumps");
}

TEST(VehicleEstimator, OneOutlierIsForgivenButRemembered) {
  StandingVehicle vehicle;
  vehicle.run(2);
  vehicle.run(0.01, [](VehicleOdometry& o) {
    o.T_odom_body.translation().y() = -4;
    return true;
  });
  vehicle.run(2);
  EXPECT_TRUE(vehicle.estimator.trusted());
  EXPECT_STRNE(vehicle.estimator.doubt(), "");
}

TEST(VehicleEstimator, ATiltThatTheAccelerometerDoesNotSeeIsDoubted) {
  StandingVehicle vehicle;
  vehicle.run(2);
  vehicle.run(1, [](VehicleOdometry& o) {
    o.T_odom_body.linear() = core::so3_exp({0.3, 0, 0});
    return true;
  });
  EXPECT_EQ(vehicle.estimator.faults(), kOdometryRejected);
  EXPECT_STREQ(vehicle.estimator.doubt(), "tilt contradicts the accelerometer");
}

TEST(VehicleEstimator, AHeightThatTheBarometerDoesNotSeeIsDoubted) {
  VehicleEstimatorConfig config;
  config.odometry.position_gate_m = 10;
  config.odometry.position_drift_gate_m = 10;
  StandingVehicle vehicle(config);
  vehicle.run(2);
  vehicle.run(1, [](VehicleOdometry& o) {
    o.T_odom_body.translation().z() = 2;
    return true;
  });
  EXPECT_EQ(vehicle.estimator.faults(), kOdometryRejected);
  EXPECT_STREQ(vehicle.estimator.doubt(), "height contradicts the barometer");
}

TEST(VehicleEstimator, TheBarometersZeroIsOfNoConsequence) {
  StandingVehicle vehicle;
  vehicle.barometer_m = -412;
  vehicle.run(5);
  EXPECT_TRUE(vehicle.estimator.trusted());
}

TEST(VehicleEstimator, ASlowDriftOfTheBarometerIsFollowed) {
  StandingVehicle vehicle;
  vehicle.run(2);
  for (int i = 0; i < 60; ++i) {
    vehicle.barometer_m += 0.04;
    vehicle.run(1);
  }
  EXPECT_TRUE(vehicle.estimator.trusted());
  EXPECT_NEAR(vehicle.estimator.odometry().position().z(), 0, 0.01);
}

TEST(VehicleEstimator, AnAnnouncedJumpIsReturnedAndTrusted) {
  StandingVehicle vehicle;
  vehicle.run(2);
  std::optional<SE3> announced;
  const SE3 T_after_before = placed(7, -3, 0, 0.4);
  vehicle.run(1, [&](VehicleOdometry& o) {
    if (vehicle.jump) announced = vehicle.jump;
    o.T_odom_body = T_after_before * o.T_odom_body;
    o.reset_counter = 1;
    return true;
  });
  ASSERT_TRUE(announced.has_value());
  EXPECT_LT((announced->matrix() - T_after_before.matrix()).norm(), 1e-6);
  EXPECT_TRUE(vehicle.estimator.trusted());
}

TEST(VehicleEstimator, OdometryOutOfItsOrderIsIgnored) {
  StandingVehicle vehicle;
  vehicle.run(1);
  VehicleOdometry old = odometry_at(10, {5, 5, 5}, kZero);
  EXPECT_FALSE(vehicle.estimator.receive(old).has_value());
  EXPECT_TRUE(vehicle.estimator.trusted());
  EXPECT_LT(vehicle.estimator.odometry().position().norm(), 1e-9);
}

TEST(VehicleEstimator, TheInertialEstimateNeverHearsOfOdometry) {
  StandingVehicle with, without;
  with.run(3, [](VehicleOdometry& o) {
    o.T_odom_body.linear() = core::so3_exp({0.1, 0, 1});
    o.velocity = {0.3, 0, 0};
    return true;
  });
  without.run(3, [](VehicleOdometry&) { return false; });
  EXPECT_EQ(with.estimator.inertial().attitude(), without.estimator.inertial().attitude());
  EXPECT_EQ(with.estimator.inertial().height(), without.estimator.inertial().height());
}

TEST(VehicleEstimator, OdometryThatIsLostOrOldIsNone) {
  VehicleEstimator estimator({});
  const auto run_to = [&](int from, int to) {
    for (int i = from; i < to; ++i)
      estimator.propagate(reading(i, {0, 0, kStandardGravity}, {0, 0, 0}), kStep);
  };
  run_to(0, 500);
  EXPECT_EQ(estimator.faults(), kNoOdometry);
  VehicleOdometry odometry = odometry_at(490, {0, 0, 0}, {0, 0, 0});
  odometry.status = VehicleOdometryStatus::lost;
  estimator.receive(odometry);
  EXPECT_EQ(estimator.faults(), kNoOdometry);
  odometry.status = VehicleOdometryStatus::ok;
  estimator.receive(odometry);
  EXPECT_TRUE(estimator.trusted());
  run_to(500, 800);
  EXPECT_EQ(estimator.faults(), kNoOdometry);
}

}  // namespace
}  // namespace saker::simulation
