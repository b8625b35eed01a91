#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/world/furniture.h"

namespace saker::simulation {
namespace {

/// The kinds that enter the truth, with the heights and radii in which they are sold.
struct Kind {
  const char* name;
  Adder add;
  double lowest, highest, thinnest, thickest;
};

constexpr Kind kKinds[] = {{"lamp", add_lamp, 3.8, 9.5, 0.05, 0.13},
                           {"power", add_power_pole, 7, 10, 0.1, 0.17},
                           {"traffic light", add_traffic_light, 3, 3.8, 0.05, 0.09},
                           {"sign", add_sign, 2.1, 3.2, 0.025, 0.045}};

/// `check` on a dozen poles of each kind, standing at (2, 3).
template <class Check>
void for_each_pole(Check check) {
  const auto draw = [](const Kind& kind, Sketch& s) {
    kind.add(s.world, s.palette, placed(2, 3, 0.5), s.rng);
  };
  for_each_drawing(kKinds, 12, draw, [&](const Kind& kind, const Sketch& s) {
    ASSERT_EQ(s.world.objects.size(), 1U);
    check(kind, s, std::get<objects::Cylinder>(s.world.objects[0].model));
  });
}

TEST(Poles, EnterTheTruthAsWhatTheyAre) {
  for_each_pole([](const Kind& kind, const Sketch& s, const objects::Cylinder&) {
    EXPECT_EQ(s.world.objects[0].class_name, "pole");
    EXPECT_EQ(s.world.objects[0].kind, kind.name);
    EXPECT_FALSE(s.world.objects[0].moving);
  });
}

TEST(Poles, HeightsAndRadiiAreThoseThatAreSold) {
  for_each_pole([](const Kind& kind, const Sketch&, const objects::Cylinder& pole) {
    EXPECT_GE(pole.height, kind.lowest);
    EXPECT_LE(pole.height, kind.highest);
    EXPECT_GE(pole.radius, kind.thinnest);
    EXPECT_LE(pole.radius, kind.thickest);
  });
}

TEST(Poles, StandWhereTheyWerePut) {
  for_each_pole([](const Kind&, const Sketch& s, const objects::Cylinder& pole) {
    EXPECT_LT((pole.root - Eigen::Vector3d(2, 3, 0.5)).norm(), 1e-9);
    EXPECT_LT(box_of(s.mesh()).min().z(), 0.5 + 1e-5);
  });
}

TEST(Poles, LeanByDegreesAtMost) {
  for_each_pole([](const Kind&, const Sketch&, const objects::Cylinder& pole) {
    EXPECT_NEAR(pole.axis.norm(), 1, 1e-9);
    EXPECT_GT(pole.axis.z(), std::cos(0.08));
  });
}

/// Below the plates of signs, above the base of lamps.
TEST(Poles, AtBreastHeightTheShaftIsWhatTheTruthSays) {
  for_each_pole([](const Kind& kind, const Sketch& s, const objects::Cylinder& pole) {
    const RayCaster caster(s.world);
    const Eigen::Vector3d at = pole.root + (kind.add == add_sign ? 1.0 : 1.3) * pole.axis;
    for (int i = 0; i < 8; ++i) {
      const double angle = M_PI * i / 4;
      const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0);
      const Shot shot = shoot(caster, at + 4 * out, -out);
      ASSERT_TRUE(shot.hit);
      EXPECT_NEAR((place_of(shot) - at).norm(), pole.radius, 0.1 * pole.radius + 0.002);
    }
  });
}

TEST(Poles, TheShaftReachesTheTruthsHeight) {
  for_each_pole([](const Kind&, const Sketch& s, const objects::Cylinder& pole) {
    const Eigen::Vector3d below_top = pole.root + (pole.height - 0.02) * pole.axis;
    const RayCaster caster(s.world);
    EXPECT_LT(
        (place_of(shoot(caster, below_top + Eigen::Vector3d(3, 0, 0), {-1, 0, 0})) - below_top)
            .norm(),
        0.5);
    EXPECT_GT(box_of(s.mesh()).max().z(), pole.root.z() + 0.99 * pole.height);
  });
}

TEST(Poles, EveryPartIsPoleOrSign) {
  for_each_pole([](const Kind&, const Sketch& s, const objects::Cylinder&) {
    for (const int label : labels_of(s.world, s.mesh()))
      EXPECT_TRUE(label == kPole || label == kTrafficSign) << label;
  });
}

TEST(Poles, EveryPartBelongsToTheObject) {
  for_each_pole([](const Kind&, const Sketch& s, const objects::Cylinder&) {
    for (const ObjectId id : s.mesh().objects) ASSERT_EQ(id, 1);
  });
}

TEST(Poles, ASignHasAPlateAndAPowerPoleNone) {
  for_each_pole([](const Kind& kind, const Sketch& s, const objects::Cylinder&) {
    const bool plate = labels_of(s.world, s.mesh()).contains(kTrafficSign);
    if (kind.add == add_sign) {
      EXPECT_TRUE(plate);
    }
    if (kind.add == add_power_pole) {
      EXPECT_FALSE(plate);
    }
  });
}

TEST(Poles, APlatesLowerEdgeIsAboveAMetre) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Sketch s(seed);
    add_sign(s.world, s.palette, SE3::Identity(), s.rng);
    EXPECT_GT(box_of_label(s.world, kTrafficSign).min().z(), 1) << seed;
  }
}

TEST(Poles, ABollardIsNoPoleOfTheMap) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Sketch s(seed);
    add_bollard(s.world, s.palette, SE3::Identity(), s.rng);
    EXPECT_TRUE(s.world.objects.empty());
    EXPECT_GE(box_of(s.mesh()).max().z(), 0.6);
    EXPECT_LE(box_of(s.mesh()).max().z(), 1.05);
  }
}

}  // namespace
}  // namespace saker::simulation
