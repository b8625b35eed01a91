#include "saker/simulation/mission/mission_world.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "saker/core/error.h"
#include "saker/simulation/mission/truth.h"
#include "saker/simulation/vehicle/collision.h"

namespace saker::simulation {
namespace {

std::vector<int> no_hits(const World& world) {
  return std::vector<int>(world.objects.size() + 1, 0);
}

TEST(MissionWorld, ThePriorHoldsTheTargetsNearTheirTruePlaces) {
  MissionConfig config;
  config.site.prior_sd_m = 0.5;
  const MissionWorld site = build_mission_world(config, 1);
  EXPECT_EQ(site.prior.objects.size(), 8U);
  const objects::ObjectMap truth =
      truth_map(site.world(), site.T_sim_world.inverse(), no_hits(site.world()));
  double sum = 0;
  for (const objects::MapObject& rough : site.prior.objects) {
    const auto& object = truth.objects.at(static_cast<std::size_t>(rough.id - 1));
    EXPECT_EQ(object.class_id, rough.class_id);
    const Eigen::Vector3d apart = objects::place(object.model) - objects::place(rough.model);
    EXPECT_NEAR(apart.z(), 0, 1e-9);
    const double least = apart.head<2>().norm();
    EXPECT_LT(least, 2.0);
    sum += least;
  }
  EXPECT_GT(sum / 8, 0.1);
}

TEST(MissionWorld, TheTakeoffIsFreeAndStandsOnTheGround) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const MissionConfig config;
    const MissionWorld site = build_mission_world(config, seed);
    const RayCaster caster(site.world());
    CollisionMonitor contacts(caster, site.world(), config.airframe.radius_m);
    for (double z = 0; z < 6; z += 0.5)
      contacts.check(site.T_sim_world.translation() + Eigen::Vector3d(0, 0, z));
    EXPECT_EQ(contacts.collisions(), 0);
    EXPECT_GT(contacts.min_clearance(), 1.0);
    std::vector<Shot> down(1);
    down[0].origin = site.T_sim_world.translation().cast<float>();
    down[0].direction = -Eigen::Vector3f::UnitZ();
    caster.cast(down, 10);
    EXPECT_TRUE(down[0].hit);
    EXPECT_NEAR(down[0].distance, config.airframe.leg_m, 0.03);
  }
}

TEST(MissionWorld, ObstaclesStandBetweenTheTargetsAndPostsAreInTheTruth) {
  MissionConfig config;
  const MissionWorld without = build_mission_world(config, 2);
  config.site.obstacles = 6;
  const MissionWorld with = build_mission_world(config, 2);
  EXPECT_TRUE(with.T_sim_world.isApprox(without.T_sim_world));
  EXPECT_EQ(with.world().objects.size(), without.world().objects.size() + 2);
  EXPECT_GT(with.world().placements.size(), without.world().placements.size());
  EXPECT_GT(with.world().mesh.triangles.size(), without.world().mesh.triangles.size());
}

/// Along each post, up to where one flies.
TEST(MissionWorld, PostsAreHigherThanOneFliesAndApartFromVehicles) {
  MissionConfig config;
  config.site.obstacles = 7;
  const MissionWorld site = build_mission_world(config, 6);
  int posts = 0;
  for (const TrueObject& object : site.world().objects) {
    if (object.kind != "post") continue;
    ++posts;
    const auto& post = std::get<objects::Cylinder>(object.model);
    EXPECT_GT(post.height, 4);
    EXPECT_GT((post.root - site.T_sim_world.translation()).norm(), 4);
    for (const TrueObject& other : site.world().objects) {
      const auto* cuboid = std::get_if<objects::Cuboid>(&other.model);
      if (cuboid == nullptr) continue;
      EXPECT_GT((cuboid->pose.translation() - post.root).head<2>().norm(), 2);
    }
  }
  EXPECT_EQ(posts, 3);
}

TEST(MissionWorld, MoreObstaclesThanThereIsRoomForAreRefusedByName) {
  MissionConfig config;
  config.site.obstacles = 40;
  config.site.targets = 2;
  try {
    (void)build_mission_world(config, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("mission.site.obstacles"), std::string::npos);
  }
}

TEST(MissionWorld, AMovingVehicleDrivesAndStaysOutOfTheMap) {
  MissionConfig config;
  config.site.moving_vehicles = 1;
  const MissionWorld site = build_mission_world(config, 7);
  const Driver& driver = site.flight.drivers.at(0);
  RayCaster caster(site.world());
  const std::vector<bool> ground = ground_materials(site.world());
  const auto on_the_way = [&](double t) {
    const double s = driver.start_s + driver.speed_mps * t;
    const SE3 T = site.flight.built.terrain.upright(s, driver.d);
    return (T.translation() + Eigen::Vector3d(0, 0, 0.8)).cast<float>().eval();
  };
  double t = 0;
  while (std::abs(driver.start_s + driver.speed_mps * t) > 15) t += 0.5;
  drive(site.flight, t, caster);
  EXPECT_TRUE(caster.nearest(on_the_way(t), 0.8F, ground).has_value());
  drive(site.flight, t + 3, caster);
  EXPECT_FALSE(caster.nearest(on_the_way(t), 0.8F, ground).has_value());
  const objects::ObjectMap truth =
      truth_map(site.world(), site.T_sim_world.inverse(), no_hits(site.world()));
  EXPECT_EQ(truth.objects.size() + 1, site.world().objects.size());
}

TEST(MissionWorld, TheSameSeedGivesTheSameWorldAndAnotherSeedAnother) {
  const MissionConfig config;
  const MissionWorld a = build_mission_world(config, 3);
  const MissionWorld b = build_mission_world(config, 3);
  const MissionWorld c = build_mission_world(config, 4);
  EXPECT_EQ(a.T_sim_world.matrix(), b.T_sim_world.matrix());
  EXPECT_EQ(a.world().mesh.vertices, b.world().mesh.vertices);
  EXPECT_NE(a.T_sim_world.matrix(), c.T_sim_world.matrix());
}

TEST(MissionWorld, MoreTargetsThanVehiclesAreRefusedByName) {
  MissionConfig config;
  config.site.targets = 90;
  try {
    (void)build_mission_world(config, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("mission.site.targets"), std::string::npos);
  }
}

TEST(MissionWorld, TheFenceHoldsAllTargets) {
  const MissionWorld site = build_mission_world({}, 5);
  for (const objects::MapObject& target : site.prior.objects) {
    const Eigen::Vector3d p = objects::place(target.model);
    EXPECT_GT(p.x(), site.fence.polygon_m[0] + 5);
    EXPECT_LT(p.x(), site.fence.polygon_m[4] - 5);
    EXPECT_GT(p.y(), site.fence.polygon_m[1] + 5);
    EXPECT_LT(p.y(), site.fence.polygon_m[5] - 5);
  }
}

const objects::MapObject* entry_of(const objects::ObjectMap& map, int id) {
  const auto found = std::ranges::find(map.objects, id, &objects::MapObject::id);
  return found == map.objects.end() ? nullptr : &*found;
}

TEST(MissionWorld, WithoutAPriorTheSiteAndItsFenceAreTheSame) {
  MissionConfig config;
  const MissionWorld with = build_mission_world(config, 3);
  config.site.no_prior = true;
  const MissionWorld without = build_mission_world(config, 3);
  EXPECT_TRUE(without.prior.objects.empty());
  EXPECT_EQ(without.targets, with.targets);
  EXPECT_EQ(without.targets.size(), 8U);
  EXPECT_EQ(without.fence.polygon_m, with.fence.polygon_m);
}

TEST(MissionWorld, AWrongPriorHasWhatItWasAskedForAndTheRightOnesStay) {
  MissionConfig config;
  const MissionWorld right = build_mission_world(config, 4);
  config.site.prior_errors = {.missing_share = 0.25, .invented = 2, .duplicates = 3, .mistaken = 1};
  const MissionWorld wrong = build_mission_world(config, 4);
  EXPECT_EQ(wrong.prior.objects.size(), 8U - 2 + 2 + 3 + 1);
  EXPECT_EQ(wrong.targets, right.targets);
  EXPECT_EQ(wrong.fence.polygon_m, right.fence.polygon_m);
  int kept = 0;
  for (const objects::MapObject& entry : right.prior.objects) {
    const objects::MapObject* same = entry_of(wrong.prior, entry.id);
    if (same == nullptr) continue;
    ++kept;
    EXPECT_EQ(objects::place(same->model), objects::place(entry.model));
  }
  EXPECT_EQ(kept, 6);
}

TEST(MissionWorld, InventedVehiclesAreFarFromAllTrueOnesAndInTheFence) {
  MissionConfig config;
  config.site.prior_errors.invented = 4;
  const MissionWorld site = build_mission_world(config, 4);
  const objects::ObjectMap truth =
      truth_map(site.world(), site.T_sim_world.inverse(), no_hits(site.world()));
  int invented = 0;
  for (const objects::MapObject& entry : site.prior.objects) {
    if (std::ranges::find(site.targets, entry.id) != site.targets.end()) continue;
    ++invented;
    const Eigen::Vector3d place = objects::place(entry.model);
    EXPECT_GT(place.x(), site.fence.polygon_m[0]);
    EXPECT_LT(place.x(), site.fence.polygon_m[4]);
    for (const objects::MapObject& object : truth.objects) {
      if (object.class_id != entry.class_id) continue;
      EXPECT_GT((objects::place(object.model) - place).head<2>().norm(), 7.9);
    }
  }
  EXPECT_EQ(invented, 4);
}

TEST(MissionWorld, MoreMistakenThanThereAreTreesAndPolesAreRefusedByName) {
  MissionConfig config;
  config.site.prior_errors.mistaken = 100;
  try {
    (void)build_mission_world(config, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("prior_errors.mistaken"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::simulation
