#include "saker/simulation/world/street_plants.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

using enum TreeHabit;

constexpr TreeHabit kHabits[] = {single, forked,  many_stems, pollarded, staked,
                                 palm,   skirted, thick,      fallen};

/// A world with the prototypes of all plants of training's streets.
struct Park : Sketch {
  explicit Park(std::uint64_t seed = 1)
      : Sketch(seed),
        flora(grow_flora(world, palette, rng)),
        street_flora(grow_street_flora(world, street, rng)) {}

  [[nodiscard]] Nursery nursery(double bare_share = 0) {
    return {world, street, flora, street_flora, bare_share};
  }
  void plant(TreeHabit habit, double bare_share = 0) {
    add_street_tree(nursery(bare_share), habit, 1, SE3::Identity(), rng);
  }
  [[nodiscard]] Eigen::AlignedBox3d prototype_box(std::size_t i) const {
    return box_of(world.prototypes[i]);
  }

  Flora flora;
  StreetFlora street_flora;
};

TEST(StreetTree, StandsAtItsPlaceAndNotFarUnderTheGround) {
  for (const TreeHabit habit : kHabits) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Park park(seed);
      park.plant(habit);
      Eigen::AlignedBox3d box = box_of(park.mesh());
      if (!park.world.placements.empty()) box.extend(box_of_placements(park.world));
      EXPECT_LT(box.exteriorDistance(Eigen::Vector3d(0, 0, 0.3)), 0.3) << static_cast<int>(habit);
      EXPECT_GT(box.min().z(), -2.6) << static_cast<int>(habit);
      EXPECT_LT(box.max().z(), 15) << static_cast<int>(habit);
    }
  }
}

TEST(StreetTree, IsInNoMapForItOnlyTrainsTheNetwork) {
  for (const TreeHabit habit : kHabits) {
    Park park;
    park.plant(habit);
    EXPECT_TRUE(park.world.objects.empty());
  }
}

TEST(StreetTree, StandingOnesHaveATrunkAndSkirtedAndFallenOnesNone) {
  for (const TreeHabit habit : kHabits) {
    Park park;
    park.plant(habit);
    const bool trunk = labels_of(park.world, park.mesh()).contains(kTrunk);
    EXPECT_EQ(trunk, habit != skirted && habit != fallen) << static_cast<int>(habit);
  }
}

TEST(StreetTree, InWinterItHasNoCrown) {
  for (const TreeHabit habit : {single, forked, many_stems, staked, thick}) {
    Park winter, summer;
    winter.plant(habit, 1);
    summer.plant(habit, 0);
    EXPECT_TRUE(winter.world.placements.empty()) << static_cast<int>(habit);
    EXPECT_FALSE(summer.world.placements.empty()) << static_cast<int>(habit);
  }
}

TEST(StreetTree, AThickOneIsThickerThanASingleOne) {
  const auto width = [](TreeHabit habit) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Park park(seed);
      park.plant(habit);
      for (const Eigen::Vector3f& p : park.mesh().vertices)
        if (p.z() < 0) sum = std::max(sum, static_cast<double>(p.head<2>().norm()));
    }
    return sum;
  };
  EXPECT_GT(width(thick), 1.5 * width(single));
}

TEST(StreetTree, ManyStemsAreAtLeastThree) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Park park(seed);
    park.plant(many_stems, 1);
    const RayCaster caster(park.world);
    std::set<std::pair<long, long>> cells;  // of 5 cm: where the ground is pierced
    for (double x = -0.5; x <= 0.5; x += 0.02) {
      for (double y = -0.5; y <= 0.5; y += 0.02) {
        const Shot up = shoot(caster, {x, y, -3}, {0, 0, 1}, 3);
        if (up.hit && park.world.materials[up.material].label == kTrunk)
          cells.emplace(std::lround(x / 0.1), std::lround(y / 0.1));
      }
    }
    EXPECT_GE(cells.size(), 3U) << seed;
  }
}

TEST(StreetTree, TheRoomItTakesIsLargerForTheWideOnes) {
  EXPECT_GT(room_of(skirted), room_of(single));
  EXPECT_GT(room_of(thick), room_of(staked));
}

TEST(AnyHabit, DrawsAllThatStand) {
  core::Rng rng(4);
  std::set<TreeHabit> seen;
  for (int i = 0; i < 500; ++i) seen.insert(any_habit(rng));
  EXPECT_EQ(seen.size(), 8U);
  EXPECT_FALSE(seen.contains(fallen)) << "those lie about by a chance of their own";
}

TEST(ClippedHedge, HasTheSizeThatWasAskedForWhateverItsBlocks) {
  for (const HedgeSize& size :
       {HedgeSize{1, 0.4, 0.5}, HedgeSize{5, 1.2, 2.5}, HedgeSize{3.3, 0.6, 1.1}}) {
    Park park;
    add_clipped_hedge(park.nursery(), size, SE3::Identity(), park.rng);
    const Eigen::AlignedBox3d box = box_of_placements(park.world);
    EXPECT_NEAR(box.min().x(), 0, 0.2);
    EXPECT_NEAR(box.max().x(), size.length, 0.2);
    EXPECT_NEAR(box.sizes().y(), size.depth, 0.25 * size.depth);
    EXPECT_NEAR(box.max().z(), size.height, 0.12 * size.height);
  }
}

TEST(ClippedHedge, HidesWhatIsBehindIt) {
  Park park;
  add_clipped_hedge(park.nursery(), {4, 1, 1.5}, SE3::Identity(), park.rng);
  const RayCaster caster(park.world);
  for (double x = 0.15; x < 3.9; x += 0.19)  // not between its two blocks
    EXPECT_TRUE(shoot(caster, {x, 5, 0.7}, {0, -1, 0}).hit) << x;
}

TEST(Planter, HasABoxWithPlantsInIt) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Park park(seed);
    add_planter(park.nursery(), SE3::Identity(), park.rng);
    const Eigen::AlignedBox3d box = box_of(park.mesh());
    EXPECT_NEAR(box.min().z(), 0, 1e-6);
    EXPECT_FALSE(park.world.placements.empty());
    EXPECT_GT(box_of_placements(park.world).max().z(), box.max().z()) << seed;
    EXPECT_EQ(labels_of(park.world, park.mesh()), std::set<int>{kOtherObject});
  }
}

TEST(Bed, IsAsLongAndDeepAsAsked) {
  Park park;
  add_bed(park.nursery(), SE3::Identity(), 6, 1.2, park.rng);
  const Eigen::AlignedBox3d box = box_of_placements(park.world);
  EXPECT_NEAR(box.min().x(), -3, 0.2);
  EXPECT_NEAR(box.max().x(), 3, 0.2);
  EXPECT_NEAR(box.sizes().y(), 1.2, 0.4);
  EXPECT_LT(box.max().z(), 0.85);
}

TEST(Ivy, HangsBeforeItsWall) {
  Park park;
  add_ivy(park.nursery(), SE3::Identity(), 5, 3, park.rng);
  const Eigen::AlignedBox3d box = box_of_placements(park.world);
  EXPECT_LT(box.max().y(), 0.1);
  EXPECT_GT(box.min().y(), -0.6);
  EXPECT_LT(box.max().z(), 1.2 * 3 * 1.1);
}

TEST(Tuft, IsLowAndStandsOnTheGround) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Park park(seed);
    add_tuft(park.nursery(), SE3::Identity(), park.rng);
    const Eigen::AlignedBox3d box = box_of_placements(park.world);
    EXPECT_NEAR(box.min().z(), 0, 1e-4);
    EXPECT_LT(box.max().z(), 1.2);
  }
}

TEST(StreetFlora, BoxesFillTheirUnitBlock) {
  const Park park;
  for (const std::size_t i : park.street_flora.boxes) {
    const Eigen::AlignedBox3d box = park.prototype_box(i);
    EXPECT_NEAR(box.sizes().x(), 1, 0.15);
    EXPECT_NEAR(box.sizes().y(), 1, 0.15);
    EXPECT_NEAR(box.max().z(), 1, 0.08);
  }
}

TEST(StreetFlora, DomesAreHigherInTheirMiddleThanAtTheirEdge) {
  const Park park;
  for (const std::size_t i : park.street_flora.rounds) {
    double middle = 0, edge = 0;
    for (const Eigen::Vector3f& p : park.world.prototypes[i].vertices) {
      const double out = p.head<2>().norm();
      if (out < 0.3) middle = std::max(middle, static_cast<double>(p.z()));
      if (out > 0.95) edge = std::max(edge, static_cast<double>(p.z()));
    }
    EXPECT_GT(middle, 0.85);
    EXPECT_LT(edge, middle);
  }
}

TEST(StreetFlora, ASkirtedConiferIsWidestAtTheGround) {
  const Park park;
  for (const std::size_t i : park.street_flora.skirted) {
    Spread low, high;
    for (const Eigen::Vector3f& p : park.world.prototypes[i].vertices) {
      if (p.z() < 0.2F) low.add(p.head<2>().norm());
      if (p.z() > 0.7F) high.add(p.head<2>().norm());
    }
    EXPECT_GT(low.mean(), 2 * high.mean());
  }
}

TEST(StreetFlora, FrondsHangDownAtTheirEnds) {
  const Park park;
  for (const std::size_t i : park.street_flora.fronds) {
    const Eigen::AlignedBox3d box = park.prototype_box(i);
    EXPECT_NEAR(box.sizes().x() / 2, 1, 0.15);
    EXPECT_LT(box.min().z(), -0.2);
    EXPECT_GT(box.max().z(), 0.1);
  }
}

TEST(StreetFlora, WideningAddsBushesAndHedgesAndNoCrown) {
  Park park;
  const Flora before = park.flora;
  widen_flora(park.world, park.street, park.flora, park.rng);
  EXPECT_EQ(park.flora.crowns.size(), before.crowns.size());
  EXPECT_EQ(park.flora.bushes.size(), before.bushes.size() + 2);
  EXPECT_EQ(park.flora.hedges.size(), before.hedges.size() + 1);
  EXPECT_EQ(park.flora.bushes.back(), park.world.prototypes.size() - 2);
}

}  // namespace
}  // namespace saker::simulation
