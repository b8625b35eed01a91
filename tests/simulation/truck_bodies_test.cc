#include "saker/simulation/world/truck_bodies.h"

#include <gtest/gtest.h>

#include "drawn.h"

namespace saker::simulation {
namespace {

constexpr BodyRoom kRoom{-4, 2.5, 1.25, 1.05, 3.4};

using Draw = void (*)(const Pen&, const BodyRoom&, const Parts&, core::Rng&);

struct Kind {
  const char* name;
  Draw draw;
  bool reaches_top;
};

constexpr Kind kKinds[] = {{"box", draw_box_body, true},       {"flat", draw_flat_body, false},
                           {"tipper", draw_tipper_body, true}, {"refuse", draw_refuse_body, true},
                           {"mixer", draw_mixer_body, true},   {"semi", draw_semi_body, false}};

struct Body : Sketch {
  Body(Draw draw, std::uint64_t seed)
      : Sketch(seed), parts(make_parts(world, palette, kTruck, rng)) {
    draw(pen(), kRoom, parts, rng);
  }
  Parts parts;
};

template <class Check>
void for_each_body(Check check) {
  for (const Kind& kind : kKinds) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(seed));
      check(kind, Body(kind.draw, seed));
    }
  }
}

TEST(TruckBodies, StayInTheirRoomFromRearToFront) {
  for_each_body([](const Kind&, const Body& body) {
    EXPECT_GT(box_of(body.mesh()).min().x(), kRoom.rear - 0.06);
    EXPECT_LT(box_of(body.mesh()).max().x(), kRoom.front + 0.75) << "over the cab at most";
  });
}

TEST(TruckBodies, AreNoWiderThanTheirRoom) {
  for_each_body([](const Kind&, const Body& body) {
    EXPECT_LT(box_of(body.mesh()).max().y(), kRoom.half_width + 0.045);
    EXPECT_GT(box_of(body.mesh()).min().y(), -kRoom.half_width - 0.085);
  });
}

TEST(TruckBodies, ReachTheTopOfTheirRoomButForFlatBedsAndTanks) {
  for_each_body([](const Kind& kind, const Body& body) {
    EXPECT_LT(box_of(body.mesh()).max().z(), kRoom.top + 0.06);
    if (kind.reaches_top) {
      EXPECT_NEAR(box_of(body.mesh()).max().z(), kRoom.top, 1e-5);
    }
  });
}

/// A tipper's load reaches through its floor.
TEST(TruckBodies, AreAboveTheMiddleOfTheWheels) {
  for_each_body(
      [](const Kind&, const Body& body) { EXPECT_GT(box_of(body.mesh()).min().z(), 0.48); });
}

TEST(TruckBodies, HaveTheLabelOfTheirVehicle) {
  for_each_body([](const Kind&, const Body& body) {
    EXPECT_EQ(labels_of(body.world, body.mesh()), std::set<int>{kTruck});
  });
}

TEST(BoxBody, NoBeamPassesItsSide) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Body body(draw_box_body, seed);
    const RayCaster caster(body.world);
    for (double x = kRoom.rear + 0.1; x < kRoom.front; x += 0.2) {
      for (double z = kRoom.floor + 0.05; z < kRoom.top; z += 0.2)
        ASSERT_TRUE(shoot(caster, {x, 8, z}, {0, -1, 0}).hit) << seed;
    }
  }
}

TEST(BoxBody, OfSomeTheRearDoorIsOpen) {
  int open = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const Body body(draw_box_body, seed);
    const RayCaster caster(body.world);
    const Shot shot = shoot(caster, {-9, 0.1, 2.6}, {1, 0, 0});
    ASSERT_TRUE(shot.hit);
    open += place_of(shot).x() > 0;
  }
  EXPECT_GT(open, 2);
  EXPECT_LT(open, 25);
}

TEST(FlatBody, ItsFloorIsBareOrLoaded) {
  int bare = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Body body(draw_flat_body, seed);
    const RayCaster caster(body.world);
    double highest = 0;
    for (double x = kRoom.rear + 0.5; x < kRoom.front - 1; x += 0.1) {
      const Shot down = shoot(caster, {x, 0.4, 9}, {0, 0, -1});
      ASSERT_TRUE(down.hit);
      EXPECT_GT(place_of(down).z(), kRoom.floor + 0.11);
      highest = std::max(highest, place_of(down).z());
    }
    bare += highest < kRoom.floor + 0.13;
  }
  EXPECT_GT(bare, 4);
  EXPECT_LT(bare, 26);
}

TEST(TipperBody, ItsSidesSlopeInwardsToItsFloor) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Body body(draw_tipper_body, seed);
    const RayCaster caster(body.world);
    const auto half_width = [&](double z) {
      return place_of(shoot(caster, {kRoom.rear + 1.15, 8, z}, {0, -1, 0})).y();
    };
    EXPECT_LT(half_width(kRoom.floor + 0.2), half_width(kRoom.floor + 0.7)) << seed;
  }
}

TEST(TipperBody, ItsFrontWallReachesOverTheCab) {
  const Body body(draw_tipper_body, 3);
  EXPECT_NEAR(box_of(body.mesh()).max().x(), kRoom.front + 0.7, 1e-5);
  const RayCaster caster(body.world);
  EXPECT_NEAR(place_of(shoot(caster, {kRoom.front + 0.5, 0, 9}, {0, 0, -1})).z(), kRoom.top, 1e-4);
}

TEST(RefuseBody, ItsTailOverhangsBelowTheFloor) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Body body(draw_refuse_body, seed);
    EXPECT_LT(box_of(body.mesh()).min().z(), kRoom.floor - 0.25) << seed;
  }
}

TEST(MixerBody, ItsDrumIsWidestInItsMiddle) {
  const Body body(draw_mixer_body, 1);
  const RayCaster caster(body.world);
  const auto half_width = [&](double x) {
    double widest = 0;
    for (double z = kRoom.floor; z < kRoom.top; z += 0.05) {
      const Shot shot = shoot(caster, {x, 8, z}, {0, -1, 0});
      if (shot.hit) widest = std::max(widest, place_of(shot).y());
    }
    return widest;
  };
  EXPECT_GT(half_width(0.4), half_width(2.2));
  EXPECT_GT(half_width(0.4), half_width(-2.8) + 0.2);
}

TEST(SemiBody, DrawsBoxesContainersTanksAndFlats) {
  int boxes = 0, low = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Body body(draw_semi_body, seed);
    const double top = box_of(body.mesh()).max().z();
    boxes += std::abs(top - kRoom.top) < 1e-4;
    low += top < kRoom.top - 0.06;
  }
  EXPECT_GT(boxes, 25);
  EXPECT_GT(low, 1);
}

}  // namespace
}  // namespace saker::simulation
