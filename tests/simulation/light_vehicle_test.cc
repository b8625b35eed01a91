#include <gtest/gtest.h>

#include "made_fleet.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

constexpr FleetKind kLight[] = {city_car,        hatchback, estate,    sedan,    coupe,
                                compact_suv,     suv,       large_suv, mpv,      pickup_midsize,
                                pickup_fullsize, small_van, van,       large_van};

TEST(LightVehicle, FillsItsLengthAndHeight) {
  for_each_member(kLight, [](const Member& m) {
    const Eigen::AlignedBox3d box = box_of(m.mesh());
    EXPECT_NEAR(box.sizes().x(), m.shape.length, 0.02);
    EXPECT_NEAR(box.max().z(), m.shape.height, 0.03);
    EXPECT_NEAR(box.sizes().y(), m.shape.width + 0.3, 0.02);  // with mirrors
  });
}

TEST(LightVehicle, ItsBonnetIsLowerThanItsRoof) {
  for_each_member(kLight, [](const Member& m) {
    EXPECT_LT(m.top_at(m.front() - 0.25), 0.75 * m.shape.height);
    EXPECT_GT(m.top_at(m.front() - 0.5 * m.shape.length), 0.93 * m.shape.height);
  });
}

TEST(LightVehicle, OfCarsOnlySedansAndCoupesHaveABoot) {
  for_each_member(kLight, [](const Member& m) {
    if (m.shape.kind == pickup_midsize || m.shape.kind == pickup_fullsize) return;
    const bool boot = m.shape.kind == sedan;
    const double rear = m.top_at(-m.front() + 0.45) / m.shape.height;
    if (boot) {
      EXPECT_LT(rear, 0.8);
    } else if (m.shape.kind != coupe) {
      EXPECT_GT(rear, 0.83);
    }
  });
}

TEST(LightVehicle, AVanIsHighUpToItsRear) {
  for_each_member(std::array{van, large_van}, [](const Member& m) {
    EXPECT_GT(m.top_at(-m.front() + 0.4), 0.93 * m.shape.height);
  });
}

TEST(LightVehicle, MostLargeVansHaveNoWindowsBehindTheFrontDoors) {
  int panels = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Member m(large_van, seed);
    const RayCaster& caster = *m.caster;
    const double z = 0.7 * std::min(m.shape.height, 2.35);
    panels += !m.is_glass(shoot(caster, {-0.25 * m.shape.length, 8, z}, {0, -1, 0}));
  }
  EXPECT_GT(panels, 25);
}

/// Heights along the middle of a bed.
double highest_over_bed(const Member& m) {
  double highest = 0;
  for (double x = -m.front() + 0.2; x < -m.front() + 1.3; x += 0.1) {
    for (double y = -0.6; y <= 0.6; y += 0.2) highest = std::max(highest, m.top_at(x, y));
  }
  return highest;
}

TEST(Pickup, ABedIsOpenLoadedOrCovered) {
  int open = 0, covered = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Member m(pickup_fullsize, seed);
    const double highest = highest_over_bed(m);
    EXPECT_LT(highest, m.shape.height + 0.01) << seed;
    open += highest < 0.6 * m.shape.height;
    covered += highest > 0.66 * m.shape.height;
  }
  EXPECT_GT(open, 5);
  EXPECT_GT(covered, 12);
}

TEST(Pickup, ItsCabinEndsBeforeItsBed) {
  for_each_member(std::array{pickup_midsize, pickup_fullsize}, [](const Member& m) {
    EXPECT_GT(m.top_at(0.02 * m.shape.length), 0.9 * m.shape.height);
  });
}

TEST(LightVehicle, TheSameSeedDrawsTheSame) {
  for (const FleetKind kind : kLight) {
    EXPECT_EQ(Member(kind, 4).mesh().vertices, Member(kind, 4).mesh().vertices);
    EXPECT_NE(Member(kind, 4).mesh().vertices, Member(kind, 5).mesh().vertices);
  }
}

TEST(RandomShape, LongOnesAreWideAndHigh) {
  for (const FleetKind kind : kLight) {
    core::Rng rng(3);
    Spread length, width;
    double products = 0;
    std::vector<FleetShape> shapes;
    for (int i = 0; i < 800; ++i) {
      shapes.push_back(random_shape(kind, rng));
      length.add(shapes.back().length);
      width.add(shapes.back().width);
    }
    for (const FleetShape& s : shapes)
      products += (s.length - length.mean()) * (s.width - width.mean()) / 800;
    EXPECT_NEAR(products / (length.sd() * width.sd()), 0.5, 0.1);
  }
}

TEST(RandomKind, EachThemeDrawsItsShares) {
  for (int theme = 1; theme <= kFleetThemes; ++theme) {
    core::Rng rng(8);
    std::map<FleetKind, double> drawn;
    for (int i = 0; i < 20000; ++i)
      drawn[random_kind(static_cast<FleetTheme>(theme), rng)] += 1 / 20000.0;
    double total = 0;
    const auto column = static_cast<std::size_t>(theme - 1);
    for (const FleetEntry& entry : fleet_table()) total += entry.share[column];
    for (const FleetEntry& entry : fleet_table())
      EXPECT_NEAR(drawn[entry.kind], entry.share[column] / total, 0.012) << entry.name;
  }
}

}  // namespace
}  // namespace saker::simulation
