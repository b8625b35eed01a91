#include "saker/simulation/world/fleet.h"

#include <gtest/gtest.h>

#include <set>

#include "drawn.h"

namespace saker::simulation {
namespace {

struct Drawn {
  World world;
  FleetShape shape;
};

Drawn draw(FleetKind kind, std::uint64_t seed) {
  Drawn d;
  core::Rng rng(seed);
  const Palette palette = make_palette(d.world, rng);
  d.shape = random_shape(kind, rng);
  add_fleet_vehicle(d.world, palette, d.shape, SE3::Identity(), false, rng);
  return d;
}

/// What every kind's drawings have in common, `check` on each of eight.
template <class Check>
void for_each_member(Check check) {
  for (const FleetEntry& entry : fleet_table()) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      SCOPED_TRACE(std::string(entry.name) + " " + std::to_string(seed));
      check(entry, draw(entry.kind, seed));
    }
  }
}

TEST(Fleet, TheTableIsInTheOrderOfItsKinds) {
  for (std::size_t i = 0; i < fleet_table().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(fleet_table()[i].kind), i) << fleet_table()[i].name;
  }
}

TEST(Fleet, LengthsAreWithinThosePublished) {
  for_each_member([](const FleetEntry& entry, const Drawn& d) {
    const double length = box_of(d.world.mesh).sizes().x();
    EXPECT_GT(length, entry.length.low - 0.1);
    EXPECT_LT(length, entry.length.high + 0.1);
    EXPECT_NEAR(length, d.shape.length, 0.15);
  });
}

TEST(Fleet, WidthsAreWithinThosePublishedAndMirrors) {
  for_each_member([](const FleetEntry& entry, const Drawn& d) {
    const double width = box_of(d.world.mesh).sizes().y();
    EXPECT_GT(width, entry.width.low - 0.1);
    EXPECT_LT(width, entry.width.high + 0.55);
  });
}

TEST(Fleet, HeightsAreWithinThosePublished) {
  for_each_member([](const FleetEntry& entry, const Drawn& d) {
    const double height = box_of(d.world.mesh).max().z();
    EXPECT_GT(height, 0.75 * entry.height.low);  // of a trailer without a box
    EXPECT_LT(height, entry.height.high + 0.05);
  });
}

TEST(Fleet, EverythingStandsOnTheGround) {
  for_each_member([](const FleetEntry&, const Drawn& d) {
    EXPECT_NEAR(box_of(d.world.mesh).min().z(), 0, 0.03);
  });
}

TEST(Fleet, EveryPartHasTheLabelOfItsKind) {
  for_each_member([](const FleetEntry& entry, const Drawn& d) {
    for (const MaterialId m : d.world.mesh.materials) {
      ASSERT_EQ(d.world.materials[m].label, entry.label);
    }
  });
}

TEST(Fleet, TheTruthIsTheOutline) {
  for_each_member([](const FleetEntry& entry, const Drawn& d) {
    const TrueObject& object = d.world.objects.at(0);
    const auto& cuboid = std::get<objects::Cuboid>(object.model);
    EXPECT_EQ(object.kind, entry.name);
    EXPECT_DOUBLE_EQ(cuboid.size.x(), d.shape.length);
    EXPECT_DOUBLE_EQ(cuboid.pose.translation().z(), d.shape.height / 2);
  });
}

/// How far along the vehicle beams across it at height z meet nothing, at most, m.
double widest_gap(const Drawn& d, double z) {
  constexpr double kStep = 0.02;
  const RayCaster caster(d.world);
  std::vector<Shot> shots;
  for (double x = -d.shape.length / 2 + 0.3; x < d.shape.length / 2 - 0.3; x += kStep) {
    Shot shot;
    shot.origin = Eigen::Vector3d(x, -10, z).cast<float>();
    shot.direction = Eigen::Vector3f::UnitY();
    shots.push_back(shot);
  }
  caster.cast(shots, 20);
  double widest = 0, gap = 0;
  for (const Shot& shot : shots) {
    gap = shot.hit ? 0 : gap + kStep;
    widest = std::max(widest, gap);
  }
  return widest;
}

TEST(Fleet, ATrucksBoxIsApartFromItsCab) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EXPECT_GT(widest_gap(draw(FleetKind::box_truck, seed), 1.6), 0.1) << seed;
    EXPECT_GT(widest_gap(draw(FleetKind::semi_trailer, seed), 1.6), 0.4) << seed;
  }
}

TEST(Fleet, AVansCargoRoomIsNotApart) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EXPECT_LT(widest_gap(draw(FleetKind::large_van, seed), 0.8), 0.1) << seed;
  }
}

TEST(Fleet, OneSeesThroughUnderATruck) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    EXPECT_GT(widest_gap(draw(FleetKind::box_truck, seed), 0.3), 1.0) << seed;
  }
}

TEST(Fleet, ABussWindowsLetBeamsThrough) {
  const Drawn d = draw(FleetKind::city_bus, 3);
  const RayCaster caster(d.world);
  std::vector<Shot> shots;
  for (double x = -3; x < 3; x += 0.05) {
    Shot shot;
    shot.origin = Eigen::Vector3d(x, 8, 1.7).cast<float>();
    shot.direction = -Eigen::Vector3f::UnitY();
    shots.push_back(shot);
  }
  caster.cast(shots, 20);
  int glass = 0;
  for (const Shot& shot : shots) {
    ASSERT_TRUE(shot.hit);
    if (d.world.materials[shot.material].transmission > 0) ++glass;
  }
  EXPECT_GT(glass, 80) << "of " << shots.size();
}

TEST(Fleet, EveryThemeHasCarsTrucksAndBuses) {
  for (int theme = 1; theme <= kFleetThemes; ++theme) {
    core::Rng rng(5);
    std::set<std::uint16_t> labels;
    for (int i = 0; i < 2000; ++i) {
      labels.insert(entry_of(random_kind(static_cast<FleetTheme>(theme), rng)).label);
    }
    EXPECT_EQ(labels, (std::set<std::uint16_t>{kCar, kBus, kTruck, kOtherVehicle, kVan})) << theme;
  }
}

}  // namespace
}  // namespace saker::simulation
