#include <gtest/gtest.h>

#include "made_fleet.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

constexpr FleetKind kMachines[] = {excavator, wheel_loader, roller, forklift};

TEST(Machine, HasWhereItsDriverSits) {
  for_each_member(
      kMachines,
      [](const Member& m) {
        double highest = 0;
        for (double x = -m.front() + 0.2; x < m.front() - 0.2; x += 0.1) {
          for (double y = -0.4 * m.shape.width; y < 0.45 * m.shape.width; y += 0.2)
            if (const double top = m.top_at(x, y); top > highest) highest = top;
        }
        EXPECT_GT(highest, 0.8 * m.shape.height);
      },
      2);
}

TEST(Machine, FillsItsLength) {
  for_each_member(kMachines, [](const Member& m) {
    EXPECT_NEAR(box_of(m.mesh()).min().x(), -m.front(), 0.2);
    EXPECT_NEAR(box_of(m.mesh()).max().x(), m.front(), 0.2);
  });
}

TEST(Machine, IsOtherVehicle) {
  for_each_member(kMachines, [](const Member& m) {
    EXPECT_EQ(labels_of(m.world, m.mesh()), std::set<int>{kOtherVehicle});
  });
}

TEST(Excavator, ItsArmReachesAheadAndDown) {
  for_each_member(std::array{excavator}, [](const Member& m) {
    double ahead = 1e9;
    for (const Eigen::Vector3f& p : m.mesh().vertices) {
      if (p.x() > static_cast<float>(m.front() - 0.5)) ahead = std::min<double>(ahead, p.z());
    }
    EXPECT_LT(ahead, 0.3) << "the bucket lies near the ground";
  });
}

TEST(Excavator, BeamsPassUnderItsArm) {
  for_each_member(std::array{excavator}, [](const Member& m) {
    const double size = m.shape.width / 3;
    const double from = -m.front() + 5.2 * size, to = m.front() - 1.4 * size;
    if (to - from < 0.3) return;
    EXPECT_LT(m.covered(0.3 * size, from, to), 0.2);
  });
}

TEST(WheelLoader, ItsShovelIsAsWideAsItself) {
  for_each_member(std::array{wheel_loader}, [](const Member& m) {
    double left = 0;
    for (const Eigen::Vector3f& p : m.mesh().vertices) {
      if (p.x() > static_cast<float>(m.front() - 0.3)) left = std::max<double>(left, p.y());
    }
    EXPECT_NEAR(left, m.shape.width / 2, 0.01);
  });
}

TEST(Roller, ItsDrumRollsOnTheGroundAtItsFront) {
  for_each_member(std::array{roller}, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    EXPECT_NEAR(m.top_at(m.front() - 0.75), 1.5, 0.02);
    const Shot up = shoot(caster, {m.front() - 0.75, 0, -1}, {0, 0, 1});
    EXPECT_NEAR(place_of(up).z(), 0, 0.02);
  });
}

TEST(Forklift, ItsForksAreLowAndBeforeItsMast) {
  for_each_member(std::array{forklift}, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    const Shot up = shoot(caster, {m.front() - 0.2, 0.25, -1}, {0, 0, 1});
    ASSERT_TRUE(up.hit);
    EXPECT_NEAR(place_of(up).z(), 0.12, 1e-3);
    EXPECT_FALSE(shoot(caster, {m.front() - 0.2, 0.5, -1}, {0, 0, 1}, 1.15F).hit);
  });
}

TEST(Trailer, IsPulledByABarAtItsFront) {
  for_each_member(std::array{FleetKind::trailer, caravan}, [](const Member& m) {
    double width = 0;
    for (const Eigen::Vector3f& p : m.mesh().vertices) {
      if (p.x() > static_cast<float>(m.front() - 0.3))
        width = std::max<double>(width, std::abs(p.y()));
    }
    EXPECT_LT(width, 0.45 * m.shape.width);
  });
}

TEST(Trailer, LowOnesAreOpenAndHighOnesClosed) {
  int open = 0, closed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Member m(FleetKind::trailer, seed);
    const double top = m.top_at(-m.front() + 0.1);
    const double back = -0.14 * m.shape.length - 0.25 * m.shape.length;
    if (m.shape.height > 1.4) {
      EXPECT_NEAR(top, m.shape.height, 1e-3) << seed;
      ++closed;
    } else {
      EXPECT_LT(m.top_at(back), m.shape.height + 1e-3) << seed;
      ++open;
    }
  }
  EXPECT_GT(open, 8);
  EXPECT_GT(closed, 8);
}

TEST(Caravan, HasWindowsOnBothSidesAndARoof) {
  for_each_member(std::array{caravan}, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    for (const double side : {-1.0, 1.0}) {
      const Shot shot = shoot(caster, {-m.front() + 1, side * 8, 1.5}, {0, -side, 0});
      EXPECT_TRUE(m.is_glass(shot));
    }
    EXPECT_NEAR(m.top_at(-m.front() + 2), m.shape.height, 0.01);
  });
}

}  // namespace
}  // namespace saker::simulation
