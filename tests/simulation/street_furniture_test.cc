#include "saker/simulation/world/street_furniture.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

using Choose = Furnishing (*)(core::Rng&);

/// `check` on many things of a size, each drawn alone about the origin.
template <class Check>
void for_each_thing(Choose choose, Check check) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    Sketch s(seed);
    const Furnishing thing = choose(s.rng);
    thing.add(s.world, s.street, SE3::Identity(), s.rng);
    check(thing, s);
  }
}

template <class Check>
void for_each_thing(Check check) {
  for (const Choose choose : {any_small_thing, any_middling_thing, any_car_sized_thing})
    for_each_thing(choose, check);
}

TEST(StreetFurniture, StandsOnTheGround) {
  for_each_thing([](const Furnishing&, const Sketch& s) {
    EXPECT_LT(box_of(s.mesh()).min().z(), 0.11);
    EXPECT_GT(box_of(s.mesh()).min().z(), -2);
  });
}

TEST(StreetFurniture, IsObjectOrGroundOrStructure) {
  const std::set<int> allowed{kOtherObject, kOtherStructure, kTerrain, kOtherGround};
  for_each_thing([&](const Furnishing&, const Sketch& s) {
    for (const int label : labels_of(s.world, s.mesh())) EXPECT_TRUE(allowed.contains(label));
  });
}

TEST(StreetFurniture, IsInNoMap) {
  for_each_thing([](const Furnishing&, const Sketch& s) { EXPECT_TRUE(s.world.objects.empty()); });
}

TEST(StreetFurniture, SmallThingsAreLessThanTwoMetresHigh) {
  for_each_thing(any_small_thing, [](const Furnishing&, const Sketch& s) {
    EXPECT_LT(box_of(s.mesh()).max().z(), 2);
    EXPECT_GT(box_of(s.mesh()).max().z(), 0.15);
  });
}

TEST(StreetFurniture, CarSizedThingsAreSeenBesideACar) {
  for_each_thing(any_car_sized_thing, [](const Furnishing&, const Sketch& s) {
    EXPECT_GT(box_of(s.mesh()).sizes().head<2>().maxCoeff(), 1.1);
    EXPECT_GT(box_of(s.mesh()).max().z(), 0.15);
    EXPECT_LT(box_of(s.mesh()).max().z(), 4);
  });
}

TEST(StreetFurniture, EachOfItsTablesIsDrawn) {
  core::Rng rng(1);
  std::set<StreetAdder> small, middling, large;
  for (int i = 0; i < 500; ++i) {
    small.insert(any_small_thing(rng).add);
    middling.insert(any_middling_thing(rng).add);
    large.insert(any_car_sized_thing(rng).add);
  }
  EXPECT_EQ(small.size(), 8U);
  EXPECT_EQ(middling.size(), 8U);
  EXPECT_EQ(large.size(), 8U);
}

TEST(StreetFurniture, TheSameSeedDrawsTheSame) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch a(seed), b(seed);
    any_car_sized_thing(a.rng).add(a.world, a.street, SE3::Identity(), a.rng);
    any_car_sized_thing(b.rng).add(b.world, b.street, SE3::Identity(), b.rng);
    EXPECT_EQ(a.mesh().vertices, b.mesh().vertices);
  }
}

TEST(BollardRow, StandsInALineAlongX) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch s(seed);
    add_bollard_row(s.world, s.street, SE3::Identity(), s.rng);
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_LT(box.sizes().y(), 0.42) << seed;
    EXPECT_GT(box.min().x(), -0.25) << seed;
    EXPECT_GT(box.max().x(), 1.7) << seed;
    EXPECT_LT(box.max().z(), 1.15) << seed;
  }
}

TEST(WheelieBins, StandSideBySideAndDoNotTouchTheGroundWithTheirBodies) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch s(seed);
    add_wheelie_bins(s.world, s.street, SE3::Identity(), s.rng);
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_NEAR(box.min().z(), 0.05, 1e-5) << seed;
    EXPECT_GT(box.max().z(), 0.9) << seed;
    EXPECT_LT(box.max().z(), 1.2) << seed;
    EXPECT_LT(box.sizes().y(), 1) << seed;
  }
}

TEST(Scaffold, CoversItsFrontToItsHeight) {
  Sketch s;
  add_scaffold(s.world, s.street, SE3::Identity(), 10, 6);
  const Eigen::AlignedBox3d box = box_of(s.mesh());
  EXPECT_NEAR(box.min().x(), 0, 0.05);
  EXPECT_NEAR(box.max().x(), 10, 0.05);
  EXPECT_GT(box.max().z(), 6);
  EXPECT_LT(box.max().y(), 0) << "it stands before the front";
  EXPECT_EQ(labels_of(s.world, s.mesh()), std::set<int>{kOtherStructure});
}

TEST(Scaffold, HasAPlankEveryTwoMetres) {
  Sketch s;
  add_scaffold(s.world, s.street, SE3::Identity(), 10, 8);
  const RayCaster caster(s.world);
  const std::vector<Shot> planks = surfaces_along(caster, {1.3, -0.7, 20}, {0, 0, -1});
  ASSERT_EQ(planks.size(), 8U);  // four, each with two faces
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(place_of(planks[2 * i]).z(), 8 - 2.0 * static_cast<double>(i), 1e-4);
}

}  // namespace
}  // namespace saker::simulation
