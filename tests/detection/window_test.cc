#include "saker/detection/window.h"

#include <gtest/gtest.h>

#include <numbers>

#include "made_scene.h"

namespace saker::detection {
namespace {

using testing::SceneBuilder;

const Eigen::Vector3d kPlace(5, 1, 0);
constexpr std::uint8_t kOther = 0, kVehicle = 1, kTrunk = 2, kPole = 3, kGround = 4;

/// Everything is kept.
WindowConfig all() {
  WindowConfig config;
  config.ground_stride = config.other_stride = config.beam_stride = 1;
  return config;
}

Window gathered(const std::vector<LabelledScan>& scans, const WindowConfig& config = all()) {
  Window window;
  gather(scans, {}, config, window);
  return window;
}

LabelledScan scan_of(const std::vector<Eigen::Vector3d>& points, std::uint8_t class_id,
                     double seconds = 0, const SE3& T_odom_lidar = SE3::Identity()) {
  SceneBuilder scene;
  scene.add(points, class_id);
  return scene.scan(seconds, T_odom_lidar);
}

/// At a place, turned about the vertical and tilted.
SE3 tilted() {
  SE3 T = SE3::Identity();
  T.translation() << 10, -4, 3;
  T.linear() = (Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()))
                   .toRotationMatrix();
  return T;
}

TEST(Window, SensorsStandWhereTheBeamsStart) {
  SE3 T_odom_lidar = SE3::Identity();
  T_odom_lidar.translation() << 10, 0, 0;
  T_odom_lidar.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  LabelledScan scan = SceneBuilder{}.scan(0, T_odom_lidar);
  scan.sensor << 0.8, 0, 1.86;
  const Window window = gathered({scan});
  ASSERT_EQ(window.sensors.size(), 1U);
  EXPECT_LT((window.sensors[0] - Eigen::Vector3d(0, 0.8, 1.86)).norm(), 1e-9);
}

TEST(Window, HoldsEachPointByTheShapeOfItsClass) {
  SceneBuilder scene;
  for (const std::uint8_t id : {kOther, kVehicle, kTrunk, kPole, kGround}) scene.add({kPlace}, id);
  const Window window = gathered({scene.scan(0, SE3::Identity())});
  ASSERT_EQ(window.cuboids.size(), 1u);
  EXPECT_EQ(window.cuboids[0].class_id, kVehicle);
  ASSERT_EQ(window.cylinders.size(), 2u);
  EXPECT_EQ(window.cylinders[0].class_id, kTrunk);
  EXPECT_EQ(window.cylinders[1].class_id, kPole);
  EXPECT_EQ(window.ground.size(), 1u);
  EXPECT_EQ(window.others.size(), 1u);
  EXPECT_EQ(window.beams.size(), 5u) << "of all classes";
}

TEST(Window, ALabelOutsideTheTableIsNoObject) {
  const Window window = gathered({scan_of({kPlace}, 200)});
  EXPECT_EQ(window.others.size(), 1u);
  EXPECT_TRUE(window.cuboids.empty() && window.cylinders.empty() && window.ground.empty());
}

TEST(Window, LiesInALevelFrameAtTheLastScansOrigin) {
  const SE3 T = tilted();
  const Eigen::Vector3d in_odom(12, -3, 1);
  const Window window = gathered({scan_of({in_odom}, kVehicle, 0, T)});
  ASSERT_EQ(window.cuboids.size(), 1u);
  const Eigen::Vector3d in_level = window.cuboids[0].position.cast<double>();
  EXPECT_LT((in_level - (in_odom - T.translation())).norm(), 1e-5);
  EXPECT_LT((window.T_lidar_level * in_level - T.inverse() * in_odom).norm(), 1e-5);
}

TEST(Window, WhatStandsLiesAtOnePlaceHoweverTheSensorMoved) {
  std::vector<LabelledScan> scans;
  for (int i = 0; i < 5; ++i) {
    SE3 T = tilted();
    T.translate(Eigen::Vector3d(0.4 * i, 0, 0.1 * i));
    T.rotate(Eigen::AngleAxisd(0.1 * i, Eigen::Vector3d::UnitX()));
    scans.push_back(scan_of({{15, -2, 1}}, kPole, 0.1 * i, T));
  }
  const Window window = gathered(scans);
  ASSERT_EQ(window.cylinders.size(), 5u);
  for (const ClassPoint& p : window.cylinders) {
    EXPECT_LT((p.position - window.cylinders[0].position).norm(), 1e-5f);
  }
}

TEST(Window, TimesAreRelativeToTheLastScanTheNewestFirst) {
  const Window window =
      gathered({scan_of({kPlace}, kVehicle, 7.0), scan_of({kPlace}, kVehicle, 7.1),
                scan_of({kPlace}, kVehicle, 7.25)});
  ASSERT_EQ(window.seconds.size(), 3u);
  EXPECT_NEAR(window.seconds[0], 0, 1e-9);
  EXPECT_NEAR(window.seconds[1], -0.15, 1e-9);
  EXPECT_NEAR(window.seconds[2], -0.25, 1e-9);
  EXPECT_EQ(window.cuboids[2].scan, 2);
}

TEST(Window, PointsBeyondTheRangeOrNotFiniteAreLeftOut) {
  const WindowConfig config = all();
  const Window window = gathered({scan_of(
      {{config.range_m - 0.1, 0, 0}, {0, config.range_m + 0.1, 0}, {NAN, 0, 0}, {INFINITY, 0, 0}},
      kVehicle)});
  EXPECT_EQ(window.cuboids.size(), 1u);
  EXPECT_EQ(window.beams.size(), 1u);
}

TEST(Window, DoubtfulObjectsAreLeftOutAndNoProbabilityExceedsOne) {
  SceneBuilder scene;
  const auto least = static_cast<float>(all().least_probability);
  for (const float p : {least - 0.01f, least + 0.01f, 1.5f, NAN}) scene.add({kPlace}, kTrunk, p);
  const Window window = gathered({scene.scan(0, SE3::Identity())});
  ASSERT_EQ(window.cylinders.size(), 2u);
  EXPECT_FLOAT_EQ(window.cylinders[0].probability, least + 0.01f);
  EXPECT_EQ(window.cylinders[1].probability, 1);
}

TEST(Window, KeepsEveryFewPointsOfWhatIsNoObject) {
  const std::vector<Eigen::Vector3d> many(30, kPlace);
  WindowConfig config;
  config.ground_stride = 3;
  config.other_stride = 5;
  config.beam_stride = 10;
  EXPECT_EQ(gathered({scan_of(many, kGround)}, config).ground.size(), 10u);
  EXPECT_EQ(gathered({scan_of(many, kOther)}, config).others.size(), 6u);
  EXPECT_EQ(gathered({scan_of(many, kVehicle)}, config).cuboids.size(), 30u);
  EXPECT_EQ(gathered({scan_of(many, kVehicle)}, config).beams.size(), 3u);
}

TEST(Window, OfTooManyPointsTheNewestAreKept) {
  WindowConfig config = all();
  config.most_points = 1500;
  const std::vector<Eigen::Vector3d> many(1000, kPlace);
  const Window window =
      gathered({scan_of(many, kVehicle, 0), scan_of(many, kVehicle, 0.1)}, config);
  ASSERT_EQ(window.cuboids.size(), 1500u);
  EXPECT_EQ(std::ranges::count(window.cuboids, 0, &ClassPoint::scan), 1000);
}

TEST(Window, ScansThatDoNotFitTheirLabelsAreSkipped) {
  LabelledScan cut = scan_of({kPlace, kPlace}, kVehicle);
  auto labels = std::make_shared<lidar::Labels>(*cut.labels);
  labels->classes.pop_back();
  cut.labels = labels;
  LabelledScan blind = scan_of({kPlace}, kVehicle);
  blind.labels = nullptr;
  LabelledScan lost = scan_of({kPlace}, kVehicle);
  lost.T_odom_lidar.translation().x() = NAN;
  const Window window = gathered({cut, blind, lost, scan_of({kPlace}, kVehicle, 1)});
  EXPECT_EQ(window.cuboids.size(), 1u);
  EXPECT_EQ(window.sensors.size(), 1u);
}

TEST(Window, WithoutAPoseOfTheLastScanIsEmpty) {
  Window window = gathered({scan_of({kPlace}, kVehicle)});
  LabelledScan lost = scan_of({kPlace}, kVehicle, 1);
  lost.T_odom_lidar.translation().x() = NAN;
  gather(std::vector{scan_of({kPlace}, kVehicle), lost}, {}, all(), window);
  EXPECT_TRUE(window.cuboids.empty() && window.sensors.empty() && window.beams.empty());
}

TEST(Window, ReflectivityThatDoesNotFitThePointsIsUnknown) {
  LabelledScan scan = scan_of({kPlace, kPlace}, kVehicle);
  scan.reflectivity = std::make_shared<std::vector<float>>(std::vector<float>{0.25f});
  EXPECT_TRUE(std::isnan(gathered({scan}).cuboids[0].reflectivity));
  scan.reflectivity = std::make_shared<std::vector<float>>(std::vector<float>{0.25f, 0.5f});
  EXPECT_EQ(gathered({scan}).cuboids[1].reflectivity, 0.5f);
}

}  // namespace
}  // namespace saker::detection
