#include "tools/saker/characterise/sample_matching.h"

#include <gtest/gtest.h>

namespace saker::tools {
namespace {

constexpr objects::ClassId kVehicle = 1, kTrunk = 2, kPole = 3;

objects::Cuboid car(double x, double y) {
  objects::Cuboid cuboid;
  cuboid.pose.translation() = Eigen::Vector3d(x, y, 0.7);
  cuboid.size = {4.5, 1.8, 1.4};
  return cuboid;
}

objects::Cylinder stem(double x, double y) {
  objects::Cylinder cylinder;
  cylinder.root = {x, y, 0};
  cylinder.radius = 0.1;
  cylinder.height = 3;
  return cylinder;
}

objects::Measurement measured(objects::ClassId id, const objects::Model& model) {
  objects::Measurement m;
  m.class_id = id;
  m.class_probability = {0.1, 0.1, 0.2, 0.6, 0};
  m.model = model;
  m.points = 50;
  return m;
}

TEST(SampleMatching, CarsSideBySideAreToldApart) {
  const std::vector<KnownObject> known = {{1, "sedan", kVehicle, car(0, 0)},
                                          {2, "van", kVehicle, car(0, 2.5)}};
  const std::vector<objects::Measurement> window = {measured(kVehicle, car(0.2, 2.0)),
                                                    measured(kVehicle, car(0.3, 0.9))};
  EXPECT_EQ(matched(window, SE3::Identity(), known), (std::vector<int>{1, 0}));
}

TEST(SampleMatching, WhatIsFarAwayMovesOrHasAnotherShapeIsOfNoObject) {
  const std::vector<KnownObject> known = {{1, "sedan", kVehicle, car(0, 0)}};
  objects::Measurement moving = measured(kVehicle, car(0, 0));
  moving.moving = true;
  const std::vector<objects::Measurement> window = {measured(kVehicle, car(0, 1.6)),
                                                    measured(kPole, stem(0, 0)), moving};
  EXPECT_EQ(matched(window, SE3::Identity(), known), (std::vector<int>{-1, -1, -1}));
}

TEST(SampleMatching, PlacesAreComparedInTheWorld) {
  SE3 T_world_lidar = SE3::Identity();
  T_world_lidar.translation() = Eigen::Vector3d(5, -3, 2);
  const std::vector<KnownObject> known = {{1, "sedan", kVehicle, car(5, -3)}};
  EXPECT_EQ(matched({measured(kVehicle, car(0, 0))}, T_world_lidar, known), std::vector<int>{0});
}

TEST(SampleMatching, ATrunkThatWasTakenForAPoleCountsWithTheProbabilityOfATrunk) {
  const KnownObject trunk{7, "oak", kTrunk, stem(6, 0)};
  objects::Measurement m = measured(kPole, stem(6.1, 0));
  m.reflectivity = 0.3;
  const uncertainty::Sample sample = sample_of_known(m, SE3::Identity(), trunk, "lot", 2.5);
  EXPECT_EQ(sample.class_id, kTrunk);
  EXPECT_DOUBLE_EQ(sample.confidence, 0.2);
  EXPECT_DOUBLE_EQ(sample.view.reflectivity, 0.3);
  EXPECT_NEAR(sample.view.range, 6, 1e-12);
  EXPECT_NEAR(sample.error.x(), 0.1, 1e-12);
  EXPECT_EQ(sample.recording + sample.kind, "lotoak");
  EXPECT_EQ(sample.object_id, 7);
  EXPECT_EQ(sample.time_s, 2.5);
}

}  // namespace
}  // namespace saker::tools
