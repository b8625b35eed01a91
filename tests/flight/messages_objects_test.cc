#include <gtest/gtest.h>

#include <set>

#include "flight/bus/object_messages.h"

namespace saker::flight {
namespace {

using objects::Cuboid;
using objects::Cylinder;
using objects::MapObject;
using objects::ObjectMap;

constexpr int kClasses = 5;
constexpr std::size_t kMost = 1000;

MapObject made_vehicle(int id) {
  Cuboid cuboid;
  cuboid.pose.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  cuboid.pose.translation() << 10 + id, -4, 0.75;
  cuboid.size << 4.5, 1.75, 1.5;
  MapObject object;
  object.id = id;
  object.class_id = 1;
  object.observations = 9;
  object.model = cuboid;
  object.class_probability = {0.025, 0.9, 0.025, 0.025, 0.025};
  object.covariance = Eigen::VectorXd::LinSpaced(9, 1, 9).cwiseAbs2().asDiagonal();
  return object;
}

MapObject made_pole(int id) {
  const Cylinder cylinder{.root = {1, 2, 0.25},
                          .axis = Eigen::Vector3d(0.1, -0.2, 1).normalized(),
                          .radius = 0.125,
                          .height = 6};
  MapObject object;
  object.id = id;
  object.class_id = 3;
  object.observations = 2;
  object.model = cylinder;
  object.class_probability = {0.05, 0.05, 0.05, 0.8, 0.05};
  return object;
}

ObjectMap made_map(int count) {
  ObjectMap map;
  for (int id = 0; id < count; ++id) map.objects.push_back(made_vehicle(id));
  return map;
}

std::set<int> ids(const object_map_t& message) {
  std::set<int> result;
  for (const map_object_t& object : message.objects) result.insert(object.id);
  return result;
}

TEST(ObjectMessages, AVehicleComesBack) {
  const MapObject object = made_vehicle(4);
  const auto back = from_lcm(to_lcm(object), kClasses);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->id, 4);
  EXPECT_EQ(back->observations, 9);
  const auto& a = std::get<Cuboid>(object.model);
  const auto& b = std::get<Cuboid>(back->model);
  EXPECT_TRUE(a.pose.isApprox(b.pose, 1e-6));
  EXPECT_TRUE(a.size.isApprox(b.size, 1e-6));
  ASSERT_EQ(back->class_probability.size(), 5u);
  EXPECT_NEAR(back->class_probability[1], 0.9, 1e-6);
  EXPECT_NEAR(back->class_probability[0], 0.025, 1e-6);
}

TEST(ObjectMessages, APoleComesBack) {
  const auto back = from_lcm(to_lcm(made_pole(4)), kClasses);
  ASSERT_TRUE(back);
  const Cylinder a = std::get<Cylinder>(made_pole(4).model);
  const Cylinder b = std::get<Cylinder>(back->model);
  EXPECT_TRUE(a.root.isApprox(b.root, 1e-6));
  EXPECT_TRUE(a.axis.isApprox(b.axis, 1e-6));
  EXPECT_NEAR(a.radius, b.radius, 1e-6);
  EXPECT_NEAR(a.height, b.height, 1e-6);
}

TEST(ObjectMessages, DeviationsAreThoseOfPlaceAndSize) {
  const map_object_t message = to_lcm(made_vehicle(0));
  EXPECT_EQ(message.position_sd[0], 4);
  EXPECT_EQ(message.position_sd[1], 5);
  EXPECT_EQ(message.size_sd[0], 7);
  EXPECT_EQ(message.size_sd[1], 8);
  EXPECT_TRUE(std::isnan(to_lcm(made_pole(0)).position_sd[0]));
}

TEST(ObjectMessages, ObjectsThatAreNoneAreRefused) {
  map_object_t message = to_lcm(made_vehicle(0));
  message.shape = 7;
  EXPECT_FALSE(from_lcm(message, kClasses));
  message = to_lcm(made_vehicle(0));
  message.class_id = kClasses;
  EXPECT_FALSE(from_lcm(message, kClasses));
  message.class_id = -1;
  EXPECT_FALSE(from_lcm(message, kClasses));
  message = to_lcm(made_vehicle(0));
  message.size[2] = NAN;
  EXPECT_FALSE(from_lcm(message, kClasses));
}

TEST(ObjectMessages, TheNearestDetectionsAreSentAndTheOthersCounted) {
  objects::Detections detections;
  detections.stamp = 5'000'000;
  for (int i = 99; i >= 0; --i) {
    objects::Measurement measurement;
    measurement.class_id = 3;
    measurement.points = i;
    measurement.model = Cylinder{.root = {i + 1.0, 0, 0}, .radius = 0.1, .height = 3};
    detections.measurements.push_back(measurement);
  }
  const detections_t message = to_lcm(detections);
  EXPECT_LE(message.getEncodedSize(), 1400);
  EXPECT_EQ(message.total, 100);
  const auto back = from_lcm(message, kClasses);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->measurements.size(), static_cast<std::size_t>(detections_t::MAX_DETECTIONS));
  for (int i = 0; i < detections_t::MAX_DETECTIONS; ++i) {
    EXPECT_EQ(back->measurements[static_cast<std::size_t>(i)].points, i);
  }
}

TEST(MapSender, SendsTheWholeMapInTurn) {
  MapSender sender;
  const ObjectMap map = made_map(40);
  ObjectMap heard;
  for (int cycle = 0; cycle < 3; ++cycle) {
    const object_map_t message = sender.next(map, 0);
    EXPECT_LE(message.getEncodedSize(), 1400);
    EXPECT_EQ(message.total, 40);
    EXPECT_TRUE(merge(message, kClasses, kMost, heard));
  }
  ASSERT_EQ(heard.objects.size(), 40u);
  for (int id = 0; id < 40; ++id) EXPECT_EQ(heard.objects[static_cast<std::size_t>(id)].id, id);
}

TEST(MapSender, WhatChangedComesFirst) {
  MapSender sender;
  ObjectMap map = made_map(40);
  for (int cycle = 0; cycle < 3; ++cycle) (void)sender.next(map, 0);
  map.objects[33].observations = 10;
  const object_map_t message = sender.next(map, 0);
  EXPECT_EQ(message.objects.front().id, 33);
}

TEST(MapSender, AListenerThatCameLateHearsEverything) {
  MapSender sender;
  const ObjectMap map = made_map(40);
  for (int cycle = 0; cycle < 10; ++cycle) (void)sender.next(map, 0);
  std::set<int> heard;
  for (int cycle = 0; cycle < 3; ++cycle) heard.merge(ids(sender.next(map, 0)));
  EXPECT_EQ(heard.size(), 40u);
}

TEST(MapSender, WhatIsGoneIsTakenOutThoughAMessageIsLost) {
  MapSender sender;
  ObjectMap map = made_map(3);
  ObjectMap heard;
  merge(sender.next(map, 0), kClasses, kMost, heard);
  map.objects.erase(map.objects.begin() + 1);
  (void)sender.next(map, 0);  // lost
  merge(sender.next(map, 0), kClasses, kMost, heard);
  ASSERT_EQ(heard.objects.size(), 2u);
  EXPECT_EQ(heard.objects[0].id, 0);
  EXPECT_EQ(heard.objects[1].id, 2);
}

TEST(MapSender, ForgetsWhatIsGone) {
  MapSender sender;
  (void)sender.next(made_map(3), 0);
  for (int cycle = 0; cycle < 5; ++cycle) (void)sender.next(ObjectMap{}, 0);
  EXPECT_TRUE(sender.next(ObjectMap{}, 0).objects.empty());
}

TEST(Merge, HasACeiling) {
  ObjectMap heard;
  EXPECT_FALSE(merge(MapSender().next(made_map(10), 0), kClasses, 4, heard));
  EXPECT_EQ(heard.objects.size(), 4u);
}

}  // namespace
}  // namespace saker::flight
