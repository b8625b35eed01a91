#include "saker/simulation/world/fences.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/world/buildings.h"

namespace saker::simulation {
namespace {

constexpr double kLength = 2.5, kHeight = 1.5;

Sketch bounded(Boundary kind, double length = kLength, double height = kHeight) {
  Sketch s;
  add_boundary(s.world, s.street, kind, SE3::Identity(), length, height);
  return s;
}

template <class Check>
void for_each_boundary(Check check) {
  for (int i = 0; i < kBoundaries; ++i) {
    SCOPED_TRACE(i);
    const auto kind = static_cast<Boundary>(i);
    check(kind, bounded(kind));
  }
}

/// Share of the beams across the boundary that meet it below its height.
double opacity(const World& world, double height) {
  const RayCaster caster(world);
  int met = 0, all = 0;
  for (double x = 0.11; x < kLength - 0.1; x += 0.037) {
    for (double z = 0.2; z < height - 0.05; z += 0.041) {
      ++all;
      met += shoot(caster, {x, 4, z}, {0, -1, 0}).hit;
    }
  }
  return static_cast<double>(met) / all;
}

TEST(Boundary, RunsAlongXForItsLength) {
  for_each_boundary([](Boundary, const Sketch& s) {
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_GT(box.min().x(), -0.15);
    EXPECT_LT(box.min().x(), 0.2);
    EXPECT_GT(box.max().x(), 1.75);
    EXPECT_LT(box.max().x(), kLength + 0.15);
  });
}

TEST(Boundary, IsNarrow) {
  for_each_boundary(
      [](Boundary, const Sketch& s) { EXPECT_LT(box_of(s.mesh()).sizes().y(), 0.75); });
}

TEST(Boundary, IsAtLeastKneeHighAndAtMostHigherThanAPerson) {
  for_each_boundary([](Boundary, const Sketch& s) {
    EXPECT_GT(box_of(s.mesh()).max().z(), 0.6);
    EXPECT_LT(box_of(s.mesh()).max().z(), 2.1);
  });
}

TEST(Boundary, WallsAndBoardsLetNoBeamThrough) {
  for (const Boundary kind : {Boundary::panels, Boundary::stone_wall, Boundary::hoarding})
    EXPECT_EQ(opacity(bounded(kind).world, kHeight), 1);
  EXPECT_EQ(opacity(bounded(Boundary::jersey).world, 1.1), 1);
}

TEST(Boundary, BarsLetMostBeamsThrough) {
  for (const Boundary kind : {Boundary::iron_railing, Boundary::bars, Boundary::guard_rail}) {
    const double share = opacity(bounded(kind).world, kHeight);
    EXPECT_GT(share, 0.02) << static_cast<int>(kind);
    EXPECT_LT(share, 0.5) << static_cast<int>(kind);
  }
}

TEST(Boundary, SlatsAndPicketsAreHalfOpen) {
  for (const Boundary kind : {Boundary::slats, Boundary::picket}) {
    const double share = opacity(bounded(kind, kLength, 1.2).world, 1.2);
    EXPECT_GT(share, 0.4) << static_cast<int>(kind);
    EXPECT_LT(share, 0.95) << static_cast<int>(kind);
  }
}

TEST(Boundary, ThroughWireBeamsPassByTheirMaterial) {
  for (const Boundary kind : {Boundary::chain_link, Boundary::site_fence}) {
    const Sketch s = bounded(kind);
    const RayCaster caster(s.world);
    const Shot shot = shoot(caster, {1.23, 4, 0.8}, {0, -1, 0});
    ASSERT_TRUE(shot.hit);
    EXPECT_GE(s.world.materials[shot.material].transmission, 0.5F);
  }
}

TEST(Boundary, AWallWithARailingIsSolidBelowAndOpenAbove) {
  const Sketch s = bounded(Boundary::wall_with_railing, kLength, 2);
  const RayCaster caster(s.world);
  int all = 0, low = 0, high = 0;
  for (double x = 0.05; x < 2.4; x += 0.01) {
    ++all;
    low += shoot(caster, {x, 4, 0.4}, {0, -1, 0}).hit;
    high += shoot(caster, {x, 4, 1.4}, {0, -1, 0}).hit;
  }
  EXPECT_EQ(low, all);
  EXPECT_LT(high, 0.35 * all);
}

TEST(Boundary, AJerseyBarrierIsWiderAtItsFoot) {
  const Sketch s = bounded(Boundary::jersey);
  const RayCaster caster(s.world);
  const double foot = place_of(shoot(caster, {1, 4, 0.02}, {0, -1, 0})).y();
  const double top = place_of(shoot(caster, {1, 4, 1.0}, {0, -1, 0})).y();
  EXPECT_NEAR(foot, 0.295, 0.01);
  EXPECT_LT(top, 0.1);
}

TEST(Boundary, PiecesInARowLeaveNoGapInAWall) {
  Sketch s;
  for (int i = 0; i < 4; ++i)
    add_boundary(s.world, s.street, Boundary::stone_wall, placed(kLength * i, 0, 0), kLength, 1.2);
  const RayCaster caster(s.world);
  for (double x = 0.01; x < 9.99; x += 0.01)
    ASSERT_TRUE(shoot(caster, {x, 4, 0.6}, {0, -1, 0}).hit) << x;
}

TEST(AnyBoundary, DrawsEachKind) {
  core::Rng rng(1);
  std::set<Boundary> kinds;
  for (int i = 0; i < 500; ++i) kinds.insert(any_boundary(rng));
  EXPECT_EQ(kinds.size(), static_cast<std::size_t>(kBoundaries));
}

TEST(Gate, StandsBetweenTwoPillarsOfItsWidth) {
  int closed = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    Sketch s(seed);
    add_gate(s.world, s.street, SE3::Identity(), 3, s.rng);
    const RayCaster caster(s.world);
    for (const double x : {0.0, 3.0}) {
      EXPECT_TRUE(shoot(caster, {x, 4, 0.5}, {0, -1, 0}).hit) << seed;
      EXPECT_TRUE(shoot(caster, {x, 4, 0.95}, {0, -1, 0}).hit) << seed;
    }
    closed += labels_of(s.world, s.mesh()).contains(kFence) && s.mesh().triangles.size() > 24;
  }
  EXPECT_GT(closed, 12);
  EXPECT_LT(closed, 29);
}

TEST(Fence, EachKindRunsAlongXToItsHeight) {
  for (const Fence kind : {Fence::wire, Fence::picket, Fence::wall, Fence::panels}) {
    Sketch s;
    add_fence(s.world, s.palette, kind, SE3::Identity(), 2.5, 1.4);
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_NEAR(box.max().z(), 1.4, 0.06) << static_cast<int>(kind);
    EXPECT_NEAR(box.max().x(), 2.5, 0.1) << static_cast<int>(kind);
    EXPECT_LT(box.sizes().y(), 0.3) << static_cast<int>(kind);
  }
}

TEST(Fence, ARailIsAsHighAsGuardRailsAre) {
  Sketch s;
  add_fence(s.world, s.palette, Fence::rail, SE3::Identity(), 4, 0.75);
  EXPECT_NEAR(box_of(s.mesh()).max().z(), 0.76, 1e-5);
  const RayCaster caster(s.world);
  EXPECT_TRUE(shoot(caster, {1, 4, 0.6}, {0, -1, 0}).hit);
  EXPECT_FALSE(shoot(caster, {1, 4, 0.3}, {0, -1, 0}).hit);
}

}  // namespace
}  // namespace saker::simulation
