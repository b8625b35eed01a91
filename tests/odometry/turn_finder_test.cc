#include "saker/odometry/turn_finder.h"

#include <gtest/gtest.h>

#include "made_world.h"
#include "saker/core/rng.h"
#include "saker/odometry/odometry.h"

namespace saker::odometry {
namespace {

using testing::MadeSensor;
using testing::Motion;

constexpr Time kPeriod = 100'000'000;

/// As files without times keep it: the stamp is the middle of the sweep.
lidar::Scan without_times(const MadeSensor& sensor, const Motion& motion, Time stamp) {
  lidar::Scan scan = testing::scan(testing::street(), sensor, motion, stamp + sensor.period / 2);
  scan.stamp = stamp;
  scan.offset_ns.assign(scan.size(), 0);
  return scan;
}

struct Drive {
  std::optional<Turn> turn;
  int scans = 0;  ///< until the turn was found
  double worst_m = 0;
  std::string note;
};

Drive drive(const MadeSensor& sensor, const Motion& motion, int scans,
            const OdometryConfig& config = {}) {
  Odometry odometry(config);
  Drive drive;
  for (int k = 1; k <= scans; ++k) {
    const Time stamp = k * sensor.period;
    const auto estimate = odometry.register_scan(without_times(sensor, motion, stamp), {});
    const SE3 T_first_now = motion(sensor.period).inverse() * motion(stamp);
    const Eigen::Vector3d off = estimate.T_odom_lidar.translation() - T_first_now.translation();
    drive.worst_m = std::max(drive.worst_m, off.norm());
    if (!drive.turn) drive.scans = k;
    drive.turn = odometry.turn();
    EXPECT_EQ(estimate.stamp, stamp);
  }
  drive.note = odometry.times_note();
  return drive;
}

MadeSensor turning(bool clockwise, double begin_rad, Time period = kPeriod) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  sensor.clockwise = clockwise;
  sensor.begin_rad = begin_rad;
  sensor.period = period;
  return sensor;
}

double apart(double a, double b) { return std::abs(std::remainder(a - b, 2 * M_PI)); }

TEST(TurnFinder, FindsTheDirectionAndTheBeginningOfSkewedScans) {
  for (const bool clockwise : {true, false}) {
    for (const double begin : {M_PI, 0.0, 2.0}) {
      const Drive found = drive(turning(clockwise, begin), testing::straight(8), 40);
      ASSERT_TRUE(found.turn) << clockwise << begin;
      EXPECT_EQ(found.turn->clockwise, clockwise) << begin;
      EXPECT_LT(apart(found.turn->begin_rad, begin), 0.45) << clockwise << begin;
    }
  }
}

TEST(TurnFinder, FindsThemAt20Hz) {
  const Drive found = drive(turning(false, 1.0, kPeriod / 2), testing::straight(12), 60);
  ASSERT_TRUE(found.turn);
  EXPECT_FALSE(found.turn->clockwise);
}

TEST(TurnFinder, SeesNoTurnInScansThatWereTakenAtOneInstant) {
  const MadeSensor sensor = turning(true, M_PI);
  Odometry odometry{OdometryConfig{}};
  for (int k = 1; k <= 60; ++k) {
    const Time stamp = k * kPeriod;
    const Motion held = [&](Time) { return testing::straight(8)(stamp); };
    (void)odometry.register_scan(without_times(sensor, held, stamp), {});
  }
  EXPECT_FALSE(odometry.turn());
}

TEST(TurnFinder, SeesNoTurnAtRest) {
  const Drive still = drive(turning(true, M_PI), testing::straight(0), 30);
  EXPECT_FALSE(still.turn);
  EXPECT_NE(still.note.find("too little moves"), std::string::npos);
}

TEST(TurnFinder, TimesByAzimuthBringTheTrajectoryNearerToTheTruth) {
  const MadeSensor sensor = turning(true, M_PI);
  OdometryConfig never;
  never.turn.least_gain = 1e6;
  const Drive skewed = drive(sensor, testing::weaving, 80, never);
  const Drive compensated = drive(sensor, testing::weaving, 80);
  EXPECT_FALSE(skewed.turn);
  EXPECT_TRUE(compensated.turn);
  EXPECT_LT(compensated.worst_m, skewed.worst_m);
}

TEST(TurnFinder, ScansWithTimesAreLeftAlone) {
  Odometry odometry{OdometryConfig{}};
  for (int k = 1; k <= 20; ++k)
    (void)odometry.register_scan(
        testing::scan(testing::street(), {}, testing::straight(8), k * kPeriod), {});
  EXPECT_FALSE(odometry.turn());
  EXPECT_EQ(odometry.times_note(), "");
}

/// What is more than 60° off the sensor's front is not seen.
lidar::Scan front_of(lidar::Scan scan) {
  for (Eigen::Vector3f& point : scan.points)
    if (!(std::abs(azimuth_of(point)) < 1.05F)) point.setConstant(NAN);
  return scan;
}

TEST(TurnFinder, WhereOnlyTheFrontIsSeenPosesStayThoseAtTheStamp) {
  const MadeSensor sensor = turning(true, M_PI);
  const Motion motion = testing::straight(8);
  Odometry odometry{OdometryConfig{}};
  Eigen::Vector3d off_all_around = Eigen::Vector3d::Zero();
  for (int k = 1; k <= 50; ++k) {
    const lidar::Scan whole = without_times(sensor, motion, k * kPeriod);
    const auto estimate = odometry.register_scan(k > 40 ? front_of(whole) : whole, {});
    const SE3 T_first_now = motion(kPeriod).inverse() * motion(k * kPeriod);
    const Eigen::Vector3d off = estimate.T_odom_lidar.translation() - T_first_now.translation();
    if (k <= 40) {
      off_all_around = off;
    } else {
      EXPECT_LT((off - off_all_around).norm(), 0.08) << k;  // a sixth of a sweep is 0.13
    }
  }
  EXPECT_TRUE(odometry.turn());
}

TEST(TurnFinder, ForgetsTheMapThatWasCleared) {
  core::Rng rng(3);
  std::vector<Eigen::Vector3d> points;
  std::vector<float> azimuths;
  for (int i = 0; i < 40; ++i) {
    points.emplace_back(rng.uniform(0.05, 0.55), rng.uniform(0.05, 0.55), rng.normal(0.3, 0.01));
    azimuths.push_back(static_cast<float>(rng.uniform(-M_PI, M_PI)));
  }
  VoxelMap map{VoxelMapConfig{}};
  map.insert(points, 0);
  const Vector6d rising = 0.8 * Vector6d::Unit(5);
  for (const bool cleared : {false, true}) {
    TurnFinder finder({}, 0.6, 1000);
    finder.insert(points, azimuths, SE3::Identity(), rising);
    if (cleared) finder.clear_map();
    finder.compare(points, azimuths, SE3::Identity(), rising, 0.1, map);
    EXPECT_EQ(finder.best().gain > 0, !cleared);
  }
}

TEST(TurnFinder, ScansThatWereLeftOutDoNotMakeASweepLonger) {
  const TurnFinder finder({}, 0.6, 1000);
  EXPECT_EQ(finder.period_of(0.1), 0.1);
  EXPECT_EQ(finder.period_of(0.05), 0.05);
  EXPECT_EQ(finder.period_of(0.5), 0.1);
}

}  // namespace
}  // namespace saker::odometry
