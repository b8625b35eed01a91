#include "saker/simulation/sensor/mount.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(Mount, ThePoseInTheMiddleIsThatOfTheMountedSensor) {
  Mount mount;
  mount.T_world_vehicle = placed(5, 6, 7, 0.4);
  mount.T_vehicle_lidar = placed(0, 0, 2, 0.1);
  mount.twist << 0.1, 0.2, 0.3, 4, 5, 6;
  EXPECT_TRUE(mount.pose(0).isApprox(mount.T_world_vehicle * mount.T_vehicle_lidar, 1e-12));
}

TEST(Mount, SpeedIsThatOfItsTranslation) {
  Mount mount;
  mount.twist << 9, 9, 9, 3, 0, 4;
  EXPECT_DOUBLE_EQ(mount.speed_mps(), 5);
}

/// `check` on many carriers on one street.
template <class Check>
void for_each_mount(Check check) {
  static const BuiltWorld built = build_world(WorldKind::street, 3);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    core::Rng rng(seed);
    SCOPED_TRACE(seed);
    check(built, any_mount(built, rng));
  }
}

TEST(Mount, StandsOnAFreePlaceOfTheWorld) {
  for_each_mount([](const BuiltWorld& built, const Mount& mount) {
    const Eigen::Vector3d p = mount.T_world_vehicle.translation();
    double nearest = 1e9;
    for (const Eigen::Vector2d& place : built.free_places)
      nearest = std::min(nearest, (built.terrain.point(place.x(), place.y()) - p).norm());
    EXPECT_LT(nearest, 1e-6);
  });
}

TEST(Mount, NoSensorLeansByMoreThanTwentyDegrees) {
  for_each_mount([](const BuiltWorld&, const Mount& mount) {
    const double roll_pitch = std::acos(mount.T_vehicle_lidar.linear()(2, 2));
    EXPECT_LT(roll_pitch, 0.51);
  });
}

TEST(Mount, ManyScansAreTakenStanding) {
  int standing = 0;
  for_each_mount([&](const BuiltWorld&, const Mount& mount) {
    standing += mount.twist.norm() == 0;
    EXPECT_EQ(mount.twist.norm() == 0, mount.speed_mps() == 0);
  });
  EXPECT_NEAR(standing / 300.0, 0.38, 0.08);
}

TEST(Mount, OnlyAircraftFlySidewaysOrUp) {
  for_each_mount([](const BuiltWorld&, const Mount& mount) {
    if (mount.kind != MountKind::air) {
      EXPECT_EQ(mount.twist[4], 0);
      EXPECT_EQ(mount.twist[5], 0);
      EXPECT_GE(mount.twist[3], 0);
    }
  });
}

TEST(Mount, NoCarrierReachesAroundItsSensor) {
  for_each_mount([](const BuiltWorld&, const Mount& mount) {
    for (const BodyBox& box : mount.body) {
      const Eigen::AlignedBox3d body(box.low, box.high);
      EXPECT_FALSE(body.contains(Eigen::Vector3d(0, 0, mount.height_m))) << name_of(mount.kind);
    }
  });
}

TEST(Mount, ACarsSensorSeesTheGroundBesideItsRoof) {
  for_each_mount([](const BuiltWorld&, const Mount& mount) {
    if (mount.kind != MountKind::car) return;
    const Eigen::Vector3d from(0, 0, mount.height_m);
    EXPECT_TRUE(std::isfinite(distance_to_body(mount.body, from, {0.2, 0.01, -1})));
    EXPECT_FALSE(std::isfinite(distance_to_body(mount.body, from, {0.01, 1, -0.1})));
    EXPECT_FALSE(std::isfinite(distance_to_body(mount.body, from, {1, 0.01, 0.05})));
  });
}

TEST(DistanceToBody, WithoutABodyIsInfinite) {
  EXPECT_FALSE(std::isfinite(distance_to_body({}, Eigen::Vector3d::Zero(), {1, 0, 0})));
}

}  // namespace
}  // namespace saker::simulation
