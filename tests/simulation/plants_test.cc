#include "saker/simulation/world/plants.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

/// A world with the prototypes of its plants.
struct Garden : Sketch {
  explicit Garden(std::uint64_t seed = 1) : Sketch(seed), flora(grow_flora(world, palette, rng)) {}

  void plant(const TreeShape& shape, const SE3& T = SE3::Identity()) {
    add_tree(world, palette, flora, shape, T, rng);
  }
  [[nodiscard]] const objects::Cylinder& trunk() const {
    return std::get<objects::Cylinder>(world.objects.back().model);
  }

  Flora flora;
};

TreeShape straight(double radius) {
  TreeShape shape;
  shape.trunk_radius = radius;
  return shape;
}

TEST(AddTree, TheTrunkIsAsThickAtBreastHeightAsTheTruthSays) {
  for (const double radius : {0.06, 0.15, 0.3}) {
    Garden g;
    g.plant(straight(radius));
    g.world.placements.clear();
    const RayCaster caster(g.world);
    for (const Eigen::Vector3d& from : {Eigen::Vector3d(5, 0, 1.2), Eigen::Vector3d(0, 5, 1.2)}) {
      const Eigen::Vector3d towards = Eigen::Vector3d(0, 0, 1.2) - from;
      EXPECT_NEAR(place_of(shoot(caster, from, towards)).head<2>().norm(), radius, 0.08 * radius);
    }
  }
}

TEST(AddTree, TheTruthIsRootedWhereItStands) {
  Garden g;
  const SE3 T = placed(4, -7, 0.3, 1);
  g.plant(straight(0.2), T);
  EXPECT_EQ(g.trunk().root, T.translation());
  EXPECT_DOUBLE_EQ(g.trunk().radius, 0.2);
  EXPECT_DOUBLE_EQ(g.trunk().height, 2.5);
  EXPECT_EQ(g.world.objects.back().class_name, "trunk");
}

TEST(AddTree, ALeaningTrunkFollowsTheTruthsAxis) {
  Garden g;
  TreeShape shape = straight(0.15);
  shape.lean_x = 0.08;
  shape.lean_y = -0.05;
  g.plant(shape);
  g.world.placements.clear();
  const RayCaster caster(g.world);
  const double z = 1.2;
  const Eigen::Vector3d on_axis = g.trunk().root + z / g.trunk().axis.z() * g.trunk().axis;
  const Eigen::Vector3d left =
      place_of(shoot(caster, on_axis + Eigen::Vector3d(0, 5, 0), {0, -1, 0}));
  const Eigen::Vector3d right =
      place_of(shoot(caster, on_axis - Eigen::Vector3d(0, 5, 0), {0, 1, 0}));
  EXPECT_LT((0.5 * (left + right) - on_axis).norm(), 0.01);
}

TEST(AddTree, ATrunkUnderLessThanAMetreOfStemIsNotInTheTruth) {
  Garden g;
  TreeShape shape = straight(0.2);
  shape.crown_start = 0.9;
  g.plant(shape);
  EXPECT_TRUE(g.world.objects.empty());
  shape.crown_start = 1.1;
  g.plant(shape);
  EXPECT_EQ(g.world.objects.size(), 1U);
}

TEST(AddTree, TheCrownBeginsAtItsHeight) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Garden g(seed);
    TreeShape shape = straight(0.2);
    shape.crown_start = 3;
    g.plant(shape);
    ASSERT_EQ(g.world.placements.size(), 1U);
    const Eigen::AlignedBox3d crown = box_of_placements(g.world);
    EXPECT_GT(crown.min().z(), 2.6);
    EXPECT_LT(crown.max().z(), 3 + 1.1 * shape.crown_height);
    EXPECT_LT(crown.max().head<2>().norm(), 2 * shape.crown_radius);
  }
}

TEST(AddTree, ABareOneHasNoLeaves) {
  Garden g;
  TreeShape shape = straight(0.2);
  shape.bare = true;
  g.plant(shape);
  EXPECT_TRUE(g.world.placements.empty());
  EXPECT_GT(box_of_label(g.world, kVegetation).max().z(), shape.crown_start);
}

TEST(AddTree, AConiferHasNoBoughsButItsCrown) {
  Garden g;
  TreeShape shape = straight(0.2);
  shape.conifer = true;
  g.plant(shape);
  EXPECT_EQ(labels_of(g.world, g.mesh()), std::set<int>{kTrunk});
  const auto& conifers = g.flora.conifers;
  EXPECT_NE(std::find(conifers.begin(), conifers.end(), g.world.placements.at(0).prototype),
            conifers.end());
  EXPECT_EQ(g.world.objects.back().kind, "conifer");
}

TEST(AddTree, CrownAndTrunkAreOneObject) {
  Garden g;
  g.plant(straight(0.2));
  EXPECT_EQ(g.world.placements.at(0).object, 1);
  for (const ObjectId id : g.mesh().objects) EXPECT_EQ(id, 1);
}

TEST(AddTree, TheTrunkGoesIntoTheGround) {
  Garden g;
  g.plant(straight(0.2));
  EXPECT_NEAR(box_of_label(g.world, kTrunk).min().z(), -0.3, 0.02);
}

TEST(RandomTree, StaysWithinWhatGrows) {
  core::Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const TreeShape s = random_tree(rng);
    EXPECT_GE(s.trunk_radius, 0.045);
    EXPECT_LE(s.trunk_radius, 0.42);
    EXPECT_GT(s.crown_radius, 0.3);
    EXPECT_LT(s.crown_radius, 4.6);
    EXPECT_GT(s.crown_height, 1.4);
    EXPECT_LT(s.crown_height, 14);
    EXPECT_FALSE(s.conifer && s.bare);
  }
}

TEST(RandomTree, OneInSevenIsAConiferAndSomeAreBare) {
  core::Rng rng(3);
  int conifers = 0, bare = 0;
  for (int i = 0; i < 4000; ++i) {
    const TreeShape s = random_tree(rng);
    conifers += s.conifer;
    bare += s.bare;
  }
  EXPECT_NEAR(conifers / 4000.0, 0.15, 0.02);
  EXPECT_NEAR(bare / 4000.0, 0.85 * 0.08, 0.015);
}

TEST(RandomTree, OldOnesAreThickAndWide) {
  core::Rng rng(3);
  Spread thin, thick;
  for (int i = 0; i < 3000; ++i) {
    const TreeShape s = random_tree(rng);
    if (s.conifer) continue;
    (s.trunk_radius < 0.1 ? thin : thick).add(s.crown_radius);
  }
  EXPECT_GT(thick.mean(), 1.4 * thin.mean());
}

TEST(AddBush, StandsOnTheGroundAndHasItsSize) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Garden g(seed);
    add_bush(g.world, g.flora, placed(3, 4, 0.5), 0.8, 1.4, g.rng);
    const Eigen::AlignedBox3d box = box_of_placements(g.world);
    EXPECT_GT(box.min().z(), 0.5 - 0.15);
    EXPECT_LT(box.min().z(), 0.5 + 0.4);
    EXPECT_GT(box.max().z(), 0.5 + 0.6 * 1.4);
    EXPECT_LT(box.max().z(), 0.5 + 1.25 * 1.4);
    EXPECT_LT((box.max() - Eigen::Vector3d(3, 4, 0)).head<2>().maxCoeff(), 1.5);
  }
}

TEST(AddHedgeBlock, RunsAlongXFromItsOrigin) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Garden g(seed);
    add_hedge_block(g.world, g.flora, SE3::Identity(), 1.05, 0.8, 1.6, g.rng);
    const Eigen::AlignedBox3d box = box_of_placements(g.world);
    EXPECT_NEAR(box.min().x(), 0, 0.12);
    EXPECT_NEAR(box.max().x(), 1.05, 0.12);
    EXPECT_NEAR(box.center().y(), 0, 0.1);
    EXPECT_NEAR(box.max().z(), 1.6, 0.35);
  }
}

TEST(AddHedgeBlock, NoBeamPassesItsCore) {
  Garden g;
  add_hedge_block(g.world, g.flora, SE3::Identity(), 1, 0.8, 1.6, g.rng);
  const RayCaster caster(g.world);
  for (double x = 0.05; x < 0.95; x += 0.05) {
    for (double z = 0.1; z < 1.4; z += 0.1)
      EXPECT_TRUE(shoot(caster, {x, 5, z}, {0, -1, 0}).hit) << x << " " << z;
  }
}

TEST(Flora, HasPrototypesOfEachKindEachDrawnOnce) {
  const Garden g;
  std::set<std::size_t> all;
  for (const auto* kind : {&g.flora.crowns, &g.flora.conifers, &g.flora.bushes, &g.flora.hedges}) {
    EXPECT_GE(kind->size(), 2U);
    all.insert(kind->begin(), kind->end());
  }
  EXPECT_EQ(all.size(), g.world.prototypes.size());
}

TEST(Flora, CrownsFillTheirUnit) {
  const Garden g;
  for (const auto* kind : {&g.flora.crowns, &g.flora.conifers}) {
    for (const std::size_t i : *kind) {
      const Eigen::AlignedBox3d box = box_of(g.world.prototypes[i]);
      EXPECT_GT(box.min().z(), -0.1);
      EXPECT_LT(box.max().z(), 1.1);
      EXPECT_GT(box.sizes().z(), 0.75);
      EXPECT_LT(box.sizes().head<2>().maxCoeff(), 2.4);
      EXPECT_GT(box.sizes().head<2>().minCoeff(), 0.8);
    }
  }
}

TEST(Flora, AConiferIsWideBelowAndNarrowAtItsTop) {
  const Garden g;
  for (const std::size_t i : g.flora.conifers) {
    Spread low, high;
    for (const Eigen::Vector3f& p : g.world.prototypes[i].vertices) {
      if (p.z() < 0.25F) low.add(p.head<2>().norm());
      if (p.z() > 0.75F) high.add(p.head<2>().norm());
    }
    EXPECT_GT(low.mean(), 2 * high.mean());
  }
}

TEST(Flora, ACrownStopsMoreThanAFifthOfTheBeamsThroughItsMiddle) {
  const Garden g;
  for (const std::size_t i : g.flora.crowns) {
    World alone;
    alone.materials = g.world.materials;
    alone.mesh = g.world.prototypes[i];
    const RayCaster caster(alone);
    int met = 0, all = 0;
    for (double y = -0.4; y <= 0.4; y += 0.02) {
      for (double z = 0.3; z <= 0.7; z += 0.02) {
        ++all;
        met += shoot(caster, {5, y, z}, {-1, 0, 0}).hit;
      }
    }
    EXPECT_GT(met, 0.2 * all);
  }
}

TEST(Flora, BushesBeginAtTheGround) {
  const Garden g;
  for (const std::size_t i : g.flora.bushes) {
    const Eigen::AlignedBox3d box = box_of(g.world.prototypes[i]);
    EXPECT_LT(box.min().z(), 0.1);
    EXPECT_GT(box.min().z(), -0.15);
  }
}

}  // namespace
}  // namespace saker::simulation
