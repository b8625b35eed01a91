#include "tools/saker/experiment/reachable_targets.h"

#include <gtest/gtest.h>

namespace saker::tools {
namespace {

constexpr int kId = 1;
const std::vector<double> kAround = {-20, -20, 20, -20, 20, 20, -20, 20};

/// A vehicle of 4 x 2 x 1.5 m that stands at the origin of a plain.
class ReachableTargets : public testing::Test {
 protected:
  ReachableTargets() {
    const auto ground = world_.add({simulation::kRoad, 0.3F, 0, 0, 0, 0});
    paint_ = world_.add({simulation::kCar, 0.3F, 0, 0, 0, 0});
    wall_ = world_.add({simulation::kBuilding, 0.3F, 0, 0, 0, 0});
    simulation::Pen(world_.mesh)
        .quad({-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, ground);
    objects::Cuboid cuboid;
    cuboid.pose.translation().z() = 0.75;
    cuboid.size = {4, 2, 1.5};
    objects::MapObject object;
    object.id = kId;
    object.class_id = 1;
    object.model = cuboid;
    truth_.objects.push_back(object);
    const auto id = world_.add(simulation::TrueObject{"vehicle", "sedan", cuboid});
    simulation::Pen(world_.mesh, SE3::Identity(), id).box({-2, -1, 0}, {2, 1, 1.5}, paint_);
  }

  void add_box(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    simulation::Pen(world_.mesh).box(low, high, wall_);
  }

  [[nodiscard]] bool reachable(const motion::GeofenceConfig& fence) const {
    const simulation::RayCaster caster(world_);
    const ReachableSpace space{world_, caster, SE3::Identity(), fence, 0.4};
    return reachable_targets({kId}, truth_, space, {}) == std::vector<int>{kId};
  }

  simulation::World world_;
  simulation::MaterialId paint_ = 0, wall_ = 0;
  objects::ObjectMap truth_;
};

TEST_F(ReachableTargets, HoldOneThatStandsFreeInsideTheFence) {
  EXPECT_TRUE(reachable({0.5, 12, kAround}));
}

TEST_F(ReachableTargets, LackOneThatIsTooFarFromTheFence) {
  EXPECT_TRUE(reachable({0.5, 12, {8, -5, 18, -5, 18, 5, 8, 5}}));
  EXPECT_FALSE(reachable({0.5, 12, {17, -5, 27, -5, 27, 5, 17, 5}}));
}

TEST_F(ReachableTargets, LackOneThatLiesBelowTheViewFromTheFencesFloor) {
  EXPECT_FALSE(reachable({11, 12, kAround}));
}

TEST_F(ReachableTargets, LackOneThatWallsHideOnAllSides) {
  add_box({-6, -6, 0}, {6, -5.8, 12});
  add_box({-6, 5.8, 0}, {6, 6, 12});
  add_box({-6, -6, 0}, {-5.8, 6, 12});
  EXPECT_TRUE(reachable({0.5, 12, kAround})) << "the fourth side is open";
  const std::vector<double> outside = {7, -20, 20, -20, 20, 20, 7, 20};
  EXPECT_TRUE(reachable({0.5, 5, outside}));
  add_box({5.8, -6, 0}, {6, 6, 12});
  EXPECT_FALSE(reachable({0.5, 5, outside}));
}

TEST_F(ReachableTargets, LackOneAroundWhichTheVehicleHasNoRoom) {
  add_box({-20, -20, 2.2}, {20, 20, 2.4});  // a ceiling 0.5 m over where it would fly
  EXPECT_TRUE(reachable({1.7, 1.75, kAround}));
  EXPECT_FALSE(reachable({1.9, 2.0, kAround}));
}

TEST_F(ReachableTargets, LackOneThatIsNotInTheTruth) {
  const simulation::RayCaster caster(world_);
  const ReachableSpace space{world_, caster, SE3::Identity(), {0.5, 12, kAround}, 0.4};
  EXPECT_EQ(reachable_targets({kId, 7}, truth_, space, {}), std::vector<int>{kId});
}

}  // namespace
}  // namespace saker::tools
