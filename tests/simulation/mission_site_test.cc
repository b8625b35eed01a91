#include "saker/simulation/mission/mission_site.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "paths.h"
#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/core/statistics.h"
#include "saker/simulation/mission/mission_world.h"
#include "saker/simulation/mission/scenario.h"

namespace saker::simulation {
namespace {

constexpr std::uint64_t kSeeds = 10;

MissionConfig config_of(SiteKind kind) {
  MissionConfig config;
  config.site.kind = kind;
  config.site.parked_share = kind == SiteKind::garage ? 0.8 : 0.35;
  config.site.targets = 6;
  return config;
}

std::set<std::string> classes_of(const World& world) {
  std::set<std::string> classes;
  for (const TrueObject& object : world.objects) classes.insert(object.class_name);
  return classes;
}

/// Area, m², of each material on one object.
std::map<MaterialId, double> areas_of(const Mesh& mesh, ObjectId object) {
  std::map<MaterialId, double> areas;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (mesh.objects[i] != object) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3f& origin = mesh.vertices[a];
    areas[mesh.materials[i]] +=
        0.5F * (mesh.vertices[b] - origin).cross(mesh.vertices[c] - origin).norm();
  }
  return areas;
}

double reflectivity_of_body(const World& world, ObjectId object) {
  const auto areas = areas_of(world.mesh, object);
  const auto largest = std::max_element(areas.begin(), areas.end(),
                                        [](auto& a, auto& b) { return a.second < b.second; });
  return world.materials[largest->first].reflectivity;
}

Shot cast(const RayCaster& caster, const Eigen::Vector3d& from, const Eigen::Vector3d& towards) {
  std::vector<Shot> shots(1);
  shots[0].origin = from.cast<float>();
  shots[0].direction = towards.normalized().cast<float>();
  caster.cast(shots, 200);
  return shots[0];
}

MissionConfig shipped(const std::string& scenario) {
  const std::string file = source_dir() + "/configs/scenarios/" + scenario + ".yaml";
  return core::load_config<Scenario>(file, {}).mission;
}

/// The scenarios of the paper's table.
TEST(MissionSite, EveryScenarioHasItsTargetsAndAFreeTakeoffForTenSeeds) {
  for (const char* name : {"urban1", "urban2", "urban3", "urban4", "garage", "dirt_road"}) {
    const MissionConfig config = shipped(name);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const MissionWorld site = build_mission_world(config, seed);
      EXPECT_EQ(static_cast<int>(site.prior.objects.size()), config.site.targets) << name;
    }
  }
}

TEST(MissionSite, NeitherGarageNorDirtRoadHasTrunksOrPoles) {
  for (const char* name : {"garage", "dirt_road"}) {
    const MissionWorld site = build_mission_world(shipped(name), 1);
    EXPECT_EQ(classes_of(site.world()), std::set<std::string>{"vehicle"}) << name;
  }
}

TEST(MissionSite, PaintedBlackNoVehicleReturnsMoreThanATwentieth) {
  MissionConfig config = config_of(SiteKind::street);
  config.site.style.paint = Paint::black;
  const MissionWorld site = build_mission_world(config, 1);
  int vehicles = 0;
  for (std::size_t i = 0; i < site.world().objects.size(); ++i) {
    if (site.world().objects[i].class_name != "vehicle") continue;
    ++vehicles;
    EXPECT_LE(reflectivity_of_body(site.world(), static_cast<ObjectId>(i + 1)), 0.051);
  }
  EXPECT_GE(vehicles, 6);
}

TEST(MissionSite, MoreLampsAndTreesAreMoreInTheTruth) {
  const auto count = [](double factor, const char* of_class) {
    MissionConfig config = config_of(SiteKind::street);
    config.site.style.lamps = factor;
    config.site.style.trees = factor;
    int sum = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const MissionWorld site = build_mission_world(config, seed);
      for (const TrueObject& object : site.world().objects) {
        sum += object.class_name == of_class;
      }
    }
    return sum;
  };
  EXPECT_GT(count(1.5, "trunk"), 1.2 * count(0.7, "trunk"));
  EXPECT_GT(count(1.5, "pole"), count(0.7, "pole"));
}

TEST(MissionSite, AGarageIsClosedOnAllSidesAndAbove) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const MissionConfig config = config_of(SiteKind::garage);
    const MissionWorld site = build_mission_world(config, seed);
    const RayCaster caster(site.world());
    const Eigen::Vector3d eye =
        site.T_sim_world.translation() + Eigen::Vector3d(0, 0, 2.3 - config.airframe.leg_m);
    for (int i = 0; i < 60; ++i) {
      const double bearing = i * 2 * M_PI / 60;
      const Shot level = cast(caster, eye, {std::cos(bearing), std::sin(bearing), 0});
      EXPECT_TRUE(level.hit);
      EXPECT_LT(level.distance, config.site.street_m);
    }
    EXPECT_NEAR(cast(caster, eye, Eigen::Vector3d::UnitZ()).distance, config.site.ceiling_m - 2.3,
                0.05);
  }
}

/// Above all roofs, along the ends of the bays.
TEST(MissionSite, PillarsStandAlongTheAislesOfAGarage) {
  const MissionWorld site = build_mission_world(config_of(SiteKind::garage), 4);
  const RayCaster caster(site.world());
  for (const double d : {-3.8, 3.8, 12.6, 20.2}) {
    for (double s = -30; s < 30; s += 3.1) {
      const Shot along = cast(caster, {s, d, 2.8}, Eigen::Vector3d::UnitX());
      EXPECT_TRUE(along.hit);
      EXPECT_LT(along.distance, 7.9);
    }
  }
}

TEST(MissionSite, TheGeofenceOfAGarageEndsBelowItsCeiling) {
  const MissionConfig config = config_of(SiteKind::garage);
  EXPECT_LE(build_mission_world(config, 1).fence.highest_m, config.site.ceiling_m - 0.9);
}

TEST(MissionSite, ADirtRoadIsRough) {
  const MissionWorld site = build_mission_world(config_of(SiteKind::dirt_road), 2);
  const Terrain& terrain = site.flight.built.terrain;
  std::vector<double> bends;  // of the ground over 4 m, along the road
  for (double s = -35; s < 35; s += 0.5) {
    bends.push_back(terrain.height(s + 2, 1) + terrain.height(s - 2, 1) - 2 * terrain.height(s, 1));
  }
  EXPECT_GT(core::standard_deviation(bends), 0.04);
}

TEST(MissionSite, WhatAKindOfSiteHasNotIsRefusedByName) {
  for (const char* key : {"obstacles", "moving_vehicles"}) {
    MissionConfig config = config_of(SiteKind::garage);
    (key == std::string("obstacles") ? config.site.obstacles : config.site.moving_vehicles) = 2;
    try {
      (void)build_mission_world(config, 1);
      FAIL();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(key), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace saker::simulation
