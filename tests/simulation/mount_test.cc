#include "saker/simulation/sensor/mount.h"

#include <gtest/gtest.h>

#include <map>

namespace saker::simulation {
namespace {

TEST(Mount, EachKindStaysWithinItsHeightsAndSpeeds) {
  const BuiltWorld built = build_world(WorldKind::street, 3);
  std::map<MountKind, int> count;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    core::Rng rng(seed);
    const Mount mount = any_mount(built, rng);
    ++count[mount.kind];
    EXPECT_LE(mount.speed_mps(), 15.5);
    EXPECT_GE(mount.height_m, mount.kind == MountKind::robot ? 0.5 : 1);
    EXPECT_LE(mount.height_m, mount.kind == MountKind::air ? 30 : 3.5);
    EXPECT_NEAR((mount.T_world_vehicle.inverse() * mount.pose(0)).translation().z(), mount.height_m,
                1e-9);
  }
  EXPECT_EQ(count.size(), 5U);
}

TEST(Mount, PosesRunAlongItsSpeed) {
  Mount mount;
  mount.T_vehicle_lidar = placed(0, 0, 2, 1.0);
  mount.twist[3] = 10;
  const Eigen::Vector3d way = mount.pose(0.05).translation() - mount.pose(-0.05).translation();
  EXPECT_NEAR((way - Eigen::Vector3d(1, 0, 0)).norm(), 0, 1e-9);
}

TEST(Mount, ARayMeetsTheNearestBoxOfTheBody) {
  const std::vector<BodyBox> body = {{{2, -1, 0}, {3, 1, 1}}, {{5, -1, 0}, {6, 1, 3}}};
  EXPECT_NEAR(distance_to_body(body, {0, 0, 0.5}, Eigen::Vector3d::UnitX()), 2, 1e-9);
  EXPECT_NEAR(distance_to_body(body, {0, 0, 2}, Eigen::Vector3d::UnitX()), 5, 1e-9);
  EXPECT_FALSE(std::isfinite(distance_to_body(body, {0, 0, 2}, -Eigen::Vector3d::UnitX())));
}

}  // namespace
}  // namespace saker::simulation
