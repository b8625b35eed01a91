#include "tools/saker/experiment/target_figures.h"

#include <gtest/gtest.h>

#include <limits>

namespace saker::tools {
namespace {

/// Vehicles 20 m apart along x and a trunk; `mapped` is what a test makes of them.
class TargetFigures : public testing::Test {
 protected:
  TargetFigures() {
    for (int id = 1; id <= 3; ++id) truth_.objects.push_back(vehicle(id, 20.0 * id, 4.5, 1.8));
  }

  [[nodiscard]] objects::MapObject vehicle(int id, double x, double length, double width) const {
    objects::MapObject object;
    object.id = id;
    object.class_id = table_.find("vehicle");
    object.model = objects::Cuboid{SE3(Eigen::Translation3d(x, 0, 0.75)), {length, width, 1.5}};
    return object;
  }
  [[nodiscard]] Json figures(const std::vector<int>& targets) const {
    return target_figures(mapped_, truth_, targets, table_);
  }

  objects::ClassTable table_;
  objects::ObjectMap truth_, mapped_;
};

TEST_F(TargetFigures, AnEmptyMapHasFoundNothingAndHasNoErrors) {
  const Json f = figures({1, 2, 3});
  EXPECT_EQ(f["targets"], 3);
  EXPECT_EQ(f["found"], 0);
  EXPECT_TRUE(f["mae_m"].is_null());
  EXPECT_TRUE(f["bias_m"].is_null());
  EXPECT_TRUE(f["errors"].empty());
}

TEST_F(TargetFigures, APerfectMapHasErrorsOfNothing) {
  mapped_ = truth_;
  const Json f = figures({1, 2, 3});
  EXPECT_EQ(f["found"], 3);
  EXPECT_NEAR(f["mae_m"].get<double>(), 0, 1e-12);
  EXPECT_NEAR(f["sd_m"].get<double>(), 0, 1e-12);
}

TEST_F(TargetFigures, ErrorsAreMappedMinusTrue) {
  mapped_.objects = {vehicle(0, 20.3, 4.7, 1.7)};
  const Json f = figures({1});
  ASSERT_EQ(f["errors"].size(), 1U);
  EXPECT_EQ(f["errors"][0]["id"], 1);
  EXPECT_NEAR(f["errors"][0]["length_m"].get<double>(), 0.2, 1e-9);
  EXPECT_NEAR(f["errors"][0]["width_m"].get<double>(), -0.1, 1e-9);
  EXPECT_NEAR(f["errors"][0]["distance_m"].get<double>(), 0.3, 1e-9);
}

TEST_F(TargetFigures, BiasAndMeanAreOverLengthsAndWidths) {
  mapped_.objects = {vehicle(0, 20, 4.7, 1.7), vehicle(1, 40, 4.5, 1.8)};
  const Json f = figures({1, 2});
  EXPECT_NEAR(f["bias_m"].get<double>(), 0.1 / 4, 1e-9);
  EXPECT_NEAR(f["mae_m"].get<double>(), 0.3 / 4, 1e-9);
}

TEST_F(TargetFigures, OnlyTargetsCount) {
  mapped_.objects = {vehicle(0, 20, 4.5, 1.8), vehicle(1, 40, 6.5, 1.8)};
  const Json f = figures({1});
  EXPECT_EQ(f["targets"], 1);
  EXPECT_EQ(f["found"], 1);
  EXPECT_NEAR(f["mae_m"].get<double>(), 0, 1e-9);
}

TEST_F(TargetFigures, WithoutCovariancesThereIsNoNees) {
  mapped_.objects = {vehicle(0, 20, 4.7, 1.7)};
  const Json f = figures({1});
  EXPECT_TRUE(f["size_nees"].is_null());
  EXPECT_TRUE(f["errors"][0]["place_nees"].is_null());
}

TEST_F(TargetFigures, ATrunkIsNoTarget) {
  objects::MapObject trunk;
  trunk.id = 9;
  trunk.class_id = table_.find("trunk");
  objects::Cylinder cylinder;
  cylinder.root = {5, 5, 0};
  cylinder.axis = Eigen::Vector3d::UnitZ();
  cylinder.radius = 0.2;
  cylinder.height = 3;
  trunk.model = cylinder;
  truth_.objects.push_back(trunk);
  mapped_.objects = {trunk};
  EXPECT_EQ(figures({9})["found"], 0);
  EXPECT_TRUE(consistency_figures(mapped_, truth_, table_).contains("trunk"));
}

TEST_F(TargetFigures, ClassesOfWhichNothingWasFoundAreLeftOut) {
  mapped_.objects = {vehicle(0, 20, 4.5, 1.8)};
  const Json f = consistency_figures(mapped_, truth_, table_);
  EXPECT_TRUE(f.contains("vehicle"));
  EXPECT_FALSE(f.contains("pole"));
  EXPECT_EQ(f["vehicle"]["objects"], 0) << "none of them has a covariance";
}

TEST(Number, WhatIsNotFiniteIsNull) {
  EXPECT_EQ(number(2.5), 2.5);
  EXPECT_TRUE(number(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_TRUE(number(std::numeric_limits<double>::infinity()).is_null());
}

}  // namespace
}  // namespace saker::tools
