#include "tools/saker/evaluate/box_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace saker::tools {
namespace {

LabelledBox car_at(double x, double y, double yaw = 0, const std::string& vehicle = "") {
  return {"car", vehicle, {x, y, 0}, {4, 2, 1.5}, yaw};
}

/// As many points as a box needs, all at its centre.
std::vector<Eigen::Vector3f> points_at(float x, float y, int count = 50) {
  return std::vector<Eigen::Vector3f>(static_cast<std::size_t>(count), {x, y, 0});
}

std::vector<bool> first_called(std::size_t called, std::size_t all) {
  std::vector<bool> result(all, false);
  std::fill_n(result.begin(), called, true);
  return result;
}

TEST(BoxFigures, ABoxIsRecognisedFromHalfOfItsPoints) {
  BoxFigures figures;
  figures.add(points_at(10, 0), first_called(25, 50), {car_at(10, 0)}, {});
  figures.add(points_at(10, 0), first_called(24, 50), {car_at(10, 0)}, {});
  EXPECT_EQ(figures.kinds().at("car").boxes, 2);
  EXPECT_EQ(figures.kinds().at("car").recognised, 1);
}

TEST(BoxFigures, ABoxWithFewPointsDoesNotCount) {
  BoxFigures figures;
  const auto result = figures.add(points_at(10, 0, 49), first_called(49, 49), {car_at(10, 0)}, {});
  EXPECT_TRUE(figures.kinds().empty());
  EXPECT_EQ(result.boxes.front(), BoxJudgement::Of::uncounted);
}

TEST(BoxFigures, WhatIsFarAwayDoesNotCount) {
  BoxFigures figures;
  figures.add(points_at(41, 0), first_called(50, 50), {car_at(41, 0)}, {});
  EXPECT_TRUE(figures.kinds().empty());
  EXPECT_EQ(figures.called_points(), 0);
}

TEST(BoxFigures, WhatLiesOutsideTheFieldOfViewDoesNotCount) {
  BoxFigures figures;
  figures.add(points_at(0, 10), first_called(50, 50), {car_at(0, 10)}, 40.0F);
  EXPECT_EQ(figures.called_points(), 0);
}

TEST(BoxFigures, PointsJustOutsideABoxAreNotWrong) {
  BoxFigures figures;
  auto points = points_at(10, 1.3F, 3);  // 0.3 m beside it
  points.emplace_back(10.F, 1.5F, 0.F);  // 0.5 m beside it
  figures.add(points, first_called(4, 4), {car_at(10, 0)}, {});
  EXPECT_DOUBLE_EQ(figures.point_precision(), 0.75);
}

TEST(BoxFigures, ATurnedBoxHoldsWhatLiesAlongIt) {
  const LabelledBox box = car_at(0, 0, std::numbers::pi / 2);
  EXPECT_TRUE(box.holds({0, 1.9, 0}, 0));
  EXPECT_FALSE(box.holds({1.9, 0, 0}, 0));
}

TEST(BoxFigures, AVehicleIsRecognisedWhenHalfOfItsBoxesAre) {
  BoxFigures figures;
  for (const std::size_t called : {50, 0}) {
    figures.add(points_at(10, 0), first_called(called, 50), {car_at(10, 0, 0, "a")}, {});
  }
  figures.add(points_at(10, 0), first_called(0, 50), {car_at(10, 0, 0, "b")}, {});
  EXPECT_EQ(figures.kinds().at("car").vehicles.size(), 2U);
  EXPECT_EQ(figures.kinds().at("car").recognised_vehicles(), 1);
}

TEST(BoxFigures, WithoutCalledPointsThereIsNoPrecision) {
  BoxFigures figures;
  figures.add(points_at(10, 0), first_called(0, 50), {car_at(10, 0)}, {});
  EXPECT_TRUE(std::isnan(figures.point_precision()));
}

TEST(VehicleKind, FollowsTheNamesOfDataSets) {
  EXPECT_EQ(vehicle_kind("Car"), "car");
  EXPECT_EQ(vehicle_kind("Pickup Truck"), "car");
  EXPECT_EQ(vehicle_kind("Medium-sized Truck"), "truck");
  EXPECT_EQ(vehicle_kind("BOX_TRUCK"), "truck");
  EXPECT_EQ(vehicle_kind("SCHOOL_BUS"), "bus");
  EXPECT_EQ(vehicle_kind("Other Vehicle - Construction Vehicle"), "other");
  EXPECT_EQ(vehicle_kind("Towed Object"), "other");
}

TEST(VehicleKind, TwoWheelersAndPeopleHaveNone) {
  EXPECT_EQ(vehicle_kind("Motorcycle"), std::nullopt);
  EXPECT_EQ(vehicle_kind("Pedestrian with Object"), std::nullopt);
  EXPECT_EQ(vehicle_kind("Misc"), std::nullopt);
}

}  // namespace
}  // namespace saker::tools
