#include "saker/detection/detection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_scene.h"
#include "saker/core/error.h"

namespace saker::detection {
namespace {

using testing::SceneBuilder;
using testing::visible_box;
using testing::visible_cylinder;

SE3 sensor_at(double height) {
  SE3 T = SE3::Identity();
  T.translation().z() = height;
  return T;
}

/// A parked vehicle, a trunk and a pole on a slope, seen from a sensor that flies by, tilted.
std::vector<LabelledScan> flight(double slope) {
  std::vector<LabelledScan> scans;
  core::Rng rng(11);
  for (int i = 0; i < 10; ++i) {
    SE3 T = SE3::Identity();
    T.translation() = Eigen::Vector3d(0.3 * i, 0, 4);
    T.linear() = Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitY()).toRotationMatrix();
    SceneBuilder scene;
    scene.add_ground(slope, 30, rng);
    scene.solids = {{.x = 9, .y = 4, .yaw = 0.5, .z = 9 * slope}};
    auto box = testing::visible_box({9, 4, 0.5}, T.translation(), 400, 0.02, rng);
    for (auto& p : box) p.z() += slope * p.x();
    scene.add(box, 1);
    scene.add(testing::visible_cylinder({6, -5, 6 * slope}, {0, 0, 1}, 0.2, 3, T.translation(), 60,
                                        0.02, rng),
              2);
    scene.add(testing::visible_cylinder({12, -3, 12 * slope}, {0, 0, 1}, 0.08, 5, T.translation(),
                                        40, 0.02, rng),
              3);
    scans.push_back(scene.scan(0.1 * i, T));
  }
  return scans;
}

TEST(Detection, ReflectivityIsTheMeanOfTheObjectsOwnPoints) {
  auto scans = flight(0);
  for (LabelledScan& scan : scans) {
    auto reflectivity = std::make_shared<std::vector<float>>();
    for (const std::uint8_t id : scan.labels->classes) reflectivity->push_back(0.2F * id);
    scan.reflectivity = reflectivity;
  }
  Detection detection({}, {});
  for (const objects::Measurement& m : detection.detect(scans).measurements) {
    EXPECT_NEAR(m.reflectivity, 0.2 * m.class_id, 1e-6);
  }
  for (const objects::Measurement& m : detection.detect(flight(0)).measurements) {
    EXPECT_TRUE(std::isnan(m.reflectivity));
  }
}

TEST(Detection, FindsEachObjectOnceInTheLastScansFrame) {
  for (const double slope : {0.0, 0.1}) {
    const auto scans = flight(slope);
    Detection detection({}, {});
    const auto result = detection.detect(scans);
    ASSERT_EQ(result.measurements.size(), 3u) << slope;
    EXPECT_EQ(result.stamp, scans.back().stamp);
    const SE3& T = scans.back().T_odom_lidar;
    const std::vector<Eigen::Vector3d> truth = {
        {9, 4, 9 * slope + 0.75}, {6, -5, 6 * slope}, {12, -3, 12 * slope}};
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(result.measurements[i].class_id, i + 1);
      EXPECT_FALSE(result.measurements[i].moving);
      EXPECT_LT((T * objects::place(result.measurements[i].model) - truth[i]).norm(), 0.2) << i;
    }
  }
}

TEST(Detection, IsTheSameToTheByteEachTime) {
  const auto scans = flight(0.05);
  Detection used({}, {});
  (void)used.detect(std::span(scans).first(3));
  Detection fresh({}, {});
  const auto a = used.detect(scans);
  const auto b = fresh.detect(scans);
  ASSERT_EQ(a.measurements.size(), b.measurements.size());
  for (std::size_t i = 0; i < a.measurements.size(); ++i) {
    EXPECT_EQ(objects::place(a.measurements[i].model), objects::place(b.measurements[i].model));
    EXPECT_EQ(a.measurements[i].covariance, b.measurements[i].covariance);
  }
}

TEST(Detection, GoesOnWithNothingNaNAndMissingLabels) {
  Detection detection({}, {});
  EXPECT_TRUE(detection.detect({}).measurements.empty());
  LabelledScan empty;
  EXPECT_TRUE(detection.detect({&empty, 1}).measurements.empty());
  SceneBuilder scene;
  scene.add(std::vector<Eigen::Vector3d>(200, Eigen::Vector3d::Constant(NAN)), 1);
  scene.add(std::vector<Eigen::Vector3d>(200, Eigen::Vector3d::Constant(NAN)), 4);
  const LabelledScan nan = scene.scan(0, SE3::Identity());
  EXPECT_TRUE(detection.detect({&nan, 1}).measurements.empty());
}

TEST(Detection, SaysClassProbabilitiesThatSumToOne) {
  const auto scans = flight(0);
  Detection detection({}, {});
  for (const auto& m : detection.detect(scans).measurements) {
    double sum = 0;
    for (const double p : m.class_probability) sum += p;
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_EQ(m.class_probability[m.class_id], *std::ranges::max_element(m.class_probability));
  }
}

TEST(Detection, PointsOfNoObjectInsideAVehicleSpeakAgainstIt) {
  SceneBuilder scene;
  core::Rng rng(5);
  const std::vector<Eigen::Vector3d> box =
      visible_box({8, 0, 0.3}, Eigen::Vector3d(0, 0, 2), 2000, 0.02, rng);
  scene.add_ground(0, 20, rng);
  scene.solids = {{8, 0, 0.3}};
  scene.add(box, 1);
  scene.add(visible_box({8, 0, 0.3, 4.2, 1.5}, Eigen::Vector3d(0, 0, 2), 2000, 0.02, rng), 0);
  Detection detection({}, {});
  const std::vector<LabelledScan> window = {scene.scan(0, sensor_at(2))};
  const objects::Detections found = detection.detect(window);
  ASSERT_EQ(found.measurements.size(), 1u);
  EXPECT_LT(found.measurements[0].class_probability[1], 0.75);
}

/// Of the length of a vehicle seen from beside, at whose rear a bush stands: some of its leaves are
/// taken for the vehicle's, `others` are not.
double length_sd_with_bush(int others) {
  SceneBuilder scene;
  core::Rng rng(5);
  const Eigen::Vector3d sensor(0, 0, 2);
  scene.add_ground(0, 20, rng);
  scene.solids = {{.x = 0, .y = 8},
                  {.x = -2.7, .y = 7.3, .yaw = 0, .length = 0.6, .width = 0.6, .height = 1.4}};
  scene.add(visible_box({.x = 0, .y = 8}, sensor, 4000, 0.02, rng), 1, 0.95f);
  const auto add_leaves = [&](int count, std::uint8_t class_id) {
    for (int i = 0; i < count; ++i) {
      scene.add({{rng.uniform(-3, -2.4), rng.uniform(7, 7.6), rng.uniform(0.3, 1.4)}}, class_id);
    }
  };
  add_leaves(30, 1);
  add_leaves(others, 0);
  Detection detection({}, {});
  const std::vector<LabelledScan> window = {scene.scan(0, sensor_at(2))};
  const objects::Detections found = detection.detect(window);
  EXPECT_EQ(found.measurements.size(), 1u);
  return found.measurements.empty() ? NAN : std::sqrt(found.measurements[0].covariance(6, 6));
}

/// Though beams that reach the leaves bound it.
TEST(Detection, EndAmidPointsOfNoObjectIsDoubtful) {
  EXPECT_GT(length_sd_with_bush(600), length_sd_with_bush(0));
}

TEST(Detection, CylinderWithLeavesAboveItIsRatherATrunkAndABareOneAPole) {
  for (const bool leaves : {true, false}) {
    SceneBuilder scene;
    core::Rng rng(6);
    scene.add_ground(0, 20, rng);
    const Eigen::Vector3d foot(8, 0, 0);
    scene.add(visible_cylinder(foot, Eigen::Vector3d::UnitZ(), 0.15, 3, {0, 0, 2}, 300, 0.01, rng),
              2);
    std::vector<Eigen::Vector3d> crown;
    for (int i = 0; leaves && i < 3000; ++i) {
      crown.push_back(foot +
                      Eigen::Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(2.5, 5)));
    }
    scene.add(crown, 0);
    Detection detection({}, {});
    const std::vector<LabelledScan> window = {scene.scan(0, sensor_at(2))};
    const objects::Detections found = detection.detect(window);
    ASSERT_EQ(found.measurements.size(), 1u) << leaves;
    const std::vector<double>& p = found.measurements[0].class_probability;
    const SurroundingsConfig odds;
    EXPECT_NEAR(p[2] / p[3], 36 * (leaves ? odds.leafy_odds : 1 / odds.bare_odds), 1e-3);
  }
}

TEST(Detection, RefusesAnInvalidConfiguration) {
  DetectionConfig config;
  config.vehicle_clusters.reach_m = -1;
  EXPECT_THROW(Detection(config, {}), Error);
}

}  // namespace
}  // namespace saker::detection
