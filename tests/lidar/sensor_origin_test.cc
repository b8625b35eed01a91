#include "saker/lidar/sensor_origin.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "made_scan.h"
#include "made_sensor.h"
#include "saker/core/rng.h"
#include "saker/lidar/kitti_folder.h"

namespace saker::lidar {
namespace {

using testing::scan_in;

constexpr float kDegree = 0.0174533F;

/// As PandaSet publishes its scans.
Eigen::Isometry3f car_frame() {
  Eigen::Isometry3f T_car_sensor = Eigen::Isometry3f::Identity();
  T_car_sensor.translation() << 0.8F, 0, 1.86F;
  T_car_sensor.linear() =
      Eigen::AngleAxisf(0.9F * kDegree, Eigen::Vector3f::UnitY()).toRotationMatrix();
  return T_car_sensor;
}

void expect_near(const Eigen::Isometry3f& found, const Eigen::Isometry3f& truth) {
  EXPECT_LT((found.translation() - truth.translation()).norm(), 0.1F);
  const Eigen::Vector3f axis = truth.linear().transpose() * found.linear().col(2);
  EXPECT_LT(std::acos(std::min(axis.z(), 1.0F)), 0.2F * kDegree);
}

TEST(SensorOrigin, IsFoundInACarsFrame) {
  const auto found = find_sensor_origin(scan_in(car_frame()).points);
  ASSERT_TRUE(found);
  expect_near(*found, car_frame());
}

TEST(SensorOrigin, IsFoundBelowAndBehindWithARoll) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() << -1.1F, 0.4F, -0.7F;
  T.linear() = Eigen::AngleAxisf(1.3F * kDegree, Eigen::Vector3f::UnitX()).toRotationMatrix();
  const auto found = find_sensor_origin(scan_in(T).points);
  ASSERT_TRUE(found);
  expect_near(*found, T);
}

TEST(SensorOrigin, IsFoundByRingNumbers) {
  Eigen::Isometry3f T = car_frame();
  T.translation() << -1.3F, 0.5F, 2.4F;
  const Scan scan = scan_in(T);
  const auto found = find_sensor_origin(scan.points, scan.ring);
  ASSERT_TRUE(found);
  expect_near(*found, T);
}

TEST(SensorOrigin, IsNotMovedByRingNumbersWhereTheFrameIsTheSensors) {
  const Scan scan = scan_in(Eigen::Isometry3f::Identity());
  EXPECT_FALSE(find_sensor_origin(scan.points, scan.ring));
}

TEST(SensorOrigin, IsNotToldByRingNumbersThatAreNone) {
  Scan scan = scan_in(car_frame());
  for (std::size_t i = 0; i < scan.size(); ++i) scan.ring[i] = static_cast<std::uint16_t>(i % 64);
  EXPECT_FALSE(find_sensor_origin(scan.points, scan.ring));
}

TEST(SensorOrigin, IsNotMovedWhereTheFrameIsTheSensors) {
  EXPECT_FALSE(find_sensor_origin(scan_in(Eigen::Isometry3f::Identity()).points));
}

TEST(SensorOrigin, IsNotMovedByDecimetres) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  T.translation() << 0.3F, 0, 0.2F;
  EXPECT_FALSE(find_sensor_origin(scan_in(T).points));
}

TEST(SensorOrigin, IsNotToldByTwoSensorsOneOverAnother) {
  Eigen::Isometry3f T_upper = car_frame(), T_lower = car_frame();
  T_lower.translation().z() -= 0.4F;
  Scan both = scan_in(T_upper);
  const Scan lower = scan_in(T_lower);
  both.points.insert(both.points.end(), lower.points.begin(), lower.points.end());
  EXPECT_FALSE(find_sensor_origin(both.points));
}

TEST(SensorOrigin, IsNotToldByARoundPlace) {
  auto file = testing::ring_by_ring(testing::MadeScan{.wall_m = 12}.organised());
  for (Eigen::Vector3f& p : file.scan.points) p = car_frame() * p;
  EXPECT_FALSE(find_sensor_origin(file.scan.points));
}

TEST(SensorOrigin, IsNotToldByFewPointsOrNaN) {
  EXPECT_FALSE(find_sensor_origin(std::vector<Eigen::Vector3f>{}));
  EXPECT_FALSE(find_sensor_origin({100, Eigen::Vector3f(1, 2, 3)}));
  EXPECT_FALSE(find_sensor_origin({5000, Eigen::Vector3f::Constant(NAN)}));
}

TEST(SensorOrigin, IsWhatTheScansAgreeOn) {
  std::vector<Scan> scans = {scan_in(car_frame()), scan_in(car_frame(), 2)};
  for (Scan& scan : scans) scan.ring.clear();
  const auto found = find_sensor_origin(scans);
  ASSERT_TRUE(found);
  expect_near(*found, car_frame());
}

TEST(SensorOrigin, IsNotToldByScansThatDisagree) {
  Eigen::Isometry3f higher = car_frame();
  higher.translation().z() += 0.5F;
  const std::vector<Scan> scans = {scan_in(car_frame()), scan_in(higher)};
  EXPECT_TRUE(find_sensor_origin(std::span(scans).first(1)));
  EXPECT_FALSE(find_sensor_origin(scans));
}

TEST(SensorOrigin, IsDescribedInALine) {
  EXPECT_EQ(describe_sensor_origin(car_frame()),
            "the recording's frame is not the sensor's: beams start at x 0.80 y 0.00 z 1.86 m, "
            "pitched by 0.9°, rolled by 0.0°");
}

void write_scan(const std::filesystem::path& file, const Scan& scan) {
  std::ofstream out(file, std::ios::binary);
  for (const Eigen::Vector3f& p : scan.points) {
    const Eigen::Vector4f values(p.x(), p.y(), p.z(), 0.5F);
    out.write(reinterpret_cast<const char*>(values.data()), sizeof(values));
  }
}

TEST(KittiFolder, SaysWhereTheSensorWas) {
  const testing::TemporaryFolder folder;
  write_scan(folder / "000000.bin", scan_in(car_frame()));
  write_scan(folder / "000001.bin", scan_in(car_frame(), 2));
  KittiFolder source(folder.path());
  EXPECT_NE(source.note().find("the recording's frame is not the sensor's"), std::string::npos);
  expect_near(source.next()->scan.T_lidar_sensor, car_frame());
  expect_near(source.next()->scan.T_lidar_sensor, car_frame());
}

TEST(KittiFolder, SaysNothingWhereTheFrameIsTheSensors) {
  const testing::TemporaryFolder folder;
  write_scan(folder / "000000.bin", scan_in(Eigen::Isometry3f::Identity()));
  KittiFolder source(folder.path());
  EXPECT_EQ(source.note(), "");
  EXPECT_TRUE(source.next()->scan.T_lidar_sensor.matrix().isIdentity());
}

}  // namespace
}  // namespace saker::lidar
