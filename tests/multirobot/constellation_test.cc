#include "saker/multirobot/constellation.h"

#include <gtest/gtest.h>

#include "made_maps.h"

namespace saker::multirobot {
namespace {

using namespace slam;
using namespace made;

Survey row_of_cars(int first, int count, double y, core::Rng* sizes) {
  Survey survey;
  for (int i = 0; i < count; ++i) {
    objects::MapObject car;
    car.id = first + i;
    car.class_id = 1;
    const double length = sizes != nullptr ? sizes->uniform(3.6, 5.2) : 4.4;
    SE3 pose = frame(2.5 * (first + i), y, std::numbers::pi / 2);
    car.model = objects::Cuboid{pose, {length, 1.8, 1.5}};
    survey.map.objects.push_back(car);
  }
  return survey;
}

double place_error(const PairOfMaps& maps, const SE3& T_a_b) {
  double worst = 0;
  for (const auto& object : maps.b.map.objects) {
    const Eigen::Vector3d place = objects::place(object.model);
    worst = std::max(worst, (T_a_b * place - maps.T_a_b * place).norm());
  }
  return worst;
}

TEST(Constellation, AlignsMapsThatShareFortyPercent) {
  for (const std::uint64_t seed : {201, 202}) {
    const PairOfMaps maps = overlapping(seed);
    const Alignment found = align(maps.a, maps.b, {});
    EXPECT_EQ(found.status, AlignmentStatus::accepted);
    EXPECT_LT(found.probability_wrong, 1e-6);
    EXPECT_LT(place_error(maps, found.T_a_b.pose), 0.3);
  }
}

TEST(Constellation, NeverAlignsMapsOfTwoTowns) {
  for (const std::uint64_t seed : {201, 202, 203}) {
    const PairOfMaps maps = apart(seed);
    EXPECT_NE(align(maps.a, maps.b, {}).status, AlignmentStatus::accepted);
  }
}

TEST(Constellation, EqualCarsInARowMayBeShiftedByASlot) {
  const Alignment found = align(row_of_cars(0, 20, 0, nullptr), row_of_cars(8, 20, 0, nullptr), {});
  EXPECT_NE(found.status, AlignmentStatus::accepted);
  EXPECT_GT(found.probability_wrong, 1e-4);
}

TEST(Constellation, ARowOfUnequalCarsIsNotAmbiguous) {
  core::Rng sizes(5);
  const Survey row = row_of_cars(0, 30, 0, &sizes);
  Survey part = row;
  part.map.objects.erase(part.map.objects.begin(), part.map.objects.begin() + 10);
  const Alignment found = align(row, part, {});
  EXPECT_EQ(found.status, AlignmentStatus::accepted);
  EXPECT_TRUE(found.T_a_b.pose.isApprox(SE3::Identity(), 1e-6));
}

TEST(Constellation, TooFewObjectsSayNothing) {
  core::Rng sizes(6);
  const Survey row = row_of_cars(0, 4, 0, &sizes);
  EXPECT_NE(align(row, row, {}).status, AlignmentStatus::accepted);
  EXPECT_EQ(align({}, {}, {}).status, AlignmentStatus::too_few);
}

/// Where it was said to look, b has none of the objects that a has there.
TEST(Constellation, WhatShouldBeThereAndIsNotSpeaksAgainstIt) {
  core::Rng sizes(7);
  const Survey row = row_of_cars(0, 8, 0, &sizes);
  Survey crowded = row;
  for (int i = 0; i < 30; ++i) {
    objects::MapObject tree;
    tree.id = 100 + i;
    tree.class_id = 2;
    tree.model = objects::Cylinder{{0.7 * i, 6.0 + i % 7, 0}, Eigen::Vector3d::UnitZ(), 0.2, 3};
    crowded.map.objects.push_back(tree);
  }
  crowded.path = {{5, 3, 2}, {15, 3, 2}};
  Survey bare = row;
  bare.path = crowded.path;
  EXPECT_LT(align(crowded, bare, {}).evidence, align(row, bare, {}).evidence - 10);
}

TEST(Constellation, KeepsWithinTheBoundsOfALoop) {
  const PairOfMaps maps = overlapping(203);
  Survey moved = maps.a;
  const SE3 drift = frame(3, -2, 0.1);
  for (auto& object : moved.map.objects) object.model = objects::transformed(drift, object.model);
  for (auto& p : moved.path) p = drift * p;
  EXPECT_EQ(align(maps.a, moved, {}, AlignmentBounds{15, 10}).status, AlignmentStatus::accepted);
  EXPECT_NE(align(maps.a, moved, {}, AlignmentBounds{1, 2}).status, AlignmentStatus::accepted);
}

}  // namespace
}  // namespace saker::multirobot
