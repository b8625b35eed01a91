#include "tools/saker/evaluate/window_figures.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saker::tools {
namespace {

/// A vehicle of 4.5 × 1.8 m whose windows end at the scans 0 and 1, 12 m ahead.
class WindowFigures : public testing::Test {
 protected:
  WindowFigures() {
    LabelledVehicle vehicle{{4.5, 1.8, 1.5}, true, {}};
    for (std::size_t scan = 0; scan < 2; ++scan) {
      vehicle.labels.push_back({scan, {12, 0, 0}, 0, 100});
    }
    labelled_.tracks[3] = vehicle;
  }

  void measure(double t, double x, double length, double width, objects::ClassId id = 1) {
    objects::Measurement m;
    m.stamp = from_seconds(t);
    m.class_id = id;
    objects::Cuboid cuboid;
    cuboid.pose.translation() = Eigen::Vector3d(x, 0, 0);
    cuboid.size = Eigen::Vector3d(length, width, 1.5);
    m.model = cuboid;
    measurements_.push_back(m);
  }

  [[nodiscard]] std::vector<WindowResult> results() const {
    return window_results(measurements_, {}, poses_, labelled_);
  }
  [[nodiscard]] nlohmann::ordered_json json() const { return window_json(results(), {4.6, 1.9}); }

  std::vector<StampedPose> poses_{{0, SE3::Identity()}, {0.5, SE3::Identity()}};
  LabelledVehicles labelled_;
  std::vector<objects::Measurement> measurements_;
};

TEST_F(WindowFigures, ErrorsAreMeasuredMinusLabelledOfTheNearestMeasurement) {
  measure(0, 12.2, 4.7, 1.7);
  measure(0, 13.0, 9.0, 9.0);
  ASSERT_EQ(results().size(), 1U);
  EXPECT_NEAR(results().front().error[0], 0.2, 1e-12);
  EXPECT_NEAR(results().front().error[1], -0.1, 1e-12);
}

TEST_F(WindowFigures, WhatIsFartherThanOneAndAHalfMetresIsOfNoLabel) {
  measure(0, 13.6, 4.5, 1.8);
  ASSERT_EQ(results().size(), 1U);
  EXPECT_FALSE(results().front().error.allFinite());
  EXPECT_EQ(json()["measured"], 0);
  EXPECT_EQ(json()["labelled"], 1);
  EXPECT_TRUE(json()["size_mae_m"].is_null());
}

TEST_F(WindowFigures, WindowsBetweenScansAreOfNone) {
  measure(0.25, 12, 4.5, 1.8);
  EXPECT_TRUE(results().empty());
}

TEST_F(WindowFigures, MeanErrorsAreThoseOfAllWindowsAndOfOneBox) {
  measure(0, 12, 4.7, 1.7);
  measure(0.5, 12, 4.4, 1.8);
  const auto figures = json();
  EXPECT_EQ(figures["measured"], 2);
  EXPECT_DOUBLE_EQ(figures["length_mae_m"], 0.15);
  EXPECT_DOUBLE_EQ(figures["width_mae_m"], 0.05);
  EXPECT_DOUBLE_EQ(figures["size_mae_m"], 0.1);
  EXPECT_DOUBLE_EQ(figures["length_bias_m"], 0.05);
  EXPECT_DOUBLE_EQ(figures["box_size_mae_m"], 0.1);
}

TEST_F(WindowFigures, CellsAreOfRangeAndAngle) {
  measure(0, 12, 4.5, 1.8);
  const auto cell = json()["cells"].front();
  EXPECT_EQ(cell["range_m"], (std::vector<double>{10, 20}));
  EXPECT_EQ(cell["angle_deg"], (std::vector<double>{0, 15}));
}

TEST(WindowAngle, IsThatFromTheVehiclesLength) {
  for (const double yaw : {0.0, 0.5, -0.5, 2.0}) {
    LabelledVehicles labelled;
    labelled.tracks[0] = {{4.5, 1.8, 1.5}, true, {{0, {12, 0, 0}, yaw, 100}}};
    objects::Measurement m;
    m.class_id = 1;
    m.model = objects::Cuboid{};
    const auto results = window_results({&m, 1}, {}, {{0, SE3::Identity()}}, labelled);
    const double expected = std::min(std::abs(yaw), std::numbers::pi - std::abs(yaw));
    EXPECT_NEAR(results.front().angle_deg, expected * 180 / std::numbers::pi, 1e-9) << yaw;
  }
}

TEST(WindowLabels, OfFewPointsOrFarOffDoNotCount) {
  for (const auto& [range, points] : {std::pair{31.0, 500.0}, {12.0, 99.0}}) {
    LabelledVehicles labelled;
    labelled.tracks[0] = {{4.5, 1.8, 1.5}, true, {{0, {range, 0, 0}, 0, points}}};
    objects::Measurement m;
    m.class_id = 1;
    m.model = objects::Cuboid{};
    EXPECT_TRUE(window_results({&m, 1}, {}, {{0, SE3::Identity()}}, labelled).empty());
  }
}

}  // namespace
}  // namespace saker::tools
