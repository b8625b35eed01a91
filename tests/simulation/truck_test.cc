#include <gtest/gtest.h>

#include "made_fleet.h"

namespace saker::simulation {
namespace {

using enum FleetKind;

constexpr FleetKind kTrucks[] = {step_van,      box_van,      box_truck,
                                 flatbed_truck, tipper_truck, refuse_truck,
                                 mixer_truck,   semi_trailer, long_nose_semi};
constexpr FleetKind kLorries[] = {box_truck,    flatbed_truck, tipper_truck,
                                  refuse_truck, mixer_truck,   semi_trailer};

TEST(Truck, HasAFrontThatNoBeamPassesUpToTheWindscreen) {
  for_each_member(kTrucks, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    for (double y = -0.6; y <= 0.6; y += 0.2) {
      for (double z = 0.6; z < 1.2; z += 0.1) {
        const Shot shot = shoot(caster, {20, y, z}, {-1, 0, 0});
        ASSERT_TRUE(shot.hit);
        EXPECT_GT(place_of(shot).x(), m.front() - 2.2);
      }
    }
  });
}

TEST(Truck, ItsDriverLooksThroughGlass) {
  for_each_member(kLorries, [](const Member& m) {
    const RayCaster& caster = *m.caster;
    bool glass = false;
    for (double z = 1.2; z < 3; z += 0.05)
      glass |= m.is_glass(shoot(caster, {20, 0.2, z}, {-1, 0, 0}));
    EXPECT_TRUE(glass);
  });
}

TEST(Truck, BeamsPassUnderItBetweenItsAxles) {
  for_each_member(kLorries, [](const Member& m) {
    EXPECT_LT(m.covered(0.25, -m.front() + 0.5, m.front() - 0.5), 0.85);
  });
}

TEST(Truck, ItsWheelsStandOnTheGround) {
  for_each_member(kTrucks, [](const Member& m) {
    int low = 0;
    for (const Eigen::Vector3f& p : m.mesh().vertices) low += p.z() < 0.01F;
    EXPECT_GE(low, 8) << "two vertices of each of four tyres at least";
  });
}

TEST(Truck, OnlyMirrorsStandOutOfItsWidthByMoreThanAHand) {
  for_each_member(
      kTrucks,
      [](const Member& m) {
        const RayCaster& caster = *m.caster;
        for (double x = -m.front() + 0.2; x < m.front() - 3; x += 0.1) {
          for (double z = 0.3; z < m.shape.height; z += 0.3) {
            const Shot shot = shoot(caster, {x, 8, z}, {0, -1, 0});
            if (shot.hit) {
              EXPECT_LT(place_of(shot).y(), m.shape.width / 2 + 0.1);
            }
          }
        }
      },
      3);
}

TEST(BoxTruck, ItsBoxIsHigherThanItsCab) {
  for_each_member(std::array{box_truck}, [](const Member& m) {
    EXPECT_NEAR(m.top_at(-m.front() + 2), m.shape.height, 0.02);
    EXPECT_LT(m.top_at(m.front() - 1.2), m.shape.height - 0.2);
  });
}

TEST(BoxVan, HasABonnetBeforeItsWindscreen) {
  for_each_member(std::array{box_van}, [](const Member& m) {
    EXPECT_LT(m.top_at(m.front() - 0.3), 1.5);
    EXPECT_GT(m.top_at(-m.front() + 1), 2.8);
  });
}

TEST(FlatbedTruck, ItsBedIsLowerThanItsCab) {
  for_each_member(std::array{flatbed_truck}, [](const Member& m) {
    EXPECT_GT(m.top_at(m.front() - 1.2), 2);
    EXPECT_GT(m.top_at(m.front() - 1.2), m.top_at(-m.front() + 0.05) + 0.3);
  });
}

TEST(StepVan, IsOneRoomFromItsWindscreenToItsRear) {
  for_each_member(std::array{step_van}, [](const Member& m) {
    for (double x = -m.front() + 0.3; x < m.front() - 2.2; x += 0.3)
      EXPECT_NEAR(m.top_at(x), m.shape.height, 0.02);
    EXPECT_EQ(m.covered(1.0, -m.front() + 0.3, m.front() - 0.9), 1);
  });
}

TEST(SemiTrailer, ItsTrailerEndsAtItsRearAndIsApartFromTheTractor) {
  for_each_member(std::array{semi_trailer, long_nose_semi}, [](const Member& m) {
    EXPECT_NEAR(box_of(m.mesh()).min().x(), -m.front(), 0.06);
    EXPECT_LT(m.covered(2.0, -m.front() + 0.2, m.front() - 0.2), 0.99);
  });
}

TEST(SemiTrailer, HasMoreAxlesThanARigidTruck) {
  const auto tyre_area = [](FleetKind kind) {
    double sum = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Member m(kind, seed);
      for (const Eigen::Vector3f& p : m.mesh().vertices) sum += p.z() < 0.01F;
    }
    return sum;
  };
  EXPECT_GT(tyre_area(semi_trailer), 1.4 * tyre_area(box_truck));
}

TEST(LongNoseSemi, ItsBonnetIsBeforeItsCab) {
  for_each_member(std::array{long_nose_semi}, [](const Member& m) {
    EXPECT_LT(m.top_at(m.front() - 0.5), 2);
    EXPECT_GT(m.top_at(m.front() - 2.6), 2.8);
  });
}

TEST(RefuseTruck, ItsTailSlopes) {
  for_each_member(std::array{refuse_truck}, [](const Member& m) {
    EXPECT_LT(m.top_at(-m.front() + 0.25), m.top_at(-m.front() + 2.2) - 0.1);
  });
}

}  // namespace
}  // namespace saker::simulation
