#include "saker/objects/smap_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::objects {
namespace {

constexpr ClassId kVehicle = 1, kTrunk = 2;
const ClassTable kTable;
const SmapSteps kSteps;

MapObject vehicle(core::Rng& rng) {
  MapObject object;
  object.class_id = kVehicle;
  Vector6d tangent;
  for (int i = 0; i < 3; ++i) tangent[i] = rng.uniform(-2, 2);
  for (int i = 3; i < 6; ++i) tangent[i] = rng.uniform(-500, 500);
  object.model =
      Cuboid{core::se3_exp(tangent), {rng.uniform(3, 6), rng.uniform(1.5, 2), rng.uniform(1, 3)}};
  object.class_probability = {0, 0.73, 0.27, 0, 0};
  return object;
}

MapObject trunk(core::Rng& rng) {
  MapObject object;
  object.class_id = kTrunk;
  object.model = Cylinder{{rng.uniform(-500, 500), rng.uniform(-500, 500), rng.uniform(-20, 20)},
                          Eigen::Vector3d(rng.normal(0, 0.2), rng.normal(0, 0.2), 1).normalized(),
                          rng.uniform(0.04, 0.5),
                          rng.uniform(1, 9)};
  return object;
}

TEST(SmapGeometry, ACuboidIsWithinHalfAStepInEachCoordinate) {
  core::Rng rng(1);
  for (int i = 0; i < 100; ++i) {
    const MapObject object = vehicle(rng);
    const auto& before = std::get<Cuboid>(object.model);
    const auto after =
        std::get<Cuboid>(model_of(coarse(object, kTable, kSteps), Shape::cuboid, kSteps));
    const double rounding = 1e-9;
    EXPECT_LE((after.pose.translation() - before.pose.translation()).cwiseAbs().maxCoeff(),
              0.5 * kSteps.position_m + rounding);
    EXPECT_LE((after.size - before.size).cwiseAbs().maxCoeff(), 0.5 * kSteps.size_m + rounding);
    // Heading and two tilts, each of them within half a step.
    const double turned =
        core::so3_log(before.pose.linear().transpose() * after.pose.linear()).norm();
    EXPECT_LE(turned, 1.5 * kSteps.angle_deg * std::numbers::pi / 180);
  }
}

TEST(SmapGeometry, ACylinderIsWithinHalfAStepInEachCoordinate) {
  core::Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const MapObject object = trunk(rng);
    const auto& before = std::get<Cylinder>(object.model);
    const auto after =
        std::get<Cylinder>(model_of(coarse(object, kTable, kSteps), Shape::cylinder, kSteps));
    EXPECT_LE((after.root - before.root).cwiseAbs().maxCoeff(), 0.5 * kSteps.position_m + 1e-9);
    EXPECT_LE(std::abs(after.radius - before.radius), 0.5 * kSteps.radius_m + 1e-9);
    EXPECT_LE(std::abs(after.height - before.height), 0.5 * kSteps.size_m + 1e-9);
    EXPECT_LE(std::acos(std::min(1.0, after.axis.dot(before.axis))),
              kSteps.angle_deg * std::numbers::pi / 180);
  }
}

TEST(SmapGeometry, OfWhatIsCoarseAlreadyNothingIsLost) {
  core::Rng rng(3);
  MapObject object = vehicle(rng);
  const CoarseObject once = coarse(object, kTable, kSteps);
  object.model = model_of(once, Shape::cuboid, kSteps);
  const CoarseObject twice = coarse(object, kTable, kSteps);
  EXPECT_EQ(twice.x, once.x);
  EXPECT_EQ(twice.z, once.z);
  EXPECT_EQ(twice.shape, once.shape);
}

TEST(SmapGeometry, ProbabilityIsWithinHalfAStepAndNeverMoreThanOne) {
  core::Rng rng(4);
  MapObject object = vehicle(rng);
  EXPECT_NEAR(probability_of(coarse(object, kTable, kSteps), kSteps), 0.73,
              0.5 * kSteps.probability);
  SmapSteps thirds;
  thirds.probability = 0.3;
  object.class_probability[kVehicle] = 1;
  EXPECT_LE(probability_of(coarse(object, kTable, thirds), thirds), 1);
}

TEST(SmapGeometry, WhatNoFileCanHoldIsRefused) {
  core::Rng rng(5);
  const auto refused = [&](auto spoil) {
    MapObject object = vehicle(rng);
    spoil(object, std::get<Cuboid>(object.model));
    try {
      (void)coarse(object, kTable, kSteps);
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused([](MapObject&, Cuboid&) {}));
  EXPECT_TRUE(refused([](MapObject&, Cuboid& c) { c.size.x() = NAN; }));
  EXPECT_TRUE(refused([](MapObject&, Cuboid& c) { c.size.y() = -1; }));
  EXPECT_TRUE(refused([](MapObject&, Cuboid& c) { c.pose.translation().x() = 1e12; }));
  EXPECT_TRUE(refused([](MapObject& o, Cuboid&) { o.class_id = kTrunk; })) << "another shape";
}

TEST(Morton, InterleavesTheBitsOfBothCoordinates) {
  EXPECT_EQ(morton(0, 0), 0U);
  EXPECT_EQ(morton(1, 0), 1U);
  EXPECT_EQ(morton(0, 1), 2U);
  EXPECT_EQ(morton(3, 5), 0b100111U);
  EXPECT_EQ(morton(0xFFFFFFFF, 0), 0x5555555555555555U);
  EXPECT_EQ(morton(0xFFFFFFFF, 0xFFFFFFFF), UINT64_MAX);
}

TEST(Morton, SquaresFollowOneAnotherWhole) {
  std::uint64_t most = 0, next = UINT64_MAX;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      most = std::max(most, morton(x, y));
      next = std::min(next, morton(x + 8, y));
    }
  }
  EXPECT_EQ(most, 63U);
  EXPECT_EQ(next, 64U);
}

TEST(SmapGeometry, ATileComesBackInTheOrderOfItsCurve) {
  core::Rng rng(6);
  SmapHead head;
  head.classes = {{"other", Shape::none}, {"vehicle", Shape::cuboid}, {"trunk", Shape::cylinder}};
  std::vector<CoarseObject> objects;
  const std::int64_t width = std::int64_t{1} << kSteps.tile_bits;
  for (int i = 0; i < 150; ++i) {
    MapObject object = i % 3 == 0 ? trunk(rng) : vehicle(rng);
    CoarseObject made = coarse(object, kTable, kSteps);
    made.x = -width + rng.index(static_cast<int>(width));
    made.y = 2 * width + rng.index(static_cast<int>(width));
    objects.push_back(made);
  }
  const auto along = [&](const CoarseObject& o) {
    return morton(o.x & (width - 1), o.y & (width - 1));
  };
  std::ranges::sort(objects, {}, along);
  const SmapTile tile{-1, 2, 150};
  const auto read = unpack_geometry(pack_geometry(objects, head.classes, kSteps), tile, head);
  ASSERT_EQ(read.size(), objects.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].x, objects[i].x);
    EXPECT_EQ(read[i].y, objects[i].y);
    EXPECT_EQ(read[i].z, objects[i].z);
    EXPECT_EQ(read[i].object_class, objects[i].object_class);
    EXPECT_EQ(read[i].probability, objects[i].probability);
    EXPECT_EQ(read[i].shape, objects[i].shape);
  }
}

TEST(SmapGeometry, TilesOfNegativePlacesLieToTheirLeft) {
  const std::int64_t width = std::int64_t{1} << kSteps.tile_bits;
  EXPECT_EQ(tile_of(0, kSteps), 0);
  EXPECT_EQ(tile_of(width - 1, kSteps), 0);
  EXPECT_EQ(tile_of(width, kSteps), 1);
  EXPECT_EQ(tile_of(-1, kSteps), -1);
  EXPECT_EQ(tile_of(-width - 1, kSteps), -2);
}

}  // namespace
}  // namespace saker::objects
