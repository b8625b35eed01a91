#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/world/street_furniture.h"

namespace saker::simulation {
namespace {

/// Poles of training's streets and how high they may be.
struct Kind {
  const char* name;
  StreetAdder add;
  double lowest, highest;
};

constexpr Kind kKinds[] = {{"armed lamp", add_armed_lamp, 3.9, 12.2},
                           {"boxed pole", add_boxed_pole, 2.1, 8.7},
                           {"mast light", add_mast_light, 5.6, 7.6},
                           {"catenary pole", add_catenary_pole, 6.4, 12},
                           {"cross-arm pole", add_cross_arm_pole, 6.8, 15},
                           {"plain pole", add_plain_pole, 1.9, 12.2},
                           {"big sign", add_big_sign, 1.0, 4.7}};

template <class Check>
void for_each_pole(Check check) {
  const auto draw = [](const Kind& kind, Sketch& s) {
    kind.add(s.world, s.street, SE3::Identity(), s.rng);
  };
  for_each_drawing(kKinds, 12, draw, check);
}

/// Wires lean with their pole.
TEST(StreetPoles, AreAsHighAsSuchPolesAre) {
  for_each_pole([](const Kind& kind, const Sketch& s) {
    EXPECT_GE(box_of(s.mesh()).max().z(), kind.lowest);
    EXPECT_LE(box_of(s.mesh()).max().z(), kind.highest);
  });
}

TEST(StreetPoles, GoIntoTheGround) {
  for_each_pole([](const Kind&, const Sketch& s) { EXPECT_LT(box_of(s.mesh()).min().z(), -0.1); });
}

TEST(StreetPoles, AreInNoMapForTheyOnlyTrainTheNetwork) {
  for_each_pole([](const Kind&, const Sketch& s) { EXPECT_TRUE(s.world.objects.empty()); });
}

TEST(StreetPoles, AreOfPoleSignAndCloth) {
  const std::set<int> allowed{kPole, kTrafficSign, kOtherObject};
  for_each_pole([&](const Kind& kind, const Sketch& s) {
    const std::set<int> labels = labels_of(s.world, s.mesh());
    EXPECT_TRUE(labels.contains(kPole)) << kind.name;
    for (const int label : labels) EXPECT_TRUE(allowed.contains(label)) << label;
  });
}

TEST(StreetPoles, AtBreastHeightTheShaftIsAtItsPlace) {
  for_each_pole([](const Kind& kind, const Sketch& s) {
    if (kind.add == add_big_sign) return;  // it stands on two
    const RayCaster caster(s.world);
    const Shot shot = shoot(caster, {0, -6, 0.25}, {0, 1, 0});
    ASSERT_TRUE(shot.hit);
    EXPECT_LT(std::abs(place_of(shot).y()), 0.5);
  });
}

TEST(StreetPoles, ABigSignStandsOnTwoPosts) {
  Sketch s;
  add_big_sign(s.world, s.street, SE3::Identity(), s.rng);
  const RayCaster caster(s.world);
  int posts = 0;
  bool inside = false;
  for (double y = -3; y < 3; y += 0.01) {
    const bool hit = shoot(caster, {6, y, 0.1}, {-1, 0, 0}).hit;
    posts += hit && !inside;
    inside = hit;
  }
  EXPECT_EQ(posts, 2);
}

TEST(StreetPoles, AMastReachesOverTheLane) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch s(seed);
    add_mast_light(s.world, s.street, SE3::Identity(), s.rng);
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_LT(box.min().y(), -2.9) << seed;
    EXPECT_GT(box.min().y(), -9.3) << seed;
  }
}

TEST(StreetPoles, LorriesPassUnderAMast) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch s(seed);
    add_mast_light(s.world, s.street, SE3::Identity(), s.rng);
    for (const Eigen::Vector3f& p : s.mesh().vertices) {
      if (p.y() < -1) {
        EXPECT_GT(p.z(), 4.2F) << seed;
      }
    }
  }
}

TEST(StreetPoles, WiresHangAboveEveryVehicle) {
  for (const StreetAdder add : {add_catenary_pole, add_cross_arm_pole}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Sketch s(seed);
      add(s.world, s.street, SE3::Identity(), s.rng);
      Spread height;  // a pole that leans lifts one end and lowers the other
      for (const Eigen::Vector3f& p : s.mesh().vertices) {
        if (std::abs(p.x()) > 10) height.add(p.z());
      }
      EXPECT_GT(height.mean(), 4.2) << seed;
    }
  }
}

TEST(Gantry, SpansItsWidthBetweenTwoFeet) {
  for (const double width : {9.0, 14.0, 22.0}) {
    Sketch s;
    add_gantry(s.world, s.street, SE3::Identity(), width, s.rng);
    const Eigen::AlignedBox3d box = box_of(s.mesh());
    EXPECT_NEAR(box.min().y(), 0, 0.26);
    EXPECT_NEAR(box.max().y(), width, 0.26);
    const RayCaster caster(s.world);
    EXPECT_FALSE(shoot(caster, {9, width / 2, 2}, {-1, 0, 0}).hit);
    EXPECT_TRUE(shoot(caster, {9, 0, 2}, {-1, 0, 0}).hit);
    EXPECT_TRUE(shoot(caster, {9, width, 2}, {-1, 0, 0}).hit);
  }
}

TEST(Gantry, ItsSignsHangAboveEveryVehicle) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch s(seed);
    add_gantry(s.world, s.street, SE3::Identity(), 16, s.rng);
    const Eigen::AlignedBox3d signs = box_of_label(s.world, kTrafficSign);
    EXPECT_GT(signs.min().z(), 4.2) << seed;
    EXPECT_GT(signs.min().y(), 1) << seed;
    EXPECT_LT(signs.max().y(), 16) << seed;
  }
}

TEST(AnyPole, DrawsEachKindOfItsTable) {
  core::Rng rng(2);
  std::set<StreetAdder> kinds;
  for (int i = 0; i < 500; ++i) kinds.insert(any_pole(rng));
  EXPECT_EQ(kinds.size(), 6U);
}

}  // namespace
}  // namespace saker::simulation
