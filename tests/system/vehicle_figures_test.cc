#include "tools/saker/evaluate/vehicle_figures.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::tools {
namespace {

/// A vehicle parked 5 m ahead of a sensor that drives 1 m between its three scans.
class VehicleFiguresTest : public testing::Test {
 protected:
  VehicleFiguresTest() {
    LabelledVehicle vehicle{{4.5, 1.8, 1.5}, true, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      StampedPose pose{static_cast<double>(i), SE3::Identity()};
      pose.T_world_lidar.translation().x() = static_cast<double>(i);
      poses_.push_back(pose);
      vehicle.labels.push_back({i, {5 - pose.T_world_lidar.translation().x(), 0, 0}, 0, 100});
    }
    labelled_.tracks[3] = vehicle;
    labelled_.listed = {3};
  }

  objects::MapObject& add_object(double x, double y, double length = 4.5, double width = 1.8) {
    objects::MapObject object;
    object.id = static_cast<int>(map_.objects.size());
    object.class_id = 1;
    objects::Cuboid cuboid;
    cuboid.pose.translation() = Eigen::Vector3d(x, y, 0);
    cuboid.size = Eigen::Vector3d(length, width, 1.5);
    object.model = cuboid;
    return map_.objects.emplace_back(object);
  }

  [[nodiscard]] VehicleFigures figures(double label_sd_m = 0) const {
    return vehicle_figures(map_, {}, poses_, labelled_, label_sd_m);
  }

  std::vector<StampedPose> poses_;
  LabelledVehicles labelled_;
  objects::ObjectMap map_;
};

TEST_F(VehicleFiguresTest, ErrorsAreMappedMinusLabelledInTheFrameOfTheMap) {
  add_object(5.3, 0.4, 4.7, 1.7);
  const VehicleResult v = figures().vehicles.front();
  EXPECT_TRUE(v.found);
  EXPECT_DOUBLE_EQ(v.position_error_m, 0.5);
  EXPECT_DOUBLE_EQ(v.length_error_m, 0.2);
  EXPECT_DOUBLE_EQ(v.width_error_m, -0.1);
}

TEST_F(VehicleFiguresTest, WhatIsFartherThanOneAndAHalfMetresIsNotFound) {
  add_object(6.6, 0);
  EXPECT_FALSE(figures().vehicles.front().found);
}

TEST_F(VehicleFiguresTest, AReversedBoxHasTheRightAxisAndTheWrongFront) {
  auto& cuboid = std::get<objects::Cuboid>(add_object(5, 0).model);
  cuboid.pose.linear() =
      Eigen::AngleAxisd(std::numbers::pi + 0.1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(figures().vehicles.front().heading_error_deg, 5.7, 1e-9);
  EXPECT_FALSE(figures().vehicles.front().front_right);
}

TEST_F(VehicleFiguresTest, OneObjectIsFoundForOneVehicle) {
  labelled_.tracks[4] = labelled_.tracks[3];
  labelled_.listed = {3, 4};
  add_object(5, 0);
  EXPECT_TRUE(figures().vehicles[0].found);
  EXPECT_FALSE(figures().vehicles[1].found);
}

TEST_F(VehicleFiguresTest, ASecondObjectAtOneVehicleIsADuplicate) {
  add_object(5, 0);
  add_object(5, 1);
  EXPECT_EQ(figures().vehicles.front().duplicates, 1);
}

TEST_F(VehicleFiguresTest, AnObjectOnTheWayOfAMovingVehicleIsInvented) {
  labelled_.tracks[9] = {{4, 2, 1.5}, false, {{0, {20, 0, 0}, 0, 100}}};
  add_object(20, 1.9);
  add_object(20, 2.1);
  EXPECT_EQ(figures().invented, 1);
}

TEST_F(VehicleFiguresTest, ConsistencyHoldsTheMapsAndTheLabelsNoise) {
  add_object(5, 0, 4.8, 1.8).covariance = Eigen::MatrixXd::Identity(9, 9) * 0.05;
  EXPECT_NEAR(figures(0).vehicles.front().size_nees, 0.09 / 0.05 / 2, 1e-9);
  EXPECT_NEAR(figures(0.2).vehicles.front().size_nees, 0.09 / 0.09 / 2, 1e-9);
}

TEST_F(VehicleFiguresTest, ALabelledCentreIsKnownTwiceAsWellAsASize) {
  add_object(5, 0.3).covariance = Eigen::MatrixXd::Identity(9, 9) * 0.05;
  EXPECT_NEAR(figures(0).vehicles.front().place_nees, 0.09 / 0.05 / 2, 1e-9);
  EXPECT_NEAR(figures(0.2).vehicles.front().place_nees, 0.09 / 0.06 / 2, 1e-9);
}

TEST_F(VehicleFiguresTest, WithoutFoundVehiclesFiguresAreNull) {
  const auto json = figures().json();
  EXPECT_EQ(json["found"], 0);
  EXPECT_TRUE(json["size_mae_m"].is_null());
}

TEST_F(VehicleFiguresTest, ALabelOfAScanThatWasNotRunIsAnError) {
  labelled_.tracks[3].labels.front().scan = 3;
  EXPECT_THROW(figures(), Error);
}

TEST(LabelledVehicles, AListedVehicleThatIsNotThereIsAnErrorThatNamesIt) {
  const auto file = std::filesystem::path(testing::TempDir()) / "saker_vehicles.json";
  core::write_file(file, R"({"listed": [7], "vehicles": []})");
  try {
    (void)read_labelled_vehicles(file);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("listed track 7"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace saker::tools
