#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {
namespace {

using enum VehicleKind;

constexpr VehicleKind kCars[] = {sedan, hatchback, suv, van, pickup};
constexpr double kBesideSeam = 0.03;  // m: rays along the seam of both halves pass it

/// One car about the origin, with the materials that it was drawn in.
struct Car : Sketch {
  Car(VehicleKind kind, std::uint64_t seed) : Sketch(seed), shape(random_shape(kind, rng)) {
    paint = world.add({kCar, 0.3F, 0, 0.5F, 0, 0});
    glass = world.add({kCar, 0.05F, 0, 0.99F, 0.2F, 0});
    draw_vehicle(shape, palette, paint, glass, pen());
  }

  [[nodiscard]] double front() const { return shape.length / 2; }
  [[nodiscard]] Eigen::AlignedBox3d box(MaterialId material) const {
    return box_of(mesh(), [&](MaterialId m) { return m == material; });
  }

  VehicleShape shape;
  MaterialId paint = 0, glass = 0;
};

/// `check` on a few cars of each kind.
template <class Check>
void for_each_car(Check check) {
  for (const VehicleKind kind : kCars) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      SCOPED_TRACE(name_of(kind) + " " + std::to_string(seed));
      check(Car(kind, seed));
    }
  }
}

TEST(DrawVehicle, TheLeftSideIsTheRightOnesMirrorImage) {
  for_each_car([](const Car& car) { EXPECT_TRUE(is_mirrored(car.mesh())); });
}

TEST(DrawVehicle, EveryTriangleIsACar) {
  for_each_car(
      [](const Car& car) { EXPECT_EQ(labels_of(car.world, car.mesh()), std::set<int>{kCar}); });
}

TEST(DrawVehicle, NoVertexIsBelowTheGround) {
  for_each_car([](const Car& car) { EXPECT_GT(box_of(car.mesh()).min().z(), -0.01); });
}

TEST(DrawVehicle, TheRoofIsAtItsHeight) {
  for_each_car([](const Car& car) {
    const RayCaster caster(car.world);
    const double door =
        car.shape.roof_front + 0.42 * (car.shape.roof_rear - car.shape.roof_front) + 0.05;
    const Shot down = shoot(caster, {car.front() - door, kBesideSeam, 5}, {0, 0, -1});
    EXPECT_NEAR(place_of(down).z(), car.shape.height, 0.01);
    EXPECT_EQ(down.material, car.paint);
  });
}

TEST(DrawVehicle, ABeamFromAheadMeetsTheWindscreenAboveTheBelt) {
  for_each_car([](const Car& car) {
    const RayCaster caster(car.world);
    const double z = 0.5 * (car.shape.belt + car.shape.height - 0.1);
    const Shot shot = shoot(caster, {10, kBesideSeam, z}, {-1, 0, 0});
    ASSERT_TRUE(shot.hit);
    EXPECT_EQ(shot.material, car.glass);
    EXPECT_LT(place_of(shot).x(), car.front() - car.shape.screen_base + 0.02);
    EXPECT_GT(place_of(shot).x(), car.front() - car.shape.roof_front - 0.06);
  });
}

TEST(DrawVehicle, TheFrontDoorHasAWindowAndPaintBelowIt) {
  for_each_car([](const Car& car) {
    const RayCaster caster(car.world);
    const double x = car.front() - car.shape.roof_front - 0.25;
    const double in_window = car.shape.belt + 0.3 * (car.shape.height - car.shape.belt);
    EXPECT_EQ(shoot(caster, {x, 8, in_window}, {0, -1, 0}).material, car.glass);
    EXPECT_EQ(shoot(caster, {x, 8, car.shape.belt - 0.25}, {0, -1, 0}).material, car.paint);
  });
}

TEST(DrawVehicle, APanelVanHasNoWindowBehindItsFrontDoor) {
  int panel_vans = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Car car(van, seed);
    const RayCaster caster(car.world);
    const double back = 0.5 * (car.shape.roof_front + car.shape.roof_rear) + 0.6;
    const double z = car.shape.belt + 0.3 * (car.shape.height - car.shape.belt);
    const Shot shot = shoot(caster, {car.front() - back, 8, z}, {0, -1, 0});
    EXPECT_EQ(shot.material, car.shape.panel_sides ? car.paint : car.glass) << seed;
    panel_vans += car.shape.panel_sides;
  }
  EXPECT_GT(panel_vans, 3);
}

/// Between sill and belt. A chink is left between the edge of an arch and its liner.
TEST(DrawVehicle, HardlyAnyBeamPassesThroughTheBodyBelowTheBelt) {
  for_each_car([](const Car& car) {
    const RayCaster caster(car.world);
    const double z = 0.5 * (car.shape.clearance + 0.1 + car.shape.bonnet) + 0.05;
    int passed = 0;
    for (double x = -car.front() + 0.1; x < car.front() - 0.1; x += 0.05) {
      const Shot left = shoot(caster, {x, 8, z}, {0, -1, 0});
      passed += !left.hit || place_of(left).y() < 0.3 * car.shape.width;
    }
    EXPECT_LE(passed, 1);
  });
}

TEST(DrawVehicle, TheBodyIsWidestInItsMiddleAndNarrowerAtItsEnds) {
  for_each_car([](const Car& car) {
    const RayCaster caster(car.world);
    const double z = 0.55 * car.shape.belt;
    const auto half_width = [&](double x) {
      return place_of(shoot(caster, {x, 8, z}, {0, -1, 0})).y();
    };
    const double nose = half_width(car.front() - 0.05);
    EXPECT_LT(nose, 0.5 * car.shape.width * (1 - 0.5 * car.shape.roundness));
    EXPECT_NEAR(half_width(0.1), car.shape.width / 2, 0.03);
  });
}

TEST(DrawVehicle, FourWheelsStandAtTheirAxles) {
  for_each_car([](const Car& car) {
    std::map<std::pair<bool, bool>, Eigen::AlignedBox3d> wheels;  // at the front, on the left
    for (std::size_t i = 0; i < car.mesh().triangles.size(); ++i) {
      if (car.mesh().materials[i] != car.palette.rubber) continue;
      for (const std::uint32_t v : car.mesh().triangles[i]) {
        const Eigen::Vector3d p = car.mesh().vertices[v].cast<double>();
        wheels[{p.x() > 0, p.y() > 0}].extend(p);
      }
    }
    ASSERT_EQ(wheels.size(), 4U);
    for (const auto& [where, wheel] : wheels) {
      const double axle =
          where.first ? car.front() - car.shape.front_axle : -car.front() + car.shape.rear_axle;
      EXPECT_NEAR(wheel.center().x(), axle, 0.01);
      EXPECT_NEAR(wheel.min().z(), 0, 0.01);
      EXPECT_NEAR(wheel.max().z(), 2 * car.shape.wheel_radius, 0.01);
    }
  });
}

TEST(DrawVehicle, WheelsDoNotStandOutOfTheBody) {
  for_each_car([](const Car& car) {
    EXPECT_LE(car.box(car.palette.rubber).max().y(), car.shape.width / 2);
    EXPECT_LE(car.box(car.palette.rim).max().y(), car.shape.width / 2);
  });
}

TEST(DrawVehicle, APlateIsAtEitherEnd) {
  for_each_car([](const Car& car) {
    const Eigen::AlignedBox3d plates = car.box(car.palette.plate);
    EXPECT_NEAR(plates.max().x(), car.front(), 0.01);
    EXPECT_NEAR(plates.min().x(), -car.front(), 0.01);
    EXPECT_NEAR(plates.sizes().y(), 0.52, 1e-5);
  });
}

TEST(DrawVehicle, SeatsAreInsideTheCabin) {
  for_each_car([](const Car& car) {
    const Eigen::AlignedBox3d seats = car.box(car.palette.interior);
    EXPECT_LT(seats.max().z(), car.shape.height - 0.1);
    EXPECT_GT(seats.min().z(), car.shape.clearance);
    EXPECT_LT(seats.max().x(), car.front() - car.shape.screen_base + 0.1);
    EXPECT_LT(seats.max().y(), car.shape.width / 2);
  });
}

TEST(DrawVehicle, ThroughTheGlassOneSeesTheSeatsAndTheFarSide) {
  for_each_car([](const Car& car) {
    const RayCaster caster(car.world);
    const double x = car.front() - car.shape.roof_front - 0.25;
    const double z = car.shape.belt + 0.3 * (car.shape.height - car.shape.belt);
    const std::vector<Shot> surfaces = surfaces_along(caster, {x, 8, z}, {0, -1, 0});
    ASSERT_GE(surfaces.size(), 2U);
    EXPECT_EQ(surfaces.front().material, car.glass);
    EXPECT_EQ(surfaces.back().material, car.glass);
    EXPECT_NEAR(place_of(surfaces.front()).y(), -place_of(surfaces.back()).y(), 1e-3);
  });
}

TEST(DrawVehicle, ASedanHasABootAndAHatchbackHasNone) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Car with(sedan, seed), without(hatchback, seed);
    const auto height_at_rear = [](const Car& car) {
      const RayCaster caster(car.world);
      return place_of(shoot(caster, {-car.front() + 0.35, kBesideSeam, 5}, {0, 0, -1})).z();
    };
    EXPECT_LT(height_at_rear(with), with.shape.tail + 0.1) << seed;
    EXPECT_GT(height_at_rear(without), without.shape.tail + 0.1) << seed;
  }
}

TEST(DrawVehicle, TheUndersideIsClosedAtItsClearance) {
  for_each_car([](const Car& car) {
    const RayCaster caster(car.world);
    for (double x = -1; x <= 1; x += 0.25) {
      const Shot up = shoot(caster, {x, 0.1, -1}, {0, 0, 1});
      ASSERT_TRUE(up.hit);
      EXPECT_NEAR(place_of(up).z(), car.shape.clearance, 1e-3);
    }
  });
}

}  // namespace
}  // namespace saker::simulation
