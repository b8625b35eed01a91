#include <gtest/gtest.h>

#include <numbers>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/mounting.h"
#include "mavlink_autopilot.h"
#include "saker/core/rng.h"

namespace saker::flight::mavlink {
namespace {

using Eigen::AngleAxisd, Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;

const std::vector<double> kPlace = {-0.12, 0.05, -0.2}, kTurned = {4, -3, 90};

SE3 T_body_autopilot() {
  constexpr double kDegree = std::numbers::pi / 180;
  SE3 T = SE3::Identity();
  T.linear() =
      (AngleAxisd(90 * kDegree, Vector3d::UnitZ()) * AngleAxisd(-3 * kDegree, Vector3d::UnitY()) *
       AngleAxisd(4 * kDegree, Vector3d::UnitX()))
          .toRotationMatrix();
  T.translation() = Vector3d::Map(kPlace.data());
  return T;
}

/// A body that goes round, climbs and rolls, at any time; `t` in s.
SE3 T_odom_body(double t) {
  SE3 T = SE3::Identity();
  T.linear() = core::so3_exp(Vector3d(0.3 * std::sin(2 * t), 0.2 * std::cos(t), 0.9 * t));
  T.translation() = Vector3d(3 * std::cos(t), 2 * std::sin(t), 0.5 * t);
  return T;
}

constexpr double kStep = 1e-5;  // s, of central differences

template <class F>
Vector3d rate(const F& place, double t) {
  return (place(t + kStep) - place(t - kStep)) / (2 * kStep);
}

/// Of a frame, in itself.
template <class F>
Vector3d turning(const F& T, double t) {
  return core::so3_log(T(t - kStep).linear().transpose() * T(t + kStep).linear()) / (2 * kStep);
}

VehicleOdometry odometry_at(double t) {
  VehicleOdometry o;
  o.stamp = from_seconds(100 + t);
  o.T_odom_body = T_odom_body(t);
  o.velocity = rate([](double s) { return Vector3d(T_odom_body(s).translation()); }, t);
  o.angular_velocity = turning(T_odom_body, t);
  o.covariance = Matrix6d::Identity() * 1e-4;
  o.status = VehicleOdometryStatus::ok;
  return o;
}

TEST(MavlinkMounting, PoseAndVelocitiesAreThoseOfThePointWhereTheAutopilotIs) {
  const Mounting mounting(kPlace, kTurned);
  const auto T_odom_autopilot = [](double t) { return SE3(T_odom_body(t) * T_body_autopilot()); };
  for (const double t : {0.0, 0.4, 1.7, 3.0}) {
    const VehicleOdometry o = mounting.odometry(odometry_at(t));
    EXPECT_TRUE(o.T_odom_body.isApprox(T_odom_autopilot(t), 1e-12));
    const Vector3d v =
        rate([&](double s) { return Vector3d(T_odom_autopilot(s).translation()); }, t);
    EXPECT_TRUE(o.velocity.isApprox(v, 1e-6)) << o.velocity.transpose() << " " << v.transpose();
    EXPECT_TRUE(o.angular_velocity.isApprox(turning(T_odom_autopilot, t), 1e-6));
  }
}

/// The same errors of the body's pose, seen at the autopilot.
TEST(MavlinkMounting, TheCovarianceIsThatOfErrorsSeenAtTheAutopilot) {
  VehicleOdometry o = odometry_at(0.7);
  Vector6d sd;
  sd << 2e-3, 1e-3, 3e-3, 0.01, 0.02, 0.005;
  o.covariance = sd.cwiseProduct(sd).asDiagonal();
  const Matrix6d stated = Mounting(kPlace, kTurned).odometry(o).covariance;
  const SE3 truth = o.T_odom_body * T_body_autopilot();
  core::Rng rng(3);
  Matrix6d sampled = Matrix6d::Zero();
  constexpr int kSamples = 20'000;
  for (int i = 0; i < kSamples; ++i) {
    Vector6d error;
    for (int k = 0; k < 6; ++k) error(k) = rng.normal(0, sd(k));
    const SE3 seen = o.T_odom_body * core::se3_exp(error) * T_body_autopilot();
    const Vector6d at_autopilot = core::se3_log(truth.inverse() * seen);
    sampled += at_autopilot * at_autopilot.transpose() / kSamples;
  }
  EXPECT_LT((stated - sampled).norm(), 0.03 * sampled.norm());
}

TEST(MavlinkMounting, ASetpointThatTurnsMovesTheAutopilotAboutTheBody) {
  const Mounting mounting(kPlace, {0, 0, 90});
  constexpr double kRate = 0.8;
  const auto setpoint = [&](double t) {
    Setpoint s;
    s.position = Vector3d(1 + 0.5 * t, 2 - t, 3);
    s.velocity = Vector3d(0.5, -1, 0);
    s.acceleration.setZero();
    s.yaw = 0.2 + kRate * t;
    s.yaw_rate = kRate;
    return mounting.setpoint(s);
  };
  const Setpoint s = setpoint(1.1);
  const Vector3d lever =
      AngleAxisd(0.2 + kRate * 1.1, Vector3d::UnitZ()) * Vector3d(-0.12, 0.05, -0.2);
  EXPECT_TRUE(s.position.isApprox(Vector3d(1.55, 0.9, 3) + lever, 1e-12));
  EXPECT_TRUE(s.velocity.isApprox(rate([&](double t) { return setpoint(t).position; }, 1.1), 1e-6));
  EXPECT_LT((s.acceleration - rate([&](double t) { return setpoint(t).velocity; }, 1.1)).norm(),
            1e-6);
  EXPECT_NEAR(s.yaw, 0.2 + kRate * 1.1 + std::numbers::pi / 2, 1e-12);
}

TEST(MavlinkMounting, WhatIsNotAskedForStaysNoNumber) {
  Setpoint s;
  s.position.setZero();
  s.yaw = 0;
  const Setpoint at = Mounting(kPlace, kTurned).setpoint(s);
  EXPECT_TRUE(at.velocity.array().isNaN().all());
  EXPECT_TRUE(at.acceleration.array().isNaN().all());
  EXPECT_TRUE(at.position.allFinite());
}

TEST(MavlinkMounting, TheBodysAttitudeComesBack) {
  const Mounting mounting(kPlace, kTurned);
  const Quaterniond of_autopilot(Matrix3d((T_odom_body(1.3) * T_body_autopilot()).linear()));
  EXPECT_LT(mounting.attitude(of_autopilot).angularDistance(Quaterniond(T_odom_body(1.3).linear())),
            1e-9);
}

TEST(MavlinkMounting, AtTheBodysOriginNothingChanges) {
  const VehicleOdometry o = odometry_at(0.9);
  const VehicleOdometry same = Mounting({0, 0, 0}, {0, 0, 0}).odometry(o);
  EXPECT_EQ(same.T_odom_body.matrix(), o.T_odom_body.matrix());
  EXPECT_EQ(same.velocity, o.velocity);
  EXPECT_EQ(same.covariance, o.covariance);
}

TEST(MavlinkMounting, TwoNumbersAreNoPlace) {
  EXPECT_THROW(Mounting({0, 0}, {0, 0, 0}), std::runtime_error);
  EXPECT_THROW(Mounting({0, 0, 0}, {0, 0, 0, 0}), std::runtime_error);
}

/// On the wire: ODOMETRY and setpoints of an autopilot 0.3 m behind the body, in one frame.
TEST(MavlinkMounting, TheBridgeSaysOdometryAndSetpointsOfTheAutopilot) {
  BridgeConfig config;
  config.place_m = {-0.3, 0, 0};
  Flown flown(Autopilot::ardupilot, config);
  flown.take_off();
  EXPECT_NEAR(flown.last<Odometry>().x, -0.3, 1e-3);
  EXPECT_NEAR(flown.last<SetPositionTargetLocalNed>().x, -0.3, 1e-3);
  flown.setpoints_run = true;
  flown.run(2000 * kMs);
  const double x = flown.craft().place().x();
  EXPECT_GT(x, 0.5);
  EXPECT_NEAR(flown.last<SetPositionTargetLocalNed>().x, x - 0.3, 0.02);
}

}  // namespace
}  // namespace saker::flight::mavlink
