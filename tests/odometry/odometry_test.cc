#include "saker/odometry/odometry.h"

#include <gtest/gtest.h>

#include <cstring>

#include "made_world.h"
#include "saker/core/error.h"

namespace saker::odometry {
namespace {

using testing::MadeSensor;
using testing::MadeWorld;
using testing::Motion;

constexpr Time kPeriod = 100'000'000;

struct Flight {
  std::vector<OdometryEstimate> estimates;
  double worst_position_m = 0;
  double worst_rotation_rad = 0;
  int not_registered = 0;
};

/// Flies `count` scans, compared with the motion relative to the first scan (levelled where an IMU
/// is used).
Flight fly(const MadeWorld& world, const MadeSensor& sensor, const Motion& motion, int count,
           bool with_imu, const Eigen::Vector3d& gyro_bias = Eigen::Vector3d::Zero()) {
  Odometry odometry{OdometryConfig{}};
  Flight flight;
  SE3 T_odom_world = motion(kPeriod).inverse();
  for (int k = 1; k <= count; ++k) {
    const Time stamp = k * kPeriod;
    std::vector<lidar::ImuSample> imu;
    if (with_imu) imu = testing::imu(motion, stamp - kPeriod, stamp, gyro_bias);
    flight.estimates.push_back(odometry.register_scan(scan(world, sensor, motion, stamp), imu));
    const OdometryEstimate& estimate = flight.estimates.back();
    if (k == 1) T_odom_world = estimate.T_odom_lidar * T_odom_world;
    const SE3 error = (T_odom_world * motion(stamp)).inverse() * estimate.T_odom_lidar;
    flight.worst_position_m = std::max(flight.worst_position_m, error.translation().norm());
    flight.worst_rotation_rad =
        std::max(flight.worst_rotation_rad, core::so3_log(error.linear()).norm());
    flight.not_registered += !registered(estimate.status);
  }
  return flight;
}

TEST(Odometry, StraightAtConstantSpeedStaysWithinCentimetres) {
  const Flight flight = fly(testing::street(), {}, testing::straight(5), 60, false);
  EXPECT_EQ(flight.not_registered, 0);
  EXPECT_LT(flight.worst_position_m, 0.06);
  EXPECT_LT(flight.worst_rotation_rad, 0.001);
}

TEST(Odometry, WeavingFlightWithoutImuStaysWithinCentimetres) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const Flight flight = fly(testing::street(), sensor, testing::weaving, 200, false);
  EXPECT_EQ(flight.not_registered, 0);
  EXPECT_LT(flight.worst_position_m, 0.15);
  EXPECT_LT(flight.worst_rotation_rad, 0.01);
}

TEST(Odometry, WeavingFlightWithImuAndGyroBiasStaysWithinCentimetres) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const Flight flight =
      fly(testing::street(), sensor, testing::weaving, 200, true, {0.01, -0.02, 0.015});
  EXPECT_EQ(flight.not_registered, 0);
  EXPECT_TRUE(flight.estimates.back().diagnostics.imu_used);
  EXPECT_LT(flight.worst_position_m, 0.1);
  EXPECT_LT(flight.worst_rotation_rad, 0.005);
}

TEST(Odometry, AStreetHoldsThePoseFromTheSecondSecondOn) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const Flight flight = fly(testing::street(), sensor, testing::weaving, 40, true);
  for (std::size_t k = 20; k < 40; ++k) EXPECT_EQ(flight.estimates[k].status, OdometryStatus::ok);
}

TEST(Odometry, OverBareRoughGroundItDriftsByLessThanAHundredthOfTheWay) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  sensor.max_range_m = 40;
  const Flight flight =
      fly(testing::bare_ground(), sensor, testing::straight(3), 150, true, {0.01, -0.02, 0.015});
  EXPECT_EQ(flight.not_registered, 0);
  EXPECT_LT(flight.worst_position_m, 0.45);  // 1 % of the way
}

TEST(Odometry, FirstFrameIsTheFirstScansLidarFrameWithoutImu) {
  Odometry odometry{OdometryConfig{}};
  const auto first =
      odometry.register_scan(scan(testing::street(), {}, testing::weaving, kPeriod), {});
  EXPECT_EQ(first.status, OdometryStatus::ok);
  EXPECT_TRUE(first.T_odom_lidar.isApprox(SE3::Identity(), 1e-12));
}

TEST(Odometry, ImuLevelsTheFirstScan) {
  const Motion tilted = [](Time) {
    SE3 T = SE3::Identity();
    T.translation().z() = 2;
    T.linear() = (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
                     .toRotationMatrix();
    return T;
  };
  Odometry odometry{OdometryConfig{}};
  const auto imu = testing::imu(tilted, 0, kPeriod, Eigen::Vector3d::Zero());
  const auto first = odometry.register_scan(scan(testing::street(), {}, tilted, kPeriod), imu);
  // Up in the world is up in odom, and the x axis keeps its heading: only roll and pitch are
  // undone.
  const Eigen::Vector3d up = tilted(0).linear().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE((first.T_odom_lidar.linear() * up).isApprox(Eigen::Vector3d::UnitZ(), 1e-9));
  EXPECT_NEAR(core::yaw(first.T_odom_lidar.linear()), 0, 1e-9);
}

TEST(Odometry, DeskewedPointsLieOnTheWorldSeenFromTheStamp) {
  const MadeWorld world = testing::street();
  Odometry odometry{OdometryConfig{}};
  OdometryEstimate estimate;
  for (int k = 1; k <= 20; ++k)
    estimate = odometry.register_scan(scan(world, {}, testing::weaving, k * kPeriod), {});
  const SE3 T_world_lidar = testing::weaving(20 * kPeriod);
  int seen = 0, off = 0;
  for (const Eigen::Vector3f& point : estimate.points) {
    if (!point.allFinite()) continue;
    const Eigen::Vector3d p = point.cast<double>();
    const double range =
        world.cast(T_world_lidar.translation(), T_world_lidar.linear() * p.normalized());
    ++seen;
    off += std::abs(range - p.norm()) > 0.01 * p.norm() + 0.02;  // edges seen from elsewhere remain
  }
  EXPECT_GT(seen, 5000);
  EXPECT_LT(off, 0.1 * seen);
}

TEST(Odometry, SameInputGivesTheSameBytes) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const Flight a = fly(testing::street(), sensor, testing::weaving, 15, true);
  const Flight b = fly(testing::street(), sensor, testing::weaving, 15, true);
  for (std::size_t k = 0; k < a.estimates.size(); ++k) {
    EXPECT_EQ(a.estimates[k].T_odom_lidar.matrix(), b.estimates[k].T_odom_lidar.matrix());
    EXPECT_EQ(a.estimates[k].covariance, b.estimates[k].covariance);
    ASSERT_EQ(a.estimates[k].points.size(), b.estimates[k].points.size());
    EXPECT_EQ(std::memcmp(a.estimates[k].points.data(), b.estimates[k].points.data(),
                          a.estimates[k].points.size() * sizeof(Eigen::Vector3f)),
              0);
  }
}

TEST(Odometry, CovarianceIsLargestAlongAFeaturelessCorridor) {
  const Flight flight = fly(testing::corridor(), {}, testing::straight(0), 10, false);
  const Matrix6d& covariance = flight.estimates.back().covariance;
  const double along = std::sqrt(covariance(3, 3));
  EXPECT_GT(along, 2 * std::sqrt(covariance(4, 4)));
  EXPECT_GT(along, 2 * std::sqrt(covariance(5, 5)));
  EXPECT_LT(std::sqrt(covariance(4, 4)), 0.02);  // across
  EXPECT_LT(std::sqrt(covariance(5, 5)), 0.02);  // up
  EXPECT_LT(std::sqrt(covariance(2, 2)), 0.01);  // heading
  EXPECT_EQ(flight.not_registered, 0);
  EXPECT_EQ(flight.estimates.back().status, OdometryStatus::open);
  EXPECT_EQ(flight.estimates.back().reason, OdometryReason::not_held);
}

/// The motion from scan `from` to scan `to` and its error, weighed by the drift that was stated for
/// it.
double squared_error_of_motion(const Flight& flight, std::size_t from, std::size_t to) {
  const auto truth = [](std::size_t k) {
    return testing::weaving(static_cast<Time>(k + 1) * kPeriod);
  };
  Matrix6d drift = Matrix6d::Zero();
  for (std::size_t k = from + 1; k <= to; ++k) {
    const Matrix6d A = core::se3_adjoint(flight.estimates[k].T_odom_lidar.inverse() *
                                         flight.estimates[k - 1].T_odom_lidar);
    drift = (A * drift * A.transpose() + flight.estimates[k].covariance).eval();
  }
  const SE3 found =
      flight.estimates[from].T_odom_lidar.inverse() * flight.estimates[to].T_odom_lidar;
  const Vector6d error = core::se3_log((truth(from).inverse() * truth(to)).inverse() * found);
  return error.dot(drift.ldlt().solve(error)) / 6;
}

TEST(Odometry, SumsOfCovariancesCoverTheErrorsOfLongMotions) {
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  const Flight flight = fly(testing::street(), sensor, testing::weaving, 60, false);
  constexpr std::size_t kLong = 40;
  double sum = 0;
  const std::size_t last = flight.estimates.size() - 1;
  for (std::size_t k = 3; k + kLong <= last; ++k)
    sum += squared_error_of_motion(flight, k, k + kLong);
  const double mean = sum / static_cast<double>(last - kLong - 2);
  EXPECT_LT(mean, 2);     // 1 when exact
  EXPECT_GT(mean, 0.05);  // and not so wide that it says nothing
}

TEST(Odometry, AVehicleAheadThatMovesAlongDoesNotBias) {
  // A van 8 m ahead keeps its distance: in the lidar frame it stands still while the street passes.
  // Both start from rest.
  MadeSensor sensor;
  Odometry odometry{OdometryConfig{}};
  const Motion motion = [](Time time) {
    const double t = std::max(0.0, to_seconds(time - kPeriod));
    SE3 T = SE3::Identity();
    T.translation() << (t < 2.5 ? t * t : 6.25 + 5 * (t - 2.5)), 0, 1.8;
    return T;
  };
  OdometryEstimate estimate;
  for (int k = 1; k <= 40; ++k) {
    MadeWorld world = testing::street();
    const double x = motion(k * kPeriod).translation().x() + 8;
    world.boxes.push_back({{x, -1, 0.3}, {x + 5, 1, 2.6}});
    estimate = odometry.register_scan(scan(world, sensor, motion, k * kPeriod), {});
    ASSERT_EQ(estimate.status, OdometryStatus::ok);
  }
  EXPECT_NEAR(estimate.T_odom_lidar.translation().x(), motion(40 * kPeriod).translation().x(), 0.1);
}

/// A lorry of 9 m about x, beside the sensor, or all around it.
void add_lorry(double x, bool around, MadeWorld& world) {
  world.boxes.push_back({{x - 4.5, 0.8, 0.3}, {x + 4.5, 3.3, 3.8}});
  if (!around) return;
  world.boxes.push_back({{x - 4.5, -0.9, 0}, {x + 4.5, -0.8, 3.8}});
  world.boxes.push_back({{x - 4.5, -0.9, 2.5}, {x + 4.5, 0.9, 3.8}});
  world.boxes.push_back({{x + 4.4, -0.9, 0}, {x + 4.5, 0.9, 3.8}});
  world.boxes.push_back({{x - 4.5, -0.9, 0}, {x - 4.4, 0.9, 3.8}});
}

/// One that passes a vehicle that stands: it comes and goes at 5 m/s.
struct Lorry {
  double speed_mps;  ///< about the sensor
  int around;        ///< scans before and after the one in which its middle is there
};

double place_of(const Lorry& lorry, int scans) {
  const int far = std::max(0, std::abs(scans) - lorry.around);
  const double way = 0.1 * (lorry.speed_mps * (std::abs(scans) - far) + 5 * far);
  return std::copysign(way, scans);
}

class PassingLorry : public ::testing::TestWithParam<Lorry> {};

TEST_P(PassingLorry, DoesNotCarryItAlong) {
  // It hides one side of the street, and for some scans nothing but it is in sight.
  MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  Odometry odometry{OdometryConfig{}};
  const Motion stands = testing::straight(0);
  const std::vector<lidar::ImuSample> samples =
      testing::imu(stands, 0, 80 * kPeriod, Eigen::Vector3d::Zero());
  for (int k = 1; k <= 80; ++k) {
    MadeWorld world = testing::street();
    add_lorry(place_of(GetParam(), k - 40), std::abs(k - 40) <= GetParam().around, world);
    const OdometryEstimate estimate = odometry.register_scan(
        scan(world, sensor, stands, k * kPeriod),
        std::span(samples).subspan(static_cast<std::size_t>(10 * (k - 1)), 10));
    const SE3& is = estimate.T_odom_lidar;
    EXPECT_LT(is.translation().norm(), 0.1) << k << " " << to_string(estimate.status);
  }
}

INSTANTIATE_TEST_SUITE_P(Lorries, PassingLorry,
                         ::testing::Values(Lorry{5, 1}, Lorry{2, 3}, Lorry{2, 6}, Lorry{5, 3},
                                           Lorry{5, 6}, Lorry{7, 6}));

}  // namespace
}  // namespace saker::odometry
