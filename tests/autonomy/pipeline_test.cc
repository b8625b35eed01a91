#include "saker/autonomy/pipeline.h"

#include <gtest/gtest.h>

#include "saker/autonomy/delayed.h"
#include "saker/core/error.h"

namespace saker::autonomy {
namespace {

SE3 at(double x, double yaw) {
  SE3 T = SE3::Identity();
  T.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation().x() = x;
  return T;
}

TEST(MotionLog, AddsUpTheStepsToTheScanThatWasAskedFor) {
  MotionLog log;
  const Matrix6d step = 0.01 * Matrix6d::Identity();
  for (int i = 1; i <= 10; ++i) log.add(i, at(0, 0), step);
  EXPECT_TRUE(log.take(4).isApprox(4 * step));
  EXPECT_TRUE(log.take(10).isApprox(6 * step));
  EXPECT_TRUE(log.take(20).isZero());
}

TEST(MotionLog, CarriesAnErrorOfHeadingAlongTheWay) {
  MotionLog log;
  Matrix6d turn = Matrix6d::Zero();
  turn(2, 2) = 1e-4;  // 0.01 rad of yaw
  log.add(1, at(0, 0), turn);
  log.add(2, at(10, 0), Matrix6d::Zero());
  EXPECT_NEAR(log.take(2)(4, 4), 1e-4 * 100, 1e-9);  // 0.1 m across after 10 m
}

TEST(LabelledWindow, KeepsTheScansOfItsLength) {
  LabelledWindow window(1.0);
  for (int i = 0; i <= 30; ++i) window.add({from_seconds(0.1 * i), SE3::Identity(), {}, {}});
  const auto scans = window.scans();
  EXPECT_EQ(scans.front().stamp, from_seconds(2.0));
  EXPECT_EQ(scans.back().stamp, from_seconds(3.0));
}

TEST(Delayed, GivesResultsInOrderWhenTheyAreDue) {
  Delayed<int> results;
  results.push(10, 1);
  results.push(20, 2);
  EXPECT_FALSE(results.take(9));
  EXPECT_EQ(results.take(25), 1);
  EXPECT_EQ(results.take(25), 2);
  EXPECT_FALSE(results.take(25));
}

slam::SlamConfig fixed_noise() {
  slam::SlamConfig config;
  config.measurement_noise = slam::NoiseSource::fixed;  // fitted noise needs a model
  return config;
}
const slam::SlamConfig kFixedNoise = fixed_noise();

TEST(Mapping, MakesNothingOfAnEmptyWindow) {
  Mapping mapping({}, kFixedNoise, objects::ClassTable{});
  EXPECT_EQ(mapping.cycle({}, Matrix6d::Identity()), nullptr);
}

TEST(Mapping, SaysWhichShareOfTheNewestScanHasAClass) {
  Mapping mapping({}, kFixedNoise, objects::ClassTable{});
  const auto points = std::make_shared<std::vector<Eigen::Vector3f>>(4, Eigen::Vector3f(5, 0, 0));
  const auto labels = std::make_shared<lidar::Labels>();
  labels->classes = {0, 1, 0, 0};
  labels->probability = {0, 0.9F, 0, 0};
  const std::vector<detection::LabelledScan> window{
      {kNanosecondsPerSecond, SE3::Identity(), points, labels}};
  EXPECT_DOUBLE_EQ(mapping.cycle(window, Matrix6d::Identity())->classified_share, 0.25);
  labels->classes = {0, 0, 0, 0};
  EXPECT_DOUBLE_EQ(mapping.cycle(window, Matrix6d::Identity())->classified_share, 0);
}

TEST(Ingestion, RefusesToTakeOpenBeamsForReturns) {
  const auto sensor =
      lidar::SensorInfo::make_os1(16, 512, lidar::PacketProfile::kRng19Rfl8Sig16Nir16);
  odometry::OdometryConfig config;
  config.max_range_m = 300;
  EXPECT_THROW(Ingestion(config, {}, sensor, SE3::Identity()), Error);
}

}  // namespace
}  // namespace saker::autonomy
