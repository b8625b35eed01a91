#include <gtest/gtest.h>

#include "made_site.h"
#include "saker/simulation/mission/flight.h"
#include "saker/simulation/mission/mission_obstacles.h"
#include "saker/simulation/mission/mission_world.h"

namespace saker::simulation {
namespace {

FlightConfig of(int moving = 0, double parked = 0.6) {
  FlightConfig config;
  config.moving_vehicles = moving;
  config.parked_share = parked;
  return config;
}

int count_of(const World& world, const std::string& class_name) {
  return static_cast<int>(
      std::count_if(world.objects.begin(), world.objects.end(),
                    [&](const TrueObject& object) { return object.class_name == class_name; }));
}

TEST(FlightWorld, HoldsVehiclesTrunksAndPoles) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const FlightWorld flight = build_flight_world(of(), seed);
    for (const char* name : {"vehicle", "trunk", "pole"})
      EXPECT_GT(count_of(flight.built.world, name), 1) << name << " " << seed;
  }
}

TEST(FlightWorld, NoTwoVehiclesStandInEachOther) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    EXPECT_EQ(overlaps(build_flight_world(of(0, 1), seed).built.world), 0) << seed;
}

TEST(FlightWorld, EveryVehicleStandsOnTheGround) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const FlightWorld flight = build_flight_world(of(), seed);
    const Terrain& terrain = flight.built.terrain;
    for (const TrueObject& object : flight.built.world.objects) {
      if (object.class_name != "vehicle") continue;
      const objects::Cuboid& c = cuboid_of(object);
      const Eigen::Vector3d foot = c.pose * Eigen::Vector3d(0, 0, -c.size.z() / 2);
      EXPECT_NEAR(foot.z(), terrain.height(foot.x(), foot.y()), 0.02) << seed;
    }
  }
}

TEST(FlightWorld, NoVehicleIsParkedInTheLane) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const FlightWorld flight = build_flight_world(of(0, 1), seed);
    for (const TrueObject& object : flight.built.world.objects) {
      if (object.class_name == "vehicle") {
        EXPECT_GT(std::abs(cuboid_of(object).pose.translation().y()), 3) << seed;
      }
    }
  }
}

TEST(FlightWorld, TheStreetIsStraightAndNearlyLevel) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const FlightWorld flight = build_flight_world(of(), seed);
    EXPECT_EQ(flight.built.terrain.heading(17), 0);
    EXPECT_LE(std::abs(flight.built.terrain.shape().grade), 0.03);
  }
}

TEST(FlightWorld, IsAsLongAsTheFlightNeeds) {
  FlightConfig config = of();
  config.duration_s = 100;
  config.speed_mps = 3;
  EXPECT_DOUBLE_EQ(build_flight_world(config, 1).built.terrain.shape().half_length, 162);
  config.duration_s = 5;
  EXPECT_DOUBLE_EQ(build_flight_world(config, 1).built.terrain.shape().half_length, 40);
}

TEST(FlightWorld, DriversMeetTheFlightOnTheRightOfTheirRoad) {
  const FlightConfig config = of(6);
  const FlightWorld flight = build_flight_world(config, 2);
  ASSERT_EQ(flight.drivers.size(), 6U);
  for (const Driver& driver : flight.drivers) {
    EXPECT_LT(driver.d * driver.speed_mps, 0);
    EXPECT_GE(std::abs(driver.speed_mps), 3);
    EXPECT_LE(std::abs(driver.speed_mps), 8);
    const auto apart = [&](double t) {
      return driver.start_s + driver.speed_mps * t - config.speed_mps * (t - config.duration_s / 2);
    };
    EXPECT_LT(apart(0.15 * config.duration_s) * apart(0.85 * config.duration_s), 0);
  }
}

TEST(FlightWorld, DriversAreInTheTruthAsMoving) {
  const FlightWorld flight = build_flight_world(of(3), 2);
  int moving = 0;
  for (const TrueObject& object : flight.built.world.objects) moving += object.moving;
  EXPECT_EQ(moving, 3);
  EXPECT_EQ(flight.built.world.movers.size(), 3U);
}

TEST(FlightWorld, TrafficChangesNothingElse) {
  const World without = build_flight_world(of(0), 5).built.world;
  const World with = build_flight_world(of(4), 5).built.world;
  EXPECT_EQ(without.mesh.vertices, with.mesh.vertices);
  EXPECT_EQ(without.placements.size(), with.placements.size());
}

TEST(FlightWorld, TheSameSeedGivesTheSameWorldAndAnotherAnother) {
  const World a = build_flight_world(of(), 5).built.world;
  const World b = build_flight_world(of(), 5).built.world;
  const World c = build_flight_world(of(), 6).built.world;
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.materials, b.mesh.materials);
  EXPECT_NE(a.mesh.vertices, c.mesh.vertices);
}

/// What add_obstacles puts between the vehicles of a flight.
struct Obstructed {
  Obstructed(int count, std::uint64_t seed) : flight(build_flight_world(of(), seed)) {
    for (std::size_t i = 0; i < flight.built.world.objects.size() && targets.size() < 10; ++i) {
      if (flight.built.world.objects[i].class_name == "vehicle") targets.push_back(i);
    }
    objects_before = flight.built.world.objects.size();
    placements_before = flight.built.world.placements.size();
    core::Rng rng(seed);
    add_obstacles(flight, targets, takeoff, count, rng);
  }

  FlightWorld flight;
  std::vector<std::size_t> targets;
  std::size_t objects_before = 0, placements_before = 0;
  Eigen::Vector3d takeoff = Eigen::Vector3d::Zero();
};

TEST(Obstacles, PostsWallsAndHedgesComeInTurn) {
  for (int count = 0; count <= 7; ++count) {
    const Obstructed o(count, 3);
    EXPECT_EQ(o.flight.built.world.objects.size() - o.objects_before,
              static_cast<std::size_t>((count + 2) / 3));
    EXPECT_EQ(o.flight.built.world.placements.size() - o.placements_before,
              static_cast<std::size_t>(3 * (count / 3)));
  }
}

TEST(Obstacles, AreHigherThanOneFliesAndLeaveRoomAboutTheTakeoff) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Obstructed o(6, seed);
    const World& world = o.flight.built.world;
    for (std::size_t i = o.objects_before; i < world.objects.size(); ++i) {
      const auto& post = std::get<objects::Cylinder>(world.objects[i].model);
      EXPECT_GE(post.height, 4.5);
      EXPECT_GT((post.root - o.takeoff).head<2>().norm(), 5);
      EXPECT_NEAR(post.root.z(), o.flight.built.terrain.height(post.root.x(), post.root.y()), 1e-6);
    }
  }
}

TEST(Obstacles, LeaveAGapBetweenEachOther) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Obstructed o(7, seed);
    const World& world = o.flight.built.world;
    std::vector<Eigen::Vector2d> posts;
    for (std::size_t i = o.objects_before; i < world.objects.size(); ++i)
      posts.emplace_back(objects::place(world.objects[i].model).head<2>());
    for (std::size_t i = 1; i < posts.size(); ++i)
      EXPECT_GT((posts[i] - posts[i - 1]).norm(), 6.5) << seed;
  }
}

}  // namespace
}  // namespace saker::simulation
