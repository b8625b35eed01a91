#include "saker/objects/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace saker::objects {
namespace {

MapObject car(int id, double x, double y, double length = 4.4, double yaw = 0) {
  MapObject object;
  object.id = id;
  object.class_id = 1;
  Cuboid cuboid{core::se3_exp((Vector6d() << 0, 0, yaw, 0, 0, 0).finished()), {length, 1.8, 1.5}};
  cuboid.pose.translation() = Eigen::Vector3d(x, y, 0.75);
  object.model = cuboid;
  return object;
}

MapObject trunk(int id, double x, double y, double radius = 0.15) {
  MapObject object;
  object.id = id;
  object.class_id = 2;
  object.model = Cylinder{{x, y, 0}, Eigen::Vector3d::UnitZ(), radius, 3};
  return object;
}

ObjectMap map_of(std::vector<MapObject> objects) { return {"world", std::move(objects), {}}; }

ClassComparison of(const std::vector<ClassComparison>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
}

ErrorFigures figures(const ClassComparison& c, const std::string& quantity) {
  return *std::find_if(c.errors.begin(), c.errors.end(),
                       [&](const auto& e) { return e.quantity == quantity; });
}

TEST(Comparison, CountsFoundMissedInventedAndDuplicates) {
  const ObjectMap truth = map_of({car(0, 0, 0), car(1, 10, 0), car(2, 20, 0), trunk(3, 5, 5)});
  const ObjectMap mapped =
      map_of({car(0, 0.3, 0), car(1, 0, 1.2), car(2, 10, -1), car(3, 40, 0), trunk(4, 15, 15)});
  const auto all = compare(mapped, truth, {}, {});
  const ClassComparison vehicle = of(all, "vehicle"), wood = of(all, "trunk"),
                        pole = of(all, "pole");
  EXPECT_EQ(vehicle.found, 2);
  EXPECT_EQ(vehicle.missed, 1);
  EXPECT_EQ(vehicle.invented, 1);
  EXPECT_EQ(vehicle.duplicates, 1);
  EXPECT_EQ(wood.missed, 1);
  EXPECT_EQ(wood.invented, 1);
  EXPECT_EQ(pole.truth + pole.mapped, 0);
}

TEST(Comparison, AThingBesideATrunkIsNotTheTrunkThatWasMissed) {
  const ObjectMap truth = map_of({trunk(0, 5, 5)});
  EXPECT_EQ(of(compare(map_of({trunk(0, 5, 5.7)}), truth, {}, {}), "trunk").found, 1);
  const ClassComparison beside = of(compare(map_of({trunk(0, 5, 6)}), truth, {}, {}), "trunk");
  EXPECT_EQ(beside.missed, 1);
  EXPECT_EQ(beside.invented, 1);
}

TEST(Comparison, PoleTakenForATrunkBesideATrunkIsInventedNotADuplicate) {
  MapObject pole = trunk(1, 6, 5);
  pole.class_id = 3;
  const ObjectMap truth = map_of({trunk(0, 5, 5), pole});
  const auto all = compare(map_of({trunk(0, 5, 5.1), trunk(1, 6.1, 5)}), truth, {}, {});
  EXPECT_EQ(of(all, "trunk").found, 1);
  EXPECT_EQ(of(all, "trunk").invented, 1);
  EXPECT_EQ(of(all, "trunk").duplicates, 0);
  EXPECT_EQ(of(all, "pole").missed, 1);
}

TEST(Comparison, ErrorIsMappedMinusTrueWithItsSign) {
  const ObjectMap truth = map_of({car(0, 0, 0, 4), car(1, 10, 0, 5)});
  const ObjectMap mapped = map_of({car(0, 0.2, 0, 4.3), car(1, 10.4, 0, 5.1)});
  const ClassComparison vehicle = of(compare(mapped, truth, {}, {}), "vehicle");
  EXPECT_NEAR(figures(vehicle, "x_m").mean, 0.3, 1e-12);
  EXPECT_NEAR(figures(vehicle, "length_m").mean, 0.2, 1e-12);
  EXPECT_NEAR(figures(vehicle, "length_m").standard_deviation, 0.2 / std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(vehicle.length_slope, 0.8, 1e-12);
  EXPECT_NEAR(vehicle.size_mae_m, 0.1, 1e-12);
  EXPECT_NEAR(vehicle.constant_size_mae_m, 0.25, 1e-12);
}

TEST(Comparison, AFrontTakenForTheBackIsCountedNotAveraged) {
  const ObjectMap truth = map_of({car(0, 0, 0), car(1, 10, 0)});
  const ObjectMap mapped =
      map_of({car(0, 0, 0, 4.4, 0.1), car(1, 10, 0, 4.4, std::numbers::pi + 0.1)});
  const ClassComparison vehicle = of(compare(mapped, truth, {}, {}), "vehicle");
  EXPECT_EQ(vehicle.front_right, 1);
  EXPECT_NEAR(figures(vehicle, "heading_deg").mean, 5.7296, 1e-3);
}

TEST(Comparison, TruthThatWasHardlyHitDoesNotCountEitherWay) {
  MapObject hidden = car(0, 0, 0), seen = car(1, 10, 0);
  hidden.points = 5;
  seen.points = 500;
  const ObjectMap truth = map_of({hidden, seen});
  ComparisonOptions options;
  options.least_points = 50;
  for (const ObjectMap& mapped : {map_of({car(0, 10, 0)}), map_of({car(0, 10, 0), car(1, 0, 0)})}) {
    const ClassComparison vehicle = of(compare(mapped, truth, {}, options), "vehicle");
    EXPECT_EQ(vehicle.truth, 1);
    EXPECT_EQ(vehicle.found, 1);
    EXPECT_EQ(vehicle.missed + vehicle.invented + vehicle.duplicates, 0);
  }
}

TEST(Comparison, NamesThePairsThatItFound) {
  const ObjectMap truth = map_of({car(1, 0, 0), car(2, 5, 0), car(3, 50, 0)});
  const ObjectMap mapped = map_of({car(7, 5.3, 0), car(8, 0.2, 0), car(9, 80, 0)});
  const auto pairs = of(compare(mapped, truth, ClassTable{}, {}), "vehicle").pairs;
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].mapped, 7);
  EXPECT_EQ(pairs[0].truth, 2);
  EXPECT_EQ(pairs[1].mapped, 8);
  EXPECT_EQ(pairs[1].truth, 1);
}

}  // namespace
}  // namespace saker::objects
