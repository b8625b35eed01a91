#include <gtest/gtest.h>

#include "made_fleet.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

constexpr FleetKind kBuses[] = {city_bus, articulated_bus, coach, school_bus, minibus};

/// Share of glass of what beams from a side meet at a height, over the middle of the bus.
double glass_share(const Member& m, double z, double side) {
  const RayCaster& caster = *m.caster;
  int glass = 0, all = 0;
  for (double x = -0.35 * m.shape.length; x < 0.2 * m.shape.length; x += 0.04) {
    const Shot shot = shoot(caster, {x, side * 8, z}, {0, -side, 0});
    if (!shot.hit) continue;
    ++all;
    glass += m.is_glass(shot);
  }
  return static_cast<double>(glass) / all;
}

/// A height within the side windows.
double window_height(const Member& m) {
  switch (m.shape.kind) {
    case coach:
      return 2.4;
    case school_bus:
      return 2.0;
    default:
      return 1.6;
  }
}

TEST(Bus, MostOfItsSideIsGlassAtTheWindows) {
  for_each_member(kBuses, [](const Member& m) {
    for (const double side : {-1.0, 1.0}) EXPECT_GT(glass_share(m, window_height(m), side), 0.6);
  });
}

TEST(Bus, OnItsLeftThereIsNoGlassBelowTheWindows) {
  for_each_member(kBuses, [](const Member& m) { EXPECT_EQ(glass_share(m, 0.9, 1), 0); });
}

TEST(Bus, ItsRoofIsClosed) {
  for_each_member(kBuses, [](const Member& m) {
    for (double x = -m.front() + 0.4; x < m.front() - 3.6; x += 0.3) {
      if (m.shape.kind == articulated_bus && x < m.front() - 9.2 && x > m.front() - 12.2) continue;
      EXPECT_GT(m.top_at(x, 0.4), 2.2) << x;
    }
  });
}

TEST(Bus, TheDriverLooksAheadThroughGlass) {
  for_each_member(kBuses, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    bool glass = false;
    for (double z = 1.25; z < 2.6; z += 0.05)
      glass |= m.is_glass(shoot(caster, {20, 0.3, z}, {-1, 0, 0}));
    EXPECT_TRUE(glass);
  });
}

TEST(Bus, SeatsAreSeenThroughItsWindows) {
  for_each_member(kBuses, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    double most = 0;
    for (double x = -3; x < 1; x += 0.1) {
      const auto met = surfaces_along(caster, {x, 8, window_height(m) - 0.2}, {0, -1, 0});
      most = std::max(most, static_cast<double>(met.size()));
    }
    EXPECT_GE(most, 4) << "two panes and a seat between them";
  });
}

TEST(Bus, ItsWheelsAreOfOneSize) {
  for_each_member(kBuses, [](const Member& m) {
    const double radius = m.shape.kind == minibus ? 0.36 : 0.48;
    int tyres = 0;
    for (const Eigen::Vector3f& p : m.mesh().vertices)
      tyres += std::abs(p.z() - static_cast<float>(2 * radius)) < 0.02F &&
               std::abs(p.y()) > static_cast<float>(m.shape.width / 2 - 0.3);
    EXPECT_GT(tyres, 8);
  });
}

TEST(ArticulatedBus, HasBellowsBetweenItsRooms) {
  for_each_member(std::array{articulated_bus}, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    int narrow = 0;
    for (double x = m.front() - 12; x < m.front() - 9.4; x += 0.02) {
      const Shot shot = shoot(caster, {x, 8, 0.6}, {0, -1, 0});
      narrow += shot.hit && std::abs(place_of(shot).y() - (m.shape.width / 2 - 0.05)) < 0.002;
    }
    EXPECT_GT(narrow, 15);
  });
}

TEST(Coach, ItsFloorIsHighAboveItsHold) {
  for_each_member(std::array{coach}, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    const Shot up = shoot(caster, {0.3, 0.05, 1.0}, {0, 0, 1});
    EXPECT_NEAR(place_of(up).z(), 1.35, 0.01);
  });
}

TEST(SchoolBus, HasABonnet) {
  for_each_member(std::array{school_bus}, [](const Member& m) {
    EXPECT_LT(m.top_at(m.front() - 0.5), 1.65);
    EXPECT_NEAR(m.top_at(0), m.shape.height, 0.01);
  });
}

TEST(Minibus, IsLowerThanACoach) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    EXPECT_LT(Member(minibus, seed).top_at(0), Member(coach, seed).top_at(0));
}

}  // namespace
}  // namespace saker::simulation
