#include "saker/simulation/mission/given_path.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "readings.h"
#include "saker/simulation/vehicle/quadrotor.h"

namespace saker::simulation {
namespace {

template <class F>
double slope(F f, double x, double h = 1e-5) {
  return (f(x + h) - f(x - h)) / (2 * h);
}
template <class F>
double curvature(F f, double x, double h = 1e-4) {
  return (f(x + h) - 2 * f(x) + f(x - h)) / (h * h);
}

TEST(SmoothStep, RunsFromZeroToOneAndStaysThere) {
  EXPECT_EQ(smooth_step(-3), 0);
  EXPECT_EQ(smooth_step(0), 0);
  EXPECT_NEAR(smooth_step(0.5), 0.5, 1e-12);
  EXPECT_NEAR(smooth_step(1), 1, 1e-12);
  EXPECT_NEAR(smooth_step(7), 1, 1e-12);
}

TEST(SmoothStep, NeverFalls) {
  double before = 0;
  for (double x = -0.2; x < 1.2; x += 0.001) {
    EXPECT_GE(smooth_step(x), before - 1e-12);
    before = smooth_step(x);
  }
}

TEST(SmoothStep, IsSymmetricAboutItsMiddle) {
  for (double x = 0; x <= 0.5; x += 0.01)
    EXPECT_NEAR(smooth_step(0.5 + x) + smooth_step(0.5 - x), 1, 1e-12);
}

TEST(SmoothStep, ItsFirstTwoDerivativesAreZeroAtBothEnds) {
  for (const double end : {0.0, 1.0}) {
    EXPECT_NEAR(slope(smooth_step, end), 0, 1e-6);
    EXPECT_NEAR(curvature(smooth_step, end), 0, 5e-3);
  }
}

TEST(SmoothStepIntegral, IsWhatSummingTheStepGives) {
  double sum = 0;
  constexpr double kStep = 1e-4;
  for (int i = 0; i < 20000; ++i) {
    const double x = i * kStep;
    if (i % 1000 == 0) {
      EXPECT_NEAR(smooth_step_integral(x), sum, 1e-4) << x;
    }
    sum += kStep * smooth_step(x + kStep / 2);
  }
}

TEST(SmoothStepIntegral, ItsSlopeIsTheStep) {
  for (double x = -0.5; x < 1.5; x += 0.037)
    EXPECT_NEAR(slope(smooth_step_integral, x), smooth_step(x), 1e-6);
}

TEST(Cruised, BeginsAndEndsAtRest) {
  for (const double duration : {10.0, 24.0, 60.0}) {
    const auto at = [&](double t) { return cruised_s(t, duration); };
    EXPECT_EQ(at(0), 0);
    EXPECT_NEAR(at(kHover), 0, 1e-12);
    EXPECT_NEAR(slope(at, kHover / 2), 0, 1e-9);
    EXPECT_NEAR(slope(at, duration - kHover / 2), 0, 1e-9);
    EXPECT_NEAR(at(duration), at(duration + 5), 1e-9);
  }
}

TEST(Cruised, InTheMiddleASecondIsASecond) {
  const auto at = [](double t) { return cruised_s(t, 40); };
  for (double t = kHover + kRamp; t < 40 - kHover - kRamp; t += 1.3)
    EXPECT_NEAR(slope(at, t), 1, 1e-6);
}

TEST(Cruised, TheWholeFlightIsItsDurationWithoutHoveringAndOneRamp) {
  for (const double duration : {12.0, 24.0, 60.0})
    EXPECT_NEAR(cruised_s(duration, duration), duration - 2 * kHover - kRamp, 1e-9);
}

TEST(Cruised, NoSpeedOrAccelerationJumps) {
  const auto at = [](double t) { return cruised_s(t, 12); };
  double speed = 0, acceleration = 0;
  for (double t = 0; t < 12; t += 0.002) {
    EXPECT_LT(std::abs(slope(at, t) - speed), 0.004) << t;
    EXPECT_LT(std::abs(curvature(at, t) - acceleration), 0.02) << t;
    speed = slope(at, t);
    acceleration = curvature(at, t);
  }
}

TEST(Cruised, AFlightThatIsTooShortToCruiseStillComesToRest) {
  for (const double duration : {3.2, 4.0, 6.0}) {
    const auto at = [&](double t) { return cruised_s(t, duration); };
    EXPECT_GE(at(duration), 0);
    EXPECT_NEAR(slope(at, duration + 0.5), 0, 1e-6) << duration;
  }
}

TEST(Swing, ComesBackAfterItsPeriodAndReachesItsAmplitude) {
  core::Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    const Swing swing = random_swing(0.7, 5, 9, rng);
    EXPECT_GE(swing.period, 5);
    EXPECT_LE(swing.period, 9);
    double most = 0;
    for (double t = 0; t < swing.period; t += 0.01) most = std::max(most, std::abs(swing.at(t)));
    EXPECT_NEAR(most, 0.7, 1e-3);
    EXPECT_NEAR(swing.at(1.3), swing.at(1.3 + swing.period), 1e-9);
  }
}

TEST(LeaningPose, HoveringItIsUprightAndLooksToItsHeading) {
  const Eigen::Vector3d place(3, -2, 7);
  const SE3 T = leaning_pose([&](double) { return place; }, 0.6, 4);
  EXPECT_LT((T.translation() - place).norm(), 1e-12);
  EXPECT_LT((T.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(core::yaw(T.linear()), 0.6, 1e-9);
}

TEST(LeaningPose, LeansIntoItsAcceleration) {
  for (const double a : {0.5, 1.0, 3.0}) {
    const SE3 T =
        leaning_pose([&](double t) { return Eigen::Vector3d(0.5 * a * t * t, 0, 0); }, 0, 0);
    EXPECT_NEAR(std::atan2(T.linear()(0, 2), T.linear()(2, 2)), std::atan(a / kStandardGravity),
                1e-6);
  }
}

TEST(LeaningPose, AtASteadySpeedItLeansAgainstTheDragAlone) {
  const SE3 T = leaning_pose([](double t) { return Eigen::Vector3d(4 * t, 0, 2); }, 0, 3);
  EXPECT_NEAR(std::atan2(T.linear()(0, 2), T.linear()(2, 2)),
              std::atan(0.15 * 4 / kStandardGravity), 1e-6);
}

TEST(LeaningPose, OnACircleItLeansInwards) {
  const auto circle = [](double t) { return Eigen::Vector3d(5 * std::cos(t), 5 * std::sin(t), 3); };
  for (double t = 0; t < 6; t += 0.5) {
    const SE3 T = leaning_pose(circle, 0.2, t);
    const Eigen::Vector3d inwards(-std::cos(t), -std::sin(t), 0);
    EXPECT_NEAR(T.linear().col(2).dot(inwards) / T.linear()(2, 2), 5 / kStandardGravity, 1e-3);
  }
}

TEST(LeaningPose, ItsAxesAreARotation) {
  const auto wild = [](double t) {
    return Eigen::Vector3d(std::sin(3 * t), std::cos(2 * t), 0.4 * std::sin(5 * t));
  };
  for (double t = 0; t < 10; t += 0.37) {
    const Eigen::Matrix3d R = leaning_pose(wild, t, t).linear();
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(R.determinant(), 1, 1e-9);
  }
}

TEST(SimulateImu, OnAStraightLineItReadsTheAccelerationAndG) {
  core::Rng rng(1);
  const PathPose path = [](double t) { return placed(0.5 * 1.2 * t * t, 0, 4); };
  for (const auto& sample : simulate_imu(path, kExact, SE3::Identity(), 1, 0, rng)) {
    EXPECT_LT((sample.acceleration - Eigen::Vector3d(1.2, 0, kStandardGravity)).norm(), 1e-3);
    EXPECT_LT(sample.angular_velocity.norm(), 1e-9);
  }
}

TEST(SimulateImu, TurningOnTheSpotItReadsTheRateAndAtADistanceThePull) {
  core::Rng rng(1);
  const PathPose path = [](double t) { return placed(0, 0, 0, 1.5 * t); };
  for (const auto& sample : simulate_imu(path, kExact, placed(0.2, 0, 0), 1, 0, rng)) {
    EXPECT_LT((sample.angular_velocity - Eigen::Vector3d(0, 0, 1.5)).norm(), 1e-6);
    EXPECT_NEAR(sample.acceleration.x(), -1.5 * 1.5 * 0.2, 1e-3);
  }
}

TEST(SimulateImu, ReadingsAreInTheLidarsAxesHoweverTheUnitIsTurned) {
  const PathPose path = [](double t) { return placed(0.6 * t * t, 0, 0, 0.8 * t); };
  const auto of = [&](const SE3& T_lidar_imu) {
    core::Rng rng(1);
    return simulate_imu(path, kExact, T_lidar_imu, 0.5, 0, rng);
  };
  const auto straight = of(SE3::Identity()), turned = of(placed(0, 0, 0, 2.1));
  ASSERT_EQ(straight.size(), turned.size());
  for (std::size_t i = 0; i < straight.size(); ++i) {
    EXPECT_LT((straight[i].acceleration - turned[i].acceleration).norm(), 1e-3);
    EXPECT_LT((straight[i].angular_velocity - turned[i].angular_velocity).norm(), 1e-6);
  }
}

TEST(SimulateImu, SamplesComeAtTheirRateFromTheStart) {
  core::Rng rng(1);
  ImuConfig config = kExact;
  config.rate_hz = 250;
  const Time start = 5 * kNanosecondsPerSecond;
  const auto samples =
      simulate_imu([](double) { return SE3::Identity(); }, config, SE3::Identity(), 2, start, rng);
  ASSERT_EQ(samples.size(), 500U);
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_NEAR(to_seconds(samples[i].stamp - start), 0.004 * static_cast<double>(i), 1e-8);
}

TEST(SimulateImu, NoiseHasItsSpreadAndTheBiasIsConstant) {
  core::Rng rng(4);
  const ImuConfig config{.rate_hz = 1000,
                         .acceleration_noise = 0.1,
                         .rotation_noise = 0.02,
                         .acceleration_bias = 0.5,
                         .rotation_bias = 0.1};
  Spread force, rate;
  const auto still = [](double) { return SE3::Identity(); };
  for (const auto& sample : simulate_imu(still, config, SE3::Identity(), 5, 0, rng)) {
    force.add(sample.acceleration.x());
    rate.add(sample.angular_velocity.y());
  }
  EXPECT_NEAR(force.sd(), 0.1, 0.005);
  EXPECT_NEAR(rate.sd(), 0.02, 0.001);
  EXPECT_GT(std::abs(force.mean()), 0.01);
  EXPECT_LT(std::abs(force.mean()), 2);
}

}  // namespace
}  // namespace saker::simulation
