#include "saker/odometry/rotation_track.h"

#include <gtest/gtest.h>

#include "made_imu.h"

namespace saker::odometry {
namespace {

using testing::kUp;
using testing::reading;
using testing::steady;

constexpr int kLast = RotationTrack::kSteps;
const Eigen::Vector3d kRate(0.3, -0.8, 1.5);  // rad/s

RotationTrack track(const std::vector<lidar::ImuSample>& imu, double begin, double end,
                    const Eigen::Vector3d& bias = Eigen::Vector3d::Zero()) {
  return RotationTrack::integrated(imu, from_seconds(begin), from_seconds(end), bias);
}

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return core::so3_log(a.transpose() * b).norm();
}

TEST(RotationTrack, OfASteadyRateIsItsExponential) {
  const RotationTrack turned = track(steady(0, 1, kUp, kRate), 0.2, 0.8);
  EXPECT_TRUE(turned.R_begin_knot[0].isIdentity());
  for (const int knot : {32, 64, kLast}) {
    const double seconds = 0.6 * knot / kLast;
    EXPECT_LT(angle_between(turned.R_begin_knot[knot], core::so3_exp(kRate * seconds)), 1e-6);
  }
}

TEST(RotationTrack, OfARisingRateTurnsByItsMean) {
  std::vector<lidar::ImuSample> imu;
  for (int i = 0; i <= 20; ++i) imu.push_back(reading(0.05 * i, kUp, {0, 0, 2 * 0.05 * i}));
  const RotationTrack turned = track(imu, 0, 1);
  EXPECT_LT(angle_between(turned.R_begin_knot[kLast], core::so3_exp(Eigen::Vector3d(0, 0, 1))),
            1e-6);
  EXPECT_LT(
      angle_between(turned.R_begin_knot[kLast / 2], core::so3_exp(Eigen::Vector3d(0, 0, 0.25))),
      1e-6);
}

TEST(RotationTrack, TakesTheBiasOff) {
  const Eigen::Vector3d bias(0.02, 0.01, -0.03);
  const RotationTrack with = track(steady(0, 1, kUp, kRate + bias), 0, 1, bias);
  const RotationTrack without = track(steady(0, 1, kUp, kRate), 0, 1);
  EXPECT_LT(angle_between(with.R_begin_knot[kLast], without.R_begin_knot[kLast]), 1e-9);
}

TEST(RotationTrack, SkipsWhatIsNotFiniteOrOutOfOrder) {
  std::vector<lidar::ImuSample> imu = steady(0, 1, kUp, kRate);
  const RotationTrack clean = track(imu, 0, 1);
  imu.insert(imu.begin() + 40, reading(0.4, kUp, Eigen::Vector3d::Constant(NAN)));
  imu.insert(imu.begin() + 60, reading(0.1, kUp, {50, 50, 50}));
  EXPECT_LT(angle_between(track(imu, 0, 1).R_begin_knot[kLast], clean.R_begin_knot[kLast]), 1e-9);
}

TEST(RotationTrack, OfRatesThatComeBackEndsWhereItBegan) {
  std::vector<lidar::ImuSample> imu;
  for (int i = 0; i <= 100; ++i) {
    const double phase = 2 * M_PI * i / 100;
    imu.push_back(reading(0.01 * i, kUp, {0, 2 * std::sin(phase), 0}));
  }
  const RotationTrack turned = track(imu, 0, 1);
  EXPECT_LT(angle_between(turned.R_begin_knot[kLast], Eigen::Matrix3d::Identity()), 1e-3);
  EXPECT_GT(angle_between(turned.R_begin_knot[kLast / 2], Eigen::Matrix3d::Identity()), 0.5);
}

TEST(RotationTrack, KnotsAreRotations) {
  for (const Eigen::Matrix3d& R : track(steady(0, 1, kUp, 5 * kRate), 0, 1).R_begin_knot) {
    EXPECT_TRUE((R.transpose() * R).isIdentity(1e-9));
  }
}

bool covers(const std::vector<lidar::ImuSample>& imu, double begin, double end) {
  return odometry::covers(imu, from_seconds(begin), from_seconds(end), 0.05);
}

TEST(Covers, AnIntervalWithoutALongGap) {
  const std::vector<lidar::ImuSample> imu = steady(0, 1);
  EXPECT_TRUE(covers(imu, 0.2, 0.7));
  EXPECT_TRUE(covers(imu, 0, 1.04)) << "its end is within the gap";
  EXPECT_FALSE(covers(imu, 0.5, 1.2));
  EXPECT_FALSE(covers(imu, -0.2, 0.5));
  EXPECT_FALSE(covers({}, 0, 0.01));
}

TEST(Covers, NoIntervalWithAHole) {
  std::vector<lidar::ImuSample> imu = steady(0, 1);
  std::erase_if(imu, [](const lidar::ImuSample& s) {
    return s.stamp > from_seconds(0.401) && s.stamp < from_seconds(0.479);
  });
  EXPECT_FALSE(covers(imu, 0.2, 0.7));
  EXPECT_TRUE(covers(imu, 0.5, 0.9));
}

TEST(Level, TurnsTheMeanForceUpAndNothingElse) {
  for (const double roll : {-0.4, 0.0, 0.9}) {
    for (const double pitch : {-0.6, 0.2}) {
      const Eigen::Matrix3d R_level_lidar = (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                                             Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                                                .toRotationMatrix();
      const Eigen::Matrix3d R = level(steady(0, 0.2, R_level_lidar.transpose() * kUp));
      EXPECT_TRUE(R.isApprox(R_level_lidar, 1e-9)) << roll << " " << pitch;
      EXPECT_NEAR(core::yaw(R), 0, 1e-9);
    }
  }
}

TEST(Level, WithoutUsableSamplesIsTheIdentity) {
  EXPECT_TRUE(level({}).isIdentity());
  EXPECT_TRUE(level(steady(0, 0.1, Eigen::Vector3d::Constant(NAN))).isIdentity());
  EXPECT_TRUE(level(steady(0, 0.1, Eigen::Vector3d::Zero())).isIdentity());
}

}  // namespace
}  // namespace saker::odometry
