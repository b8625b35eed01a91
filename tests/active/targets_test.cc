#include "saker/active/tour/targets.h"

#include <gtest/gtest.h>

#include <limits>

#include "made_street.h"
#include "saker/core/error.h"

namespace saker::active {
namespace {

using namespace made;

const objects::ClassTable kTable;

TargetList targets_at(const std::vector<objects::Cuboid>& cars) {
  return TargetList({}, kTable, map_of(cars));
}

std::string error_of(const objects::ObjectMap& prior, const TargetsConfig& config = {}) {
  try {
    const TargetList list(config, kTable, prior);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Targets, AreThePriorsObjectsOfTargetClassesInTheOrderOfTheirIds) {
  objects::ObjectMap prior;
  prior.objects = {vehicle(7, car(0, 0)), vehicle(3, car(9, 0)), vehicle(5, car(5, 0))};
  prior.objects[2].class_id = kTrunk;
  const TargetList targets({}, kTable, prior);
  ASSERT_EQ(targets.size(), 2);
  EXPECT_EQ(targets[0].id, 3);
  EXPECT_EQ(targets[1].id, 7);
  EXPECT_EQ(targets.count(TargetStatus::pending), 2);
}

TEST(Targets, OfAnEmptyPriorAreNone) {
  TargetList targets({}, kTable, {});
  targets.associate(map_of({car(0, 0)}));
  EXPECT_EQ(targets.size(), 0);
}

TEST(Targets, ThatAMapKnowsWellAreNotVisitedAndThoseItKnowsBadlyAre) {
  objects::ObjectMap prior = map_of({car(0, 0), car(9, 0), car(18, 0)});
  Vector9d sd = Vector9d::Constant(1);
  sd.segment<2>(6) << 0.04, 0.03;
  prior.objects[0].covariance = sd.cwiseAbs2().asDiagonal();
  sd.segment<2>(6) << 0.04, 0.2;
  prior.objects[1].covariance = sd.cwiseAbs2().asDiagonal();
  TargetList targets({.known_sd_m = 0.05}, kTable, prior);
  EXPECT_NE(targets[0].status, TargetStatus::pending);
  EXPECT_EQ(targets.count(TargetStatus::pending), 2);
  targets.associate(map_of({car(0.2, 0)}));
  EXPECT_EQ(targets[0].status, TargetStatus::done);
  EXPECT_EQ(TargetList({.known_sd_m = 0}, kTable, prior).count(TargetStatus::pending), 3);
}

TEST(Targets, ExtentIsThePriorsWithAMarginUntilOneIsMapped) {
  TargetList targets = targets_at({car(10, 0)});
  for (const int axis : {0, 1}) {  // nobody knows how it is turned
    EXPECT_NEAR(targets[0].extent.size[axis], 4.4 + 2 * TargetsConfig{}.prior_margin_m, 1e-9);
  }
  targets.associate(map_of({car(10.8, -0.6, 1.0)}));
  EXPECT_TRUE(targets[0].mapped());
  EXPECT_DOUBLE_EQ(targets[0].extent.size.x(), 4.4);
  EXPECT_DOUBLE_EQ(targets[0].place().x(), 10.8);
  targets.associate({});
  EXPECT_FALSE(targets[0].mapped());
  EXPECT_DOUBLE_EQ(targets[0].place().x(), 10);
}

TEST(Targets, PriorThatKnowsPlacesOnlyHasTheDefaultSize) {
  objects::Cuboid place_only = car(10, 0);
  place_only.size.setConstant(NAN);
  const TargetList targets = targets_at({place_only});
  EXPECT_TRUE(targets[0].extent.size.allFinite());
  EXPECT_GT(targets[0].extent.size.minCoeff(), 1);
}

TEST(Targets, EachMappedObjectBelongsToOneTargetTheNearest) {
  TargetList targets = targets_at({car(0, 0), car(2.6, 0), car(20, 0)});
  objects::ObjectMap map = map_of({car(2.4, 0.3), car(0.2, -0.3), car(60, 0)});
  map.objects[0].id = 11;
  map.objects[1].id = 12;
  targets.associate(map);
  EXPECT_EQ(targets[0].object_id, 12);
  EXPECT_EQ(targets[1].object_id, 11);
  EXPECT_FALSE(targets[2].mapped());
}

TEST(Targets, WithAnIncompleteObjectNearerTakesNoNeighboursAndIsNotMapped) {
  TargetList targets = targets_at({car(0, 0)});
  objects::ObjectMap map = map_of({car(3, 0)});
  targets.associate(map);
  ASSERT_TRUE(targets[0].mapped());
  map.incomplete = {vehicle(9, car(0.5, 0.2))};
  targets.associate(map);
  EXPECT_FALSE(targets[0].mapped());
  EXPECT_EQ(targets[0].incomplete_id, 9);
  EXPECT_DOUBLE_EQ(targets[0].place().x(), 0.5);
}

TEST(Targets, AnotherClassAnotherStoreyAndWhatIsNotFiniteDoNotBelong) {
  TargetList targets = targets_at({car(0, 0)});
  objects::ObjectMap map = map_of({car(0, 0), car(0, 0), car(0, 0)});
  map.objects[0].class_id = kTrunk;
  std::get<objects::Cuboid>(map.objects[1].model).pose.translation().z() += 3.5;
  std::get<objects::Cuboid>(map.objects[2].model).size.setConstant(NAN);
  targets.associate(map);
  EXPECT_FALSE(targets[0].mapped());
}

TEST(Targets, VisitedOneIsDoneOnceItIsMapped) {
  TargetList targets = targets_at({car(0, 0), car(20, 0), car(40, 0)});
  targets.close(0, TargetStatus::visited, "");
  targets.close(1, TargetStatus::unreachable, "walled in");
  targets.associate(map_of({car(0, 0), car(20, 0), car(40, 0)}));
  EXPECT_EQ(targets[0].status, TargetStatus::done);
  EXPECT_EQ(targets[1].status, TargetStatus::unreachable);
  EXPECT_EQ(targets[1].reason, "walled in");
  EXPECT_EQ(targets[2].status, TargetStatus::pending);
}

TEST(Targets, ClosedOneKeepsItsObjectWhenANearerOneIsMapped) {
  TargetList targets = targets_at({car(0, 0), car(5, 0)});
  objects::ObjectMap map = map_of({car(2, 0)});
  map.objects[0].id = 7;
  targets.associate(map);
  ASSERT_EQ(targets[0].object_id, 7);
  targets.close(0, TargetStatus::done, "");
  map.objects.push_back(vehicle(8, car(0, 0)));
  targets.associate(map);
  EXPECT_EQ(targets[0].object_id, 7);
  EXPECT_EQ(targets[1].object_id, 8);
}

TEST(Targets, ClosedOneWhoseObjectLeftTheMapTakesWhatStandsInItsSteadNoNeighbour) {
  TargetList targets = targets_at({car(0, 0)});
  targets.associate(map_of({car(1, 0)}));
  targets.close(0, TargetStatus::done, "");
  objects::ObjectMap map = map_of({car(4, 0)});
  map.objects[0].id = 7;
  targets.associate(map);
  EXPECT_FALSE(targets[0].mapped());
  EXPECT_DOUBLE_EQ(targets[0].place().x(), 1);
  map.objects.push_back(vehicle(8, car(0.5, 0.5)));
  targets.associate(map);
  EXPECT_EQ(targets[0].object_id, 8);
}

TEST(Targets, PendingOnesSwapTheirObjectsOnlyWhenThatIsClearlyBetter) {
  TargetList targets = targets_at({car(0, 0), car(0, 3)});
  objects::ObjectMap map = map_of({car(1, 1.4), car(1, 1.6)});
  targets.associate(map);
  const int first = targets[0].object_id;
  std::swap(map.objects[0].model, map.objects[1].model);
  targets.associate(map);
  EXPECT_EQ(targets[0].object_id, first);
  map = map_of({car(0, 3), car(0, 0)});
  targets.associate(map);
  EXPECT_EQ(targets[0].object_id, 1);
}

TEST(Targets, AddedOneIsPendingWithAnIdOfItsOwnAndItsObject) {
  objects::ObjectMap prior;
  prior.objects = {vehicle(7, car(0, 0)), vehicle(3, car(9, 0))};
  TargetList targets({}, kTable, prior);
  const int revision = targets.revision();
  const int index = targets.add(vehicle(55, car(40, 0, 0.3)), true);
  EXPECT_EQ(index, 2);
  EXPECT_EQ(targets[index].id, 8);
  EXPECT_EQ(targets[index].status, TargetStatus::pending);
  EXPECT_EQ(targets[index].object_id, 55);
  EXPECT_TRUE(targets[index].discovered);
  EXPECT_NE(targets.revision(), revision);
  targets.associate(map_of({car(40.2, 0, 0.3)}));
  EXPECT_EQ(targets[index].object_id, 0);
}

TEST(Targets, UnreachableOneTakesNoObjectThatMayBeReachable) {
  TargetList targets = targets_at({car(0, 0)});
  targets.close(0, TargetStatus::unreachable, "in a wall");
  targets.associate(map_of({car(3, 0)}));
  EXPECT_FALSE(targets[0].mapped());
}

TEST(Targets, DismissedOneIsVisitedAndNeverTakesAnObject) {
  TargetList targets = targets_at({car(0, 0), car(2, 0)});
  targets.dismiss(0, "nothing there");
  targets.associate(map_of({car(0, 0)}));
  EXPECT_EQ(targets[0].status, TargetStatus::visited);
  EXPECT_EQ(targets[0].reason, "nothing there");
  EXPECT_FALSE(targets[0].mapped());
  EXPECT_TRUE(targets[1].mapped());
}

TEST(Targets, OfAPriorThatIsTwoMetresOffFindTheirObjects) {
  const std::vector<objects::Cuboid> cars = {car(0, 0), car(12, 3), car(25, -2), car(40, 1)};
  std::vector<objects::Cuboid> rough = cars;
  const Eigen::Vector2d off[] = {{2, 2}, {-4, 0}, {0, 4.5}, {3, -3}};
  for (std::size_t i = 0; i < 4; ++i) rough[i].pose.translation().head<2>() += off[i];
  TargetList targets = targets_at(rough);
  targets.associate(map_of(cars));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(targets[i].object_id, i);
}

TEST(Targets, PriorWithAPlaceThatIsNotFiniteIsRefusedByItsId) {
  objects::ObjectMap prior = map_of({car(0, 0), car(1, 0)});
  std::get<objects::Cuboid>(prior.objects[1].model).pose.translation().y() = NAN;
  EXPECT_NE(error_of(prior).find("object 1"), std::string::npos);
}

TEST(Targets, PriorWithAnIdTwiceIsRefused) {
  objects::ObjectMap prior = map_of({car(0, 0), car(9, 0)});
  prior.objects[1].id = 0;
  EXPECT_NE(error_of(prior).find("0 occurs twice"), std::string::npos);
}

TEST(Targets, TooManyAreRefusedWithTheKeyThatAllowsMore) {
  EXPECT_NE(error_of(map_of(std::vector<objects::Cuboid>(10'000, car(0, 0)))), "");
  TargetsConfig config;
  config.most_targets = 1;
  EXPECT_NE(error_of(map_of({car(0, 0), car(9, 0)}), config).find("most_targets"),
            std::string::npos);
}

}  // namespace
}  // namespace saker::active
