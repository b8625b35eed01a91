#include "flight/viewers/robot_state.h"

#include <gtest/gtest.h>

#include <set>

#include "flight_viewers/made_robot.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

/// A vehicle of the map that is turned by `yaw`.
ShownObject turned(double yaw) {
  ShownObject shown_one = shown(made_vehicle(1, 0, 0), 0);
  std::get<objects::Cuboid>(shown_one.object.model).pose.linear() =
      Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return shown_one;
}

/// R diag(0.09, 0.01) Rᵀ, written out.
TEST(ShownObject, ItsCovarianceTurnsWithIt) {
  for (const double yaw : {0.0, 0.3, 1.0, 2.5, -0.7}) {
    const double c = std::cos(yaw), s = std::sin(yaw);
    const Eigen::Vector3d covariance = turned(yaw).place_covariance();
    EXPECT_NEAR(covariance(0), 0.09 * c * c + 0.01 * s * s, 1e-6) << yaw;
    EXPECT_NEAR(covariance(1), 0.08 * c * s, 1e-6) << yaw;
    EXPECT_NEAR(covariance(2), 0.09 * s * s + 0.01 * c * c, 1e-6) << yaw;
  }
}

TEST(ShownObject, WithoutDeviationsItHasNoCovariance) {
  EXPECT_FALSE(shown(made_pole(1, 0, 0), 0).place_covariance().allFinite());
}

TEST(ShownObject, AFilesObjectAndOneOfTheBusSayTheSame) {
  const objects::MapObject vehicle = made_vehicle(3, 10, 2);
  const ShownObject file = shown(vehicle, 5);
  const auto bus = shown(to_lcm(vehicle), objects::ClassTable().size(), 5);
  ASSERT_TRUE(bus);
  EXPECT_TRUE(bus->position_sd.isApprox(file.position_sd));
  EXPECT_TRUE(bus->size_sd.isApprox(file.size_sd));
  EXPECT_TRUE(objects::place(bus->object.model).isApprox(objects::place(vehicle.model), 1e-6));
  EXPECT_EQ(bus->t, 5);
}

TEST(ShownObject, OfAnotherClassTableIsNone) {
  map_object_t message = to_lcm(made_vehicle(3, 10, 2));
  message.class_id = 100;
  EXPECT_EQ(shown(message, objects::ClassTable().size(), 0), std::nullopt);
  message.class_id = -1;
  EXPECT_EQ(shown(message, objects::ClassTable().size(), 0), std::nullopt);
}

struct TargetsTest : ::testing::Test {
  void map(const std::vector<objects::MapObject>& objects) {
    for (const objects::MapObject& object : objects) state.objects[object.id] = shown(object, 0);
  }
  [[nodiscard]] std::map<int, int> found() const { return targets_by_object(state, site); }

  RobotState state;
  Site site;
};

TEST_F(TargetsTest, AreFoundWithinThreeMetres) {
  site.prior.objects = {made_vehicle(31, 0, 0), made_vehicle(32, 20, 0)};
  map({made_vehicle(1, 2.9, 0), made_vehicle(2, 23.1, 0)});
  EXPECT_EQ(found(), (std::map<int, int>{{1, 31}}));
}

TEST_F(TargetsTest, AreTheNearestOfTheirClass) {
  site.prior.objects = {made_vehicle(31, 0, 0)};
  map({made_vehicle(1, 2, 0), made_vehicle(2, 0, 1), made_pole(3, 0.1, 0)});
  EXPECT_EQ(found(), (std::map<int, int>{{2, 31}}));
}

TEST_F(TargetsTest, AreFoundWhateverTheHeight) {
  objects::MapObject high = made_vehicle(31, 0, 0);
  std::get<objects::Cuboid>(high.model).pose.translation().z() = 50;
  site.prior.objects = {high};
  map({made_vehicle(1, 1, 0)});
  EXPECT_EQ(found(), (std::map<int, int>{{1, 31}}));
}

TEST_F(TargetsTest, AnObjectIsOneTarget) {
  site.prior.objects = {made_vehicle(31, 0, 0), made_vehicle(32, 1, 0)};
  map({made_vehicle(1, 0.5, 0)});
  EXPECT_EQ(found().size(), 1u);
}

TEST_F(TargetsTest, WithoutAPriorMapThereAreNone) {
  map({made_vehicle(1, 0, 0)});
  EXPECT_TRUE(found().empty());
}

TEST(FlownPath, HasAPointEveryQuarterMetre) {
  FlownPath path;
  for (int i = 0; i <= 1000; ++i) path.add({0.01 * i, 0, 0}, i);
  EXPECT_NEAR(path.length_m(), 10, 0.25);
  EXPECT_NEAR(static_cast<double>(path.points().size()), 40, 1);
  for (std::size_t i = 1; i < path.points().size(); ++i)
    EXPECT_GE((path.points()[i] - path.points()[i - 1]).norm(), 0.25 - 1e-9);
}

TEST(FlownPath, OfOneThatHoversDoesNotGrow) {
  FlownPath path;
  for (int i = 0; i < 10000; ++i) path.add({0.1 * (i % 2), 0, 3}, i);
  EXPECT_EQ(path.points().size(), 1u);
  EXPECT_EQ(path.length_m(), 0);
}

TEST(FlownPath, TakesNothingThatIsNoPlace) {
  FlownPath path;
  path.add({NAN, 0, 0}, 0);
  path.add({INFINITY, 0, 0}, 1);
  EXPECT_TRUE(path.points().empty());
  path.add({1, 2, 3}, 2);
  EXPECT_EQ(path.times(), std::vector<double>{2});
}

TEST(FlownPath, ThinnedItsPointsKeepTheirTimes) {
  FlownPath path;
  for (int i = 0; i < 30000; ++i) path.add({0.5 * i, 0, 0}, 10.0 * i);
  for (std::size_t i = 0; i < path.points().size(); ++i)
    EXPECT_DOUBLE_EQ(path.times()[i], 20 * path.points()[i].x());
}

TEST(FlownPath, ClearedItBeginsAnew) {
  FlownPath path;
  path.add({0, 0, 0}, 0);
  path.add({5, 0, 0}, 1);
  path.clear();
  EXPECT_EQ(path.length_m(), 0);
  path.add({9, 0, 0}, 2);
  EXPECT_EQ(path.length_m(), 0);  // no way from where it was before
}

TEST(Colours, OfSixRobotsDifferAndTheSeventhBeginsAnew) {
  std::set<std::tuple<int, int, int>> seen;
  for (std::size_t i = 0; i < 6; ++i) {
    const core::Colour c = colour_of_robot(i);
    EXPECT_TRUE(seen.emplace(c.red, c.green, c.blue).second) << i;
  }
  EXPECT_EQ(colour_of_robot(6).red, colour_of_robot(0).red);
}

TEST(Colours, OfVehiclesTrunksAndPolesDiffer) {
  const objects::ClassTable table;
  std::set<std::tuple<int, int, int>> seen;
  for (const char* name : {"vehicle", "trunk", "pole"}) {
    const core::Colour c = colour_of(table[table.find(name)]);
    EXPECT_TRUE(seen.emplace(c.red, c.green, c.blue).second) << name;
  }
}

}  // namespace
}  // namespace saker::flight::viewers
