#include "saker/autonomy/body_pose.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <utility>

#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/lidar/mount.h"

namespace saker::autonomy {
namespace {

constexpr double kGravity = 9.80665;
constexpr Time kImuStep = kNanosecondsPerSecond / 100;

/// A vehicle that flies figures, its heading along with them, after standing for a second.
struct MadeFlightPath {
  static double phase(double t) { return t < 1 ? 0 : 0.6 * ((t - 1) + (std::exp(1 - t) - 1)); }
  static Eigen::Vector3d position(double t) {
    const double a = phase(t);
    return {3 * std::sin(a), 2 * (1 - std::cos(a)), 1 - std::cos(0.7 * a)};
  }
  static SE3 T_odom_body(double t) {
    SE3 T = SE3::Identity();
    const double a = phase(t);
    T.linear() = (Eigen::AngleAxisd(0.8 * a, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(0.1 * std::sin(2 * a), Eigen::Vector3d::UnitY()))
                     .toRotationMatrix();
    T.translation() = position(t);
    return T;
  }
};

/// What IMU and scans on that vehicle say, of a lidar mounted on it, by differences.
class MadeSensors {
 public:
  explicit MadeSensors(const SE3& T_body_lidar) : T_body_lidar_(T_body_lidar) {}

  [[nodiscard]] SE3 T_odom_lidar(double t) const {
    return MadeFlightPath::T_odom_body(t) * T_body_lidar_;
  }
  [[nodiscard]] lidar::ImuSample imu(Time stamp) const {
    const double t = to_seconds(stamp) - 0.005;  // a sample says what was since the last one
    const double h = 1e-3;
    const SE3 before = T_odom_lidar(t - h), at = T_odom_lidar(t), after = T_odom_lidar(t + h);
    const Eigen::Vector3d acceleration =
        (after.translation() - 2 * at.translation() + before.translation()) / (h * h);
    lidar::ImuSample sample;
    sample.stamp = stamp;
    sample.acceleration =
        at.linear().transpose() * (acceleration + Eigen::Vector3d(0, 0, kGravity)) +
        acceleration_bias;
    sample.angular_velocity =
        core::so3_log(before.linear().transpose() * after.linear()) / (2 * h) + rate_bias;
    return sample;
  }

  Eigen::Vector3d acceleration_bias = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_bias = Eigen::Vector3d::Zero();

 private:
  SE3 T_body_lidar_;
};

struct Errors {
  double position_m = 0, velocity_mps = 0, angle_rad = 0;
};

SE3 mount() { return lidar::mount_pose({{0.1, -0.05, 0.12}, {2, -3, 30}}); }

/// The worst errors after `settle_s`; scans come 10 a second, 60 ms late, up to `last_scan_s`.
Errors fly(BodyPose& pose, const MadeSensors& sensors, double noise_m, double settle_s,
           double end_s, double last_scan_s = 1e9) {
  core::Rng rng(3);
  Errors worst;
  std::deque<Time> scans;
  for (Time now = kImuStep; to_seconds(now) < end_s; now += kImuStep) {
    pose.add(sensors.imu(now), now);
    if (now % (10 * kImuStep) == 0 && to_seconds(now) < last_scan_s) scans.push_back(now);
    if (!scans.empty() && now - scans.front() >= 6 * kImuStep) {
      SE3 T = sensors.T_odom_lidar(to_seconds(scans.front()));
      for (int i = 0; i < 3; ++i) T.translation()(i) += rng.normal(0, noise_m);
      pose.correct(scans.front(), T, Matrix6d::Zero());
      scans.pop_front();
    }
    const double t = to_seconds(now);
    if (t < settle_s) continue;
    const VehicleOdometry odometry = pose.at(now);
    const SE3 truth = MadeFlightPath::T_odom_body(t);
    const Eigen::Vector3d velocity =
        (MadeFlightPath::position(t + 1e-4) - MadeFlightPath::position(t - 1e-4)) / 2e-4;
    const SE3 error = truth.inverse() * odometry.T_odom_body;
    worst.position_m = std::max(worst.position_m, error.translation().norm());
    worst.angle_rad = std::max(worst.angle_rad, core::so3_log(error.linear()).norm());
    worst.velocity_mps = std::max(worst.velocity_mps, (odometry.velocity - velocity).norm());
  }
  return worst;
}

TEST(BodyPose, FollowsAFlightWithinCentimetresWhenScansComeLate) {
  BodyPose pose({}, {}, mount());
  const Errors worst = fly(pose, MadeSensors(mount()), 0, 3, 30);
  EXPECT_LT(worst.position_m, 0.02);
  EXPECT_LT(worst.velocity_mps, 0.05);
  EXPECT_LT(worst.angle_rad, 0.01);
}

TEST(BodyPose, LearnsTheBiasesOfTheInertialUnit) {
  BodyPose pose({}, {}, mount());
  MadeSensors sensors(mount());
  sensors.acceleration_bias = {0.15, -0.1, 0.1};
  sensors.rate_bias = {0.01, -0.008, 0.012};
  const Errors worst = fly(pose, sensors, 0, 6, 30);
  EXPECT_LT(worst.position_m, 0.02);
  EXPECT_LT(worst.velocity_mps, 0.05);
  EXPECT_LT(worst.angle_rad, 0.01);
}

TEST(BodyPose, SmoothsTheNoiseOfTheScans) {
  BodyPose pose({}, {}, mount());
  const Errors worst = fly(pose, MadeSensors(mount()), 0.01, 3, 30);
  EXPECT_LT(worst.position_m, 0.06);
  EXPECT_LT(worst.velocity_mps, 0.3);
}

TEST(BodyPose, SaysHowOldItsScanIs) {
  const BodyPoseConfig config;
  BodyPose pose(config, {}, mount());
  EXPECT_EQ(pose.at(kImuStep).status, VehicleOdometryStatus::lost);
  const MadeSensors sensors(mount());
  (void)fly(pose, sensors, 0, 0, 2, 2.0);
  const Time last = from_seconds(1.9);
  const Time fresh = last + from_seconds(config.fresh_s);
  pose.add(sensors.imu(fresh), fresh);
  EXPECT_EQ(pose.at(last + from_seconds(config.fresh_s)).status, VehicleOdometryStatus::ok);
  EXPECT_EQ(pose.at(last + from_seconds(config.fresh_s + 0.02)).status,
            VehicleOdometryStatus::predicted);
  EXPECT_EQ(pose.at(last + from_seconds(config.lost_s + 0.02)).status, VehicleOdometryStatus::lost);
}

TEST(BodyPose, ExtrapolatesNoFartherThanATwentiethOfASecondWhenTheInertialUnitIsSilent) {
  BodyPose pose({}, {}, mount());
  (void)fly(pose, MadeSensors(mount()), 0, 0, 10);
  const Time end = from_seconds(10);
  EXPECT_EQ(pose.at(end).status, VehicleOdometryStatus::ok);
  const VehicleOdometry soon = pose.at(end + from_seconds(0.1)),
                        late = pose.at(end + from_seconds(0.3));
  EXPECT_EQ(soon.status, VehicleOdometryStatus::predicted);
  EXPECT_TRUE(soon.T_odom_body.isApprox(late.T_odom_body));
  EXPECT_EQ(soon.stamp, late.stamp);
}

TEST(BodyPose, CoastsOnTheInertialUnitWhenScansStop) {
  BodyPose pose({}, {}, mount());
  const Errors worst = fly(pose, MadeSensors(mount()), 0, 19, 21, 20.0);
  EXPECT_LT(worst.position_m, 0.15);
}

/// Scans until 20 s, then inertial samples alone for so long; the pose at each.
template <class Look>
void coast(BodyPose& pose, const MadeSensors& sensors, double seconds, Look look) {
  (void)fly(pose, sensors, 0.01, 0, 20);
  for (Time now = from_seconds(20) + kImuStep; to_seconds(now) <= 20 + seconds; now += kImuStep) {
    pose.add(sensors.imu(now), now);
    look(pose.at(now), to_seconds(now));
  }
}

double sd_of(const VehicleOdometry& odometry) {
  return std::sqrt(odometry.covariance.bottomRightCorner<3, 3>().trace());
}

TEST(BodyPose, KnowsThePlaceFor3SecondsOnTheInertialUnitAndStatesHowWell) {
  BodyPose pose({}, {}, mount());
  coast(pose, MadeSensors(mount()), 3, [](const VehicleOdometry& odometry, double t) {
    EXPECT_NE(odometry.status, VehicleOdometryStatus::lost) << t;
    const Eigen::Vector3d off = odometry.T_odom_body.translation() - MadeFlightPath::position(t);
    EXPECT_LT(off.norm(), 3 * sd_of(odometry)) << t;
  });
}

TEST(BodyPose, IsLostWhenTheCovarianceItStatesIsBeyondTheBound) {
  BodyPoseConfig config;
  config.coast_s = 60;
  BodyPose pose(config, {}, mount());
  bool lost = false;
  coast(pose, MadeSensors(mount()), 30, [&](const VehicleOdometry& odometry, double t) {
    lost = lost || odometry.status == VehicleOdometryStatus::lost;
    if (t <= 20 + config.lost_s) return;
    EXPECT_EQ(lost, sd_of(odometry) > config.coast_sd_m) << t;
  });
  EXPECT_TRUE(lost);
}

TEST(BodyPose, IsLostAtTheLatestAfterTheLongestTimeOfCoasting) {
  BodyPoseConfig config;
  config.coast_s = 2;
  config.coast_sd_m = 10;
  BodyPose pose(config, {}, mount());
  coast(pose, MadeSensors(mount()), 2.5, [&](const VehicleOdometry& odometry, double t) {
    const bool over = t > 19.9 + config.coast_s + 0.005;
    EXPECT_EQ(odometry.status == VehicleOdometryStatus::lost, over) << t;
  });
}

TEST(BodyPose, AScanAfter3SecondsOfCoastingIsBelievedAndNoJump) {
  BodyPose pose({}, {}, mount());
  const MadeSensors sensors(mount());
  coast(pose, sensors, 3, [](const VehicleOdometry&, double) {});
  pose.correct(from_seconds(22.95), sensors.T_odom_lidar(22.95), Matrix6d::Zero());
  const VehicleOdometry odometry = pose.at(from_seconds(23));
  EXPECT_EQ(odometry.status, VehicleOdometryStatus::ok);
  EXPECT_EQ(odometry.reset_counter, 0);
  EXPECT_LT((odometry.T_odom_body.translation() - MadeFlightPath::position(23)).norm(), 0.05);
}

// What came of a revolution before the network fell silent: a scan some milliseconds after the last
// one, off by some millimetres, and then none for half a second.
TEST(BodyPose, AScanMillisecondsAfterTheLastOneTeachesNoWrongVelocity) {
  BodyPose pose({}, {}, mount());
  const MadeSensors sensors(mount());
  (void)fly(pose, sensors, 0.003, 0, 10);
  const Time last = from_seconds(9.9), short_after = last + 3'000'000;
  SE3 T = sensors.T_odom_lidar(to_seconds(short_after));
  T.translation() += Eigen::Vector3d(0.004, -0.004, 0.004);
  pose.correct(last, sensors.T_odom_lidar(to_seconds(last)), Matrix6d::Zero());
  pose.correct(short_after, T, Matrix6d::Zero());
  for (Time now = from_seconds(10) + kImuStep; to_seconds(now) <= 10.4; now += kImuStep)
    pose.add(sensors.imu(now), now);
  const VehicleOdometry odometry = pose.at(from_seconds(10.4));
  const SE3 error = MadeFlightPath::T_odom_body(10.4).inverse() * odometry.T_odom_body;
  EXPECT_LT(error.translation().norm(), 0.05);
}

// A forged stamp 5 s ahead carried the pose metres away, with good status, and shut out the samples
// of those 5 s.
TEST(BodyPose, ASampleFarAheadOfTimeIsLeftOut) {
  BodyPose pose({}, {}, mount());
  const MadeSensors sensors(mount());
  (void)fly(pose, sensors, 0, 0, 10);
  const Time now = from_seconds(10);
  for (const Time stamp : {now + from_seconds(5), std::numeric_limits<Time>::max()}) {
    lidar::ImuSample ahead = sensors.imu(now);
    ahead.stamp = stamp;
    pose.add(ahead, now);
  }
  pose.add(sensors.imu(now + kImuStep), now + kImuStep);
  const VehicleOdometry odometry = pose.at(now + kImuStep);
  EXPECT_EQ(odometry.status, VehicleOdometryStatus::ok);
  const SE3 error = MadeFlightPath::T_odom_body(10.01).inverse() * odometry.T_odom_body;
  EXPECT_LT(error.translation().norm(), 0.02);
}

TEST(BodyPose, IsNotOkAheadOfTime) {
  BodyPose pose({}, {}, mount());
  const MadeSensors sensors(mount());
  (void)fly(pose, sensors, 0, 0, 10);
  const Time now = from_seconds(10);
  pose.add(sensors.imu(now + from_seconds(0.1)), now);
  EXPECT_EQ(pose.at(now).status, VehicleOdometryStatus::predicted);
  EXPECT_EQ(pose.at(now + from_seconds(0.1)).status, VehicleOdometryStatus::ok);
}

TEST(BodyPose, ItsCovarianceCoversWhatTheInertialUnitLosesInAGap) {
  BodyPose pose({}, {}, mount());
  MadeSensors sensors(mount());
  sensors.acceleration_bias = {0.05, -0.04, 0.03};
  (void)fly(pose, sensors, 0.01, 0, 10);
  const double sd_before = std::sqrt(pose.at(from_seconds(10)).covariance(3, 3));
  for (Time now = from_seconds(10) + kImuStep; to_seconds(now) <= 11; now += kImuStep)
    pose.add(sensors.imu(now), now);
  const VehicleOdometry odometry = pose.at(from_seconds(11));
  const Vector6d error =
      core::se3_log(odometry.T_odom_body.inverse() * MadeFlightPath::T_odom_body(11));
  EXPECT_GT(std::sqrt(odometry.covariance(3, 3)), 2 * sd_before);
  EXPECT_LT(error.dot(odometry.covariance.ldlt().solve(error)) / 6, 3);  // 1 when exact
}

/// How far a motion of two seconds is off in its sd, at most, and for how long by more than 3.
struct Dishonesty {
  double worst_sd = 0, longest_s = 0;
};

/// After `step` of the inertial unit's biases at 12 s: m/s², and a fiftieth of it in rad/s.
Dishonesty after_step_of_bias(const Eigen::Vector3d& step) {
  constexpr std::size_t kSpan = 200;
  BodyPose pose({}, {}, mount());
  MadeSensors sensors(mount());
  core::Rng rng(3);
  Dishonesty found;
  double over_s = 0;
  std::deque<Time> scans;
  std::deque<std::pair<Eigen::Vector3d, double>> offs;  // said − true, largest variance
  for (Time now = kImuStep; to_seconds(now) < 20; now += kImuStep) {
    if (to_seconds(now) > 12) {
      sensors.acceleration_bias = step;
      sensors.rate_bias = 0.02 * step;
    }
    pose.add(sensors.imu(now), now);
    if (now % (10 * kImuStep) == 0) scans.push_back(now);
    if (!scans.empty() && now - scans.front() >= 6 * kImuStep) {
      SE3 T = sensors.T_odom_lidar(to_seconds(scans.front()));
      for (int i = 0; i < 3; ++i) T.translation()(i) += rng.normal(0, 0.005);
      pose.correct(scans.front(), T, Matrix6d::Zero());
      scans.pop_front();
    }
    const VehicleOdometry said = pose.at(now);
    const Eigen::Matrix3d variance = said.covariance.bottomRightCorner<3, 3>();
    offs.emplace_back(said.T_odom_body.translation() - MadeFlightPath::position(to_seconds(now)),
                      variance.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
    if (offs.size() <= kSpan) continue;
    offs.pop_front();
    if (to_seconds(now) < 6) continue;  // it learns the biases at switch-on
    const double off_sd = (offs.back().first - offs.front().first).norm() /
                          std::sqrt(offs.back().second + offs.front().second);
    over_s = off_sd > 3 ? over_s + 0.01 : 0;
    found.worst_sd = std::max(found.worst_sd, off_sd);
    found.longest_s = std::max(found.longest_s, over_s);
  }
  return found;
}

// `saker faults` found it: a step of 0.5 m/s² left the pose 5 sd off while its status was ok.
// Hazard: Odometry | the bias of the inertial unit steps by up to 1 m/s² | the pose between scans
//   is doubted, its covariance says so, the bias is learnt anew | –
TEST(BodyPose, StaysHonestWhenTheBiasesStep) {
  for (const Eigen::Vector3d& step : {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0, -0.3, 0.4),
                                      Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(-0.6, 0.7, 0.4)}) {
    const Dishonesty found = after_step_of_bias(step);
    EXPECT_LT(found.worst_sd, 5) << step.transpose();
    EXPECT_LT(found.longest_s, 1) << step.transpose();
  }
}

TEST(BodyPose, OneWrongScanIsNoReasonToDoubtTheInertialUnit) {
  BodyPose pose({}, {}, mount()), twin({}, {}, mount());
  const MadeSensors sensors(mount());
  for (BodyPose* each : {&pose, &twin}) (void)fly(*each, sensors, 0, 0, 10);
  for (Time now = from_seconds(10); to_seconds(now) < 12; now += kImuStep) {
    for (BodyPose* each : {&pose, &twin}) each->add(sensors.imu(now), now);
    if (now % (10 * kImuStep) != 0) continue;
    SE3 T = sensors.T_odom_lidar(to_seconds(now));
    twin.correct(now, T, Matrix6d::Zero());
    if (now == from_seconds(11)) T.translation().x() += 0.1;
    pose.correct(now, T, Matrix6d::Zero());
  }
  const Matrix6d covariance = pose.at(from_seconds(12)).covariance;
  EXPECT_TRUE(covariance.isApprox(twin.at(from_seconds(12)).covariance, 0.02));
}

TEST(BodyPose, TakesOverAJumpAndCountsIt) {
  BodyPose pose({}, {}, SE3::Identity());
  pose.correct(kImuStep, SE3::Identity(), Matrix6d::Zero());
  SE3 T = SE3::Identity();
  T.translation().x() = 5;
  pose.correct(11 * kImuStep, T, Matrix6d::Zero());
  const VehicleOdometry odometry = pose.at(11 * kImuStep);
  EXPECT_EQ(odometry.reset_counter, 1);
  EXPECT_DOUBLE_EQ(odometry.T_odom_body.translation().x(), 5);
  EXPECT_DOUBLE_EQ(odometry.velocity.norm(), 0);
}

TEST(BodyPose, LeavesOutWhatIsNotFiniteOrOld) {
  BodyPose pose({}, {}, SE3::Identity());
  pose.correct(20 * kImuStep, SE3::Identity(), Matrix6d::Zero());
  lidar::ImuSample broken;
  broken.stamp = 21 * kImuStep;
  pose.add(broken, broken.stamp);
  SE3 far = SE3::Identity();
  far.translation().x() = 100;
  pose.correct(10 * kImuStep, far, Matrix6d::Zero());
  far.translation().x() = NAN;
  pose.correct(30 * kImuStep, far, Matrix6d::Zero());
  EXPECT_EQ(pose.at(22 * kImuStep).T_odom_body.translation(), Eigen::Vector3d::Zero());
  EXPECT_EQ(pose.at(22 * kImuStep).reset_counter, 0);
}

}  // namespace
}  // namespace saker::autonomy
