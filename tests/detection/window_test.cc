#include "saker/detection/window.h"

#include <gtest/gtest.h>

#include <numbers>

#include "made_scene.h"

namespace saker::detection {
namespace {

TEST(Window, SensorsStandWhereTheBeamsStart) {
  SE3 T_odom_lidar = SE3::Identity();
  T_odom_lidar.translation() << 10, 0, 0;
  T_odom_lidar.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  LabelledScan scan = testing::SceneBuilder{}.scan(0, T_odom_lidar);
  scan.sensor << 0.8, 0, 1.86;
  Window window;
  gather(std::span(&scan, 1), {}, {}, window);
  ASSERT_EQ(window.sensors.size(), 1U);
  EXPECT_LT((window.sensors[0] - Eigen::Vector3d(0, 0.8, 1.86)).norm(), 1e-9);
}

}  // namespace
}  // namespace saker::detection
