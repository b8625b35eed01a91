#include "saker/simulation/world/furniture.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

/// What stands in streets but is in no map: sizes from above, m, and labels.
struct Kind {
  const char* name;
  Adder add;
  double least_height, most_height, most_reach;
  std::set<int> labels;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> kKinds = {
      {"bin", add_bin, 0.9, 1.3, 0.9, {kOtherObject}},
      {"bench", add_bench, 0.85, 0.9, 0.9, {kOtherObject}},
      {"box", add_box, 0.7, 1.6, 1.0, {kOtherObject, kOtherStructure}},
      {"shelter", add_shelter, 2.4, 2.45, 2.6, {kOtherStructure}},
      {"person", add_person, 1.45, 1.95, 0.6, {kPerson}},
      {"bicycle", add_bicycle, 0.95, 2.2, 1.2, {kBicycle, kPerson}},
      {"container", add_container, 1.3, 2.6, 3.4, {kOtherStructure}}};
  return kKinds;
}

template <class Check>
void for_each_thing(Check check) {
  const auto draw = [](const Kind& kind, Sketch& s) {
    kind.add(s.world, s.palette, SE3::Identity(), s.rng);
  };
  for_each_drawing(kinds(), 15, draw, check);
}

TEST(Furniture, StandsOnTheGround) {
  for_each_thing([](const Kind&, const Sketch& s) {
    EXPECT_GT(box_of(s.mesh()).min().z(), -0.04);
    EXPECT_LT(box_of(s.mesh()).min().z(), 0.16);
  });
}

TEST(Furniture, IsAsHighAsSuchThingsAre) {
  for_each_thing([](const Kind& kind, const Sketch& s) {
    EXPECT_GE(box_of(s.mesh()).max().z(), kind.least_height - 1e-5);
    EXPECT_LE(box_of(s.mesh()).max().z(), kind.most_height + 1e-5);
  });
}

TEST(Furniture, StaysWithinItsReachOfTheOrigin) {
  for_each_thing([](const Kind& kind, const Sketch& s) {
    for (const Eigen::Vector3f& p : s.mesh().vertices)
      ASSERT_LT(p.head<2>().norm(), kind.most_reach);
  });
}

TEST(Furniture, HasItsLabel) {
  for_each_thing([](const Kind& kind, const Sketch& s) {
    for (const int label : labels_of(s.world, s.mesh())) EXPECT_TRUE(kind.labels.contains(label));
  });
}

TEST(Furniture, IsInNoMap) {
  for_each_thing([](const Kind&, const Sketch& s) { EXPECT_TRUE(s.world.objects.empty()); });
}

TEST(Furniture, MovesWithItsPlace) {
  for (const Kind& kind : kinds()) {
    Sketch here(5), there(5);
    const SE3 T = placed(7, -2, 1, 0.8);
    kind.add(here.world, here.palette, SE3::Identity(), here.rng);
    kind.add(there.world, there.palette, T, there.rng);
    ASSERT_EQ(here.mesh().vertices.size(), there.mesh().vertices.size()) << kind.name;
    for (std::size_t i = 0; i < here.mesh().vertices.size(); ++i) {
      const Eigen::Vector3d expected = T * here.mesh().vertices[i].cast<double>();
      ASSERT_LT((there.mesh().vertices[i].cast<double>() - expected).norm(), 1e-5) << kind.name;
    }
  }
}

TEST(Furniture, BeamsPassThePanesOfAShelter) {
  Sketch s;
  add_shelter(s.world, s.palette, SE3::Identity(), s.rng);
  const RayCaster caster(s.world);
  const Shot shot = shoot(caster, {0.3, 5, 1.5}, {0, -1, 0});
  ASSERT_TRUE(shot.hit);
  EXPECT_GT(s.world.materials[shot.material].transmission, 0.3F);
}

TEST(Furniture, ABenchHasItsBackAlongTheStreet) {
  Sketch s;
  add_bench(s.world, s.palette, SE3::Identity(), s.rng);
  const RayCaster caster(s.world);
  EXPECT_TRUE(shoot(caster, {0.2, 5, 0.65}, {0, -1, 0}).hit);
  EXPECT_NEAR(place_of(shoot(caster, {0.2, -5, 0.65}, {0, 1, 0})).y(), 0.22, 1e-4);
}

TEST(Furniture, ABicyclesWheelsAreOpen) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Sketch s(seed);
    add_bicycle(s.world, s.palette, SE3::Identity(), s.rng);
    if (labels_of(s.world, s.mesh()).contains(kPerson)) continue;
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_NEAR(box.max().z(), 1.02, 1e-5);
    EXPECT_LT(area_of(s.mesh()), 3);  // a disc of that size has 0.7 m² a wheel and side
  }
}

TEST(Furniture, AContainerIsClosed) {
  Sketch s;
  add_container(s.world, s.palette, SE3::Identity(), s.rng);
  EXPECT_EQ(open_edges(s.mesh()), 0);
}

}  // namespace
}  // namespace saker::simulation
