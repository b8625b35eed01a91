#include "saker/simulation/mission/spiral_flight.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"
#include "saker/simulation/vehicle/collision.h"

namespace saker::simulation {
namespace {

SpiralConfig short_spiral() {
  SpiralConfig config;
  config.duration_s = 10;
  return config;
}

TEST(SpiralWorld, HoldsTheObjectThatWasAskedFor) {
  const std::vector<std::pair<SpiralSubject, std::string>> wanted = {{{"vehicle", 0}, "sedan"},
                                                                     {{"vehicle", 3}, "van"},
                                                                     {{"vehicle", 9}, "pickup"},
                                                                     {{"pole", 0}, "lamp"},
                                                                     {{"pole", 3}, "sign"}};
  for (const auto& [subject, kind] : wanted) {
    const SpiralWorld site = build_spiral_world({}, subject, 5);
    const TrueObject& object = site.world.objects[site.subject - 1];
    EXPECT_EQ(object.class_name, subject.class_name);
    EXPECT_EQ(object.kind, kind);
  }
  const SpiralWorld tree = build_spiral_world({}, {"trunk", 0}, 5);
  EXPECT_EQ(tree.world.objects[tree.subject - 1].class_name, "trunk");
}

TEST(SpiralWorld, RefusesAClassThatItCannotMake) {
  try {
    (void)build_spiral_world({}, {"bin", 0}, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("bin"), std::string::npos);
  }
}

TEST(SpiralWorld, ThePathTouchesNothing) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const SpiralConfig config;
    const SpiralSubject subject{seed % 3 == 0 ? "trunk" : "vehicle", static_cast<int>(seed)};
    const SpiralWorld site = build_spiral_world(config, subject, seed);
    const RayCaster caster(site.world);
    const std::vector<bool> ground = ground_materials(site.world);
    for (double t = 0; t < config.duration_s; t += 0.1) {
      const Eigen::Vector3f p = site.path.pose(t).translation().cast<float>();
      EXPECT_FALSE(caster.nearest(p, 0.4F, ground)) << seed << " " << t;
    }
  }
}

TEST(SpiralWorld, CarsAreParkedBesideTheObjectInAShareOfTheWorlds) {
  const auto beside = [](double share) {
    SpiralConfig config;
    config.neighbour_share = share;
    config.clutter = 0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const SpiralWorld site = build_spiral_world(config, {"vehicle", 0}, seed);
      const Eigen::Vector3d at = objects::place(site.world.objects[site.subject - 1].model);
      for (const TrueObject& object : site.world.objects) {
        const double range = (objects::place(object.model) - at).norm();
        count += object.class_name == "vehicle" && range > 0.1 && range < 8 ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_EQ(beside(0), 0);
  EXPECT_GE(beside(1), 6);
}

TEST(SpiralFlight, ItsScansShowTheObjectWhereItIs) {
  SpiralFlight flight(short_spiral(), {"vehicle", 0}, 7);
  int scans = 0;
  long inside = 0, returns = 0;
  const auto& cuboid =
      std::get<objects::Cuboid>(flight.world().objects[flight.subject() - 1].model);
  while (const auto frame = flight.next()) {
    ++scans;
    EXPECT_TRUE(frame->fault.empty());
    EXPECT_FALSE(frame->imu.empty());
    if (frame->scan.stamp - flight.start() > from_seconds(1.5)) continue;  // it hovers till then
    const SE3 T_cuboid_lidar = cuboid.pose.inverse() * flight.T_sim_lidar(frame->scan.stamp);
    for (const Eigen::Vector3f& point : frame->scan.points) {
      const Eigen::Vector3d p = T_cuboid_lidar * point.cast<double>();
      const Eigen::Vector3d most = cuboid.size / 2 + Eigen::Vector3d(0.1, 0.1, 0.1);
      inside += (p.cwiseAbs().array() <= most.array()).all() ? 1 : 0;
    }
    returns += flight.returns(frame->scan.stamp, flight.subject());
  }
  EXPECT_EQ(scans, flight.expected_scans());
  EXPECT_GT(returns, 100);
  EXPECT_GT(static_cast<double>(inside), 0.9 * static_cast<double>(returns));
}

TEST(SpiralFlight, TheSameSeedGivesTheSameScans) {
  SpiralFlight one(short_spiral(), {"pole", 1}, 9), two(short_spiral(), {"pole", 1}, 9);
  for (int i = 0; i < 5; ++i) {
    const auto a = one.next(), b = two.next();
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->scan.reflectivity, b->scan.reflectivity);
    EXPECT_EQ(a->scan.stamp, b->scan.stamp);
  }
}

}  // namespace
}  // namespace saker::simulation
