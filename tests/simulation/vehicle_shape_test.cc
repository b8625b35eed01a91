#include <gtest/gtest.h>

#include <set>

#include "saker/simulation/world/vehicle.h"

namespace saker::simulation {
namespace {

using enum VehicleKind;

constexpr VehicleKind kKinds[] = {sedan, hatchback, suv, van, pickup, truck, bus, trailer};
constexpr VehicleKind kCars[] = {sedan, hatchback, suv, van, pickup};

/// `check` on 200 shapes of each kind of car.
template <class Check>
void for_each_car(Check check) {
  for (const VehicleKind kind : kCars) {
    core::Rng rng(11);
    for (int i = 0; i < 200; ++i) {
      SCOPED_TRACE(name_of(kind) + " " + std::to_string(i));
      check(random_shape(kind, rng));
    }
  }
}

TEST(VehicleShape, EveryKindHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const VehicleKind kind : kKinds) names.insert(name_of(kind));
  EXPECT_EQ(names.size(), std::size(kKinds));
}

TEST(VehicleShape, IsOfTheKindThatWasAskedFor) {
  core::Rng rng(1);
  for (const VehicleKind kind : kKinds) EXPECT_EQ(random_shape(kind, rng).kind, kind);
}

TEST(VehicleShape, TheSameSeedGivesTheSameAndAnotherAnother) {
  core::Rng a(4), b(4), c(5);
  const double length = random_shape(suv, a).length;
  EXPECT_EQ(random_shape(suv, b).length, length);
  EXPECT_NE(random_shape(suv, c).length, length);
}

TEST(VehicleShape, ScreenRoofAndBootFollowEachOtherFromTheFrontEndBackwards) {
  for_each_car([](const VehicleShape& s) {
    EXPECT_GT(s.screen_base, 0.35);
    EXPECT_GT(s.roof_front, s.screen_base + 0.2);
    EXPECT_GT(s.roof_rear, s.roof_front + 0.3);
    EXPECT_GT(s.rear_base, s.roof_rear);
    EXPECT_LE(s.rear_base, s.length);
  });
}

TEST(VehicleShape, BonnetBeltAndRoofAreAboveEachOther) {
  for_each_car([](const VehicleShape& s) {
    EXPECT_GT(s.bonnet, s.clearance + 0.2);
    EXPECT_GE(s.belt, s.bonnet - 1e-9);
    EXPECT_GT(s.height, s.belt + 0.35);
    EXPECT_GT(s.height, s.tail);
  });
}

TEST(VehicleShape, BothAxlesAreUnderTheBody) {
  for_each_car([](const VehicleShape& s) {
    EXPECT_GT(s.front_axle, s.wheel_radius);
    EXPECT_GT(s.rear_axle, s.wheel_radius);
    const double wheelbase = s.length - s.front_axle - s.rear_axle;
    EXPECT_GT(wheelbase, 1.9);
    EXPECT_LT(wheelbase, 3.8);
  });
}

TEST(VehicleShape, WheelsAreOfASizeThatIsSold) {
  for_each_car([](const VehicleShape& s) {
    EXPECT_GE(s.wheel_radius, 0.29);
    EXPECT_LE(s.wheel_radius, 0.39);
  });
}

TEST(VehicleShape, OnlyAPickupHasAnOpenBed) {
  for_each_car([](const VehicleShape& s) { EXPECT_EQ(s.open_bed, s.kind == pickup); });
}

TEST(VehicleShape, OnlyVansHavePanelSidesAndHalfOfThem) {
  int panels = 0;
  for_each_car([&](const VehicleShape& s) {
    panels += s.panel_sides;
    EXPECT_TRUE(!s.panel_sides || s.kind == van);
  });
  EXPECT_NEAR(panels, 100, 25);
}

TEST(VehicleShape, AQuarterOfTheHatchbacksAreEstates) {
  core::Rng rng(6);
  int estates = 0;
  for (int i = 0; i < 2000; ++i) estates += random_shape(hatchback, rng).roof_rear > 3.85;
  EXPECT_GT(estates, 200);
  EXPECT_LT(estates, 700);
}

TEST(VehicleShape, VansAreHigherThanPickupsAndThoseThanSedans) {
  core::Rng rng(2);
  double van_m = 0, pickup_m = 0, sedan_m = 0;
  for (int i = 0; i < 300; ++i) {
    van_m += random_shape(van, rng).height / 300;
    pickup_m += random_shape(pickup, rng).height / 300;
    sedan_m += random_shape(sedan, rng).height / 300;
  }
  EXPECT_NEAR(van_m, 1.93, 0.02);
  EXPECT_NEAR(pickup_m, 1.79, 0.02);
  EXPECT_NEAR(sedan_m, 1.45, 0.02);
}

TEST(VehicleShape, ABusIsLongerThanATruckAndNarrowEnoughForALane) {
  core::Rng rng(3);
  for (int i = 0; i < 100; ++i) {
    const VehicleShape b = random_shape(bus, rng), t = random_shape(truck, rng);
    EXPECT_GE(b.length, 9);
    EXPECT_LE(t.length, 9.5);
    EXPECT_LE(b.width, 2.55);
    EXPECT_LE(t.width, 2.55);
  }
}

TEST(VehicleShape, ATrailersAxleIsUnderItsMiddle) {
  core::Rng rng(9);
  for (int i = 0; i < 50; ++i) {
    const VehicleShape s = random_shape(trailer, rng);
    EXPECT_DOUBLE_EQ(s.rear_axle, s.length / 2);
  }
}

}  // namespace
}  // namespace saker::simulation
