#include "saker/simulation/world/vehicle.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

constexpr VehicleKind kCars[] = {VehicleKind::sedan, VehicleKind::hatchback, VehicleKind::suv,
                                 VehicleKind::van, VehicleKind::pickup};

struct Drawn {
  World world;
  VehicleShape shape;
};

Drawn draw(VehicleKind kind, std::uint64_t seed) {
  Drawn d;
  core::Rng rng(seed);
  const Palette palette = make_palette(d.world, rng);
  d.shape = add_vehicle(d.world, palette, kind, SE3::Identity(), false, rng);
  return d;
}

TEST(Vehicle, TheTruthIsTheBodysBoxWithoutMirrors) {
  for (const VehicleKind kind : kCars) {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
      const Drawn d = draw(kind, seed);
      const auto& cuboid = std::get<objects::Cuboid>(d.world.objects.at(0).model);
      const Eigen::AlignedBox3d box = box_of(d.world.mesh);
      EXPECT_NEAR(box.sizes().x(), cuboid.size.x(), 0.02) << name_of(kind);
      EXPECT_NEAR(box.max().z(), cuboid.size.z(), 0.02) << name_of(kind);
      EXPECT_NEAR(box.min().z(), 0, 0.02) << name_of(kind);
      EXPECT_NEAR(box.sizes().y(), cuboid.size.y() + 0.3, 0.02) << name_of(kind);  // with mirrors
      EXPECT_NEAR(cuboid.pose.translation().z(), cuboid.size.z() / 2, 1e-9);
    }
  }
}

TEST(Vehicle, DimensionsAreThoseOfTheFleet) {
  for (const VehicleKind kind : kCars) {
    for (std::uint64_t seed = 1; seed < 200; ++seed) {
      core::Rng rng(seed);
      const VehicleShape s = random_shape(kind, rng);
      EXPECT_GT(s.length, 3.5);
      EXPECT_LT(s.length, 5.7);
      EXPECT_GT(s.width, 1.6);
      EXPECT_LT(s.width, 2.05);
      EXPECT_GT(s.height, 1.35);
      EXPECT_LT(s.height, 2.05);
    }
  }
}

TEST(Vehicle, TheFrontIsLowerThanTheMiddle) {
  for (const VehicleKind kind : kCars) {
    const Drawn d = draw(kind, 3);
    float front = 0, middle = 0;
    for (const Eigen::Vector3f& p : d.world.mesh.vertices) {
      if (p.x() > d.shape.length / 2 - 0.5) front = std::max(front, p.z());
      if (std::abs(p.x()) < 0.4F) middle = std::max(middle, p.z());
    }
    EXPECT_LT(front, middle - 0.3F) << name_of(kind);
  }
}

/// As those of mid-size pickups: 0.78 to 0.86 m unladen.
TEST(Vehicle, ALoadBedsFloorIsAsHighAsOnesThatAreSold) {
  for (std::uint64_t seed = 1; seed < 50; ++seed) {
    const Drawn d = draw(VehicleKind::pickup, seed);
    const RayCaster caster(d.world);
    const auto bed = static_cast<float>(-d.shape.length / 2 + 0.7);
    std::vector<Shot> shots(1);
    shots[0].origin = {bed, 0.1F, 3};
    shots[0].direction = -Eigen::Vector3f::UnitZ();
    caster.cast(shots, 10);
    ASSERT_TRUE(shots[0].hit);
    const double floor = 3 - shots[0].distance;
    EXPECT_GT(floor, 0.76);
    EXPECT_LT(floor, 0.9);
    EXPECT_LT(floor, d.shape.tail - 0.4) << "it has walls";
  }
}

/// Wheels have liners around them: what looks into an arch does not look into the engine.
TEST(Vehicle, NoBeamGetsThroughAWheelsArchIntoTheBody) {
  for (const VehicleKind kind : kCars) {
    const Drawn d = draw(kind, 7);
    const RayCaster caster(d.world);
    const double axle = d.shape.length / 2 - d.shape.front_axle, r = d.shape.wheel_radius;
    std::vector<Shot> shots;
    for (double x = -0.4; x <= 0.4; x += 0.02) {
      for (double z = r; z <= 2 * r + 0.05; z += 0.01) {
        const Eigen::Vector3d from(axle + x, 8, 2.5), to(axle + x, d.shape.width / 2, z);
        Shot shot;
        shot.origin = from.cast<float>();
        shot.direction = (to - from).normalized().cast<float>();
        shots.push_back(shot);
      }
    }
    caster.cast(shots, 20);
    for (const Shot& shot : shots) {
      ASSERT_TRUE(shot.hit);
      const Eigen::Vector3f met = shot.origin + shot.distance * shot.direction;
      EXPECT_GT(met.y(), d.shape.width / 2 - 0.33) << name_of(kind) << " " << met.transpose();
    }
  }
}

TEST(Vehicle, ThereIsAGapUnderTheBody) {
  const Drawn d = draw(VehicleKind::sedan, 5);
  for (const Eigen::Vector3f& p : d.world.mesh.vertices) {
    if (std::abs(p.x()) > 0.5F) continue;  // between the axles
    EXPECT_GT(p.z(), 0.1F);
  }
}

}  // namespace
}  // namespace saker::simulation
