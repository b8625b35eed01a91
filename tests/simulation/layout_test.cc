#include "saker/simulation/world/layout.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/world/layout_town.h"

namespace saker::simulation {
namespace {

using enum WorldKind;

constexpr WorldKind kKinds[] = {street, car_park, country,  highway, campus,
                                narrow, avenue,   industry, square};

double width_of(const std::vector<Strip>& strips) {
  double width = 0;
  for (const Strip& strip : strips) width += strip.width;
  return width;
}

std::vector<double> widths_of(const CrossSection& section) {
  std::vector<double> widths;
  for (const auto* side : {&section.left, &section.right}) {
    for (const Strip& strip : *side) widths.push_back(strip.width);
  }
  return widths;
}

int count_of(const std::vector<Strip>& strips, Use use) {
  return static_cast<int>(std::count_if(strips.begin(), strips.end(),
                                        [&](const Strip& strip) { return strip.use == use; }));
}

/// `check` on both sides of many sections of each kind.
template <class Check>
void for_each_side(Check check) {
  const Sketch s;
  for (const WorldKind kind : kKinds) {
    core::Rng rng(5);
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE(enum_names(kind)[static_cast<std::size_t>(kind)] + " " + std::to_string(i));
      const CrossSection section = random_section(kind, s.palette, rng);
      check(kind, s, section.left);
      check(kind, s, section.right);
    }
  }
}

TEST(Layout, EverySideReachesFarEnoughToBeSeen) {
  for_each_side([](WorldKind, const Sketch&, const std::vector<Strip>& side) {
    EXPECT_GT(width_of(side), 57);
    EXPECT_LT(width_of(side), 110);
  });
}

TEST(Layout, EveryStripHasAWidth) {
  for_each_side([](WorldKind, const Sketch&, const std::vector<Strip>& side) {
    for (const Strip& strip : side) EXPECT_GT(strip.width, 0.05);
  });
}

TEST(Layout, LanesAreWideEnoughToDriveOn) {
  for_each_side([](WorldKind, const Sketch&, const std::vector<Strip>& side) {
    for (const Strip& strip : side) {
      if (strip.use != Use::lane) continue;
      EXPECT_GE(strip.width, 1.6);
      EXPECT_LE(strip.width, 5);
    }
  });
}

TEST(Layout, EveryStripsSurfaceIsGround) {
  const std::set<int> ground{kRoad, kParking, kSidewalk, kTerrain, kOtherGround, kLaneMarking};
  for_each_side([&](WorldKind, const Sketch& s, const std::vector<Strip>& side) {
    for (const Strip& strip : side)
      EXPECT_TRUE(ground.contains(s.world.materials[strip.surface].label));
  });
}

TEST(Layout, LanesAreOfRoadAndWalksOfPavementOrYard) {
  for_each_side([](WorldKind, const Sketch& s, const std::vector<Strip>& side) {
    for (const Strip& strip : side) {
      const int label = s.world.materials[strip.surface].label;
      if (strip.use == Use::lane) {
        EXPECT_EQ(label, kRoad);
      } else if (strip.use == Use::sidewalk) {
        EXPECT_TRUE(label == kSidewalk || label == kOtherGround);
      }
    }
  });
}

TEST(Layout, KerbsAreNoHigherThanKerbsAre) {
  for_each_side([](WorldKind, const Sketch&, const std::vector<Strip>& side) {
    for (const Strip& strip : side) EXPECT_LE(std::abs(strip.kerb), 0.19);
  });
}

TEST(Layout, ParkingIsAsDeepAsACarIsWideOrLong) {
  for_each_side([](WorldKind, const Sketch&, const std::vector<Strip>& side) {
    for (const Strip& strip : side) {
      if (strip.use == Use::parallel_parking) {
        EXPECT_GE(strip.width, 1.9);
        EXPECT_LE(strip.width, 2.7);
      } else if (strip.use == Use::perpendicular_parking) {
        EXPECT_GE(strip.width, 4.8);
        EXPECT_LE(strip.width, 5.6);
      }
    }
  });
}

TEST(Layout, EachKindHasWhatMakesIt) {
  for_each_side([](WorldKind kind, const Sketch&, const std::vector<Strip>& side) {
    if (kind == street || kind == narrow) {
      EXPECT_EQ(count_of(side, Use::lane), 1);
    } else if (kind == highway || kind == avenue) {
      EXPECT_GE(count_of(side, Use::lane), 2);
    } else if (kind == car_park) {
      EXPECT_GE(count_of(side, Use::perpendicular_parking), 1);
      EXPECT_EQ(count_of(side, Use::lane), 0);
    } else if (kind == industry) {
      EXPECT_EQ(count_of(side, Use::industry), 1);
    } else if (kind == square) {
      EXPECT_EQ(count_of(side, Use::square), 1);
    } else if (kind == campus) {
      EXPECT_GE(count_of(side, Use::lawn), 2);
    }
  });
}

TEST(Layout, TheSameSeedGivesTheSameSection) {
  const Sketch s;
  for (const WorldKind kind : kKinds) {
    core::Rng a(3), b(3), c(4);
    const CrossSection first = random_section(kind, s.palette, a);
    const CrossSection again = random_section(kind, s.palette, b);
    const CrossSection other = random_section(kind, s.palette, c);
    EXPECT_EQ(widths_of(first), widths_of(again));
    EXPECT_NE(widths_of(first), widths_of(other));
  }
}

TEST(AnyWorld, StreetsAreTheMostAndEveryKindIsDrawn) {
  core::Rng rng(1);
  std::map<WorldKind, double> share;
  for (int i = 0; i < 5000; ++i) share[any_world(rng)] += 1 / 5000.0;
  EXPECT_EQ(share.size(), std::size(kKinds));
  EXPECT_FALSE(share.contains(mixed));
  EXPECT_NEAR(share[street], 0.28, 0.03);
  for (const auto& [kind, part] : share) EXPECT_LE(part, share[street]);
}

TEST(RandomTerrain, OnlyTownsHaveCrossings) {
  const Sketch s;
  for (const WorldKind kind : kKinds) {
    core::Rng rng(2);
    int crossings = 0;
    for (int i = 0; i < 100; ++i) crossings += random_terrain(kind, s.palette, rng).crossing < 1e8;
    const bool town = kind == street || kind == narrow || kind == avenue || kind == industry;
    EXPECT_EQ(crossings > 0, town);
    EXPECT_LT(crossings, 70);
  }
}

TEST(RandomTerrain, ACarParkIsFlatAndStraight) {
  const Sketch s;
  core::Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const TerrainShape t = random_terrain(car_park, s.palette, rng);
    EXPECT_EQ(t.bend_m, 0);
    EXPECT_LE(t.relief_m, 0.06);
  }
}

TEST(RandomTerrain, TheCountryIsSteeperThanACarPark) {
  const Sketch s;
  core::Rng rng(2);
  Spread hills, flat;
  for (int i = 0; i < 400; ++i) {
    hills.add(random_terrain(country, s.palette, rng).grade);
    flat.add(random_terrain(highway, s.palette, rng).grade);
  }
  EXPECT_NEAR(hills.sd(), 0.045, 0.006);
  EXPECT_LT(flat.sd(), 0.7 * hills.sd());
}

/// `check` on sections of each kind before and after they were varied.
template <class Check>
void for_each_varied(Check check) {
  for (const WorldKind kind : kKinds) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      SCOPED_TRACE(seed);
      Sketch s(seed);
      const CrossSection before = random_section(kind, s.palette, s.rng);
      CrossSection after = before;
      vary_section(after, s.world, s.street, s.rng);
      check(s, before, after);
    }
  }
}

TEST(VarySection, KeepsTheStripsAndTheirWidths) {
  for_each_varied([](const Sketch&, const CrossSection& before, const CrossSection& after) {
    ASSERT_EQ(before.left.size(), after.left.size());
    for (std::size_t i = 0; i < before.left.size(); ++i)
      EXPECT_EQ(before.left[i].width, after.left[i].width);
  });
}

TEST(VarySection, ChangesOfUsesOnlyBuildingsAndBarriers) {
  for_each_varied([](const Sketch&, const CrossSection& before, const CrossSection& after) {
    for (std::size_t i = 0; i < before.left.size(); ++i) {
      const Use was = before.left[i].use, is = after.left[i].use;
      const bool turned = (was == Use::buildings && is == Use::houses) ||
                          (was == Use::barrier && is == Use::border);
      EXPECT_TRUE(was == is || turned);
    }
  });
}

TEST(VarySection, LanesStayRoad) {
  for_each_varied([](const Sketch& s, const CrossSection&, const CrossSection& after) {
    for (const Strip& strip : after.left) {
      if (strip.use == Use::lane) {
        EXPECT_EQ(s.world.materials[strip.surface].label, kRoad);
      }
    }
  });
}

TEST(VarySection, NeitherLanesNorParkingAreRough) {
  for_each_varied([](const Sketch&, const CrossSection&, const CrossSection& after) {
    for (const Strip& strip : after.right) {
      const bool soft = strip.use == Use::verge || strip.use == Use::garden ||
                        strip.use == Use::lawn || strip.use == Use::tree_row ||
                        strip.use == Use::forest || strip.use == Use::thicket;
      EXPECT_TRUE(soft || strip.rough == 0);
      EXPECT_LE(strip.rough, 0.1);
    }
  });
}

TEST(VaryGround, KerbsAreLoweredOnBothSides) {
  core::Rng rng(3);
  for (int i = 0; i < 50; ++i) {
    TerrainShape t;
    vary_ground(t, street, rng);
    int left = 0, right = 0;
    for (const DroppedKerb& kerb : t.dropped) {
      (kerb.side > 0 ? left : right) += 1;
      EXPECT_GT(kerb.to, kerb.from);
      EXPECT_LT(kerb.to - kerb.from, 5.01);
    }
    EXPECT_GE(left, 3);
    EXPECT_GE(right, 3);
  }
}

TEST(VaryGround, ACarParkHasFewRamps) {
  core::Rng rng(3);
  int hilly = 0, flat = 0;
  for (int i = 0; i < 400; ++i) {
    TerrainShape a, b;
    vary_ground(a, country, rng);
    vary_ground(b, car_park, rng);
    hilly += !a.ramps.empty();
    flat += !b.ramps.empty();
  }
  EXPECT_NEAR(hilly / 400.0, 0.4, 0.07);
  EXPECT_NEAR(flat / 400.0, 0.1, 0.05);
}

TEST(VaryGround, ASecondRampFallsAsTheFirstClimbs) {
  core::Rng rng(5);
  int pairs = 0;
  for (int i = 0; i < 200; ++i) {
    TerrainShape t;
    vary_ground(t, street, rng);
    if (t.ramps.size() != 2) continue;
    ++pairs;
    EXPECT_DOUBLE_EQ(t.ramps[0].slope, -t.ramps[1].slope);
    EXPECT_GE(t.ramps[1].from, t.ramps[0].to);
  }
  EXPECT_GT(pairs, 20);
}

TEST(VaryGround, PotholesAreHollowsOfCentimetres) {
  core::Rng rng(5);
  for (int i = 0; i < 100; ++i) {
    TerrainShape t;
    vary_ground(t, street, rng);
    for (const Swell& swell : t.swells) {
      if (std::abs(swell.d) < 5.01) {
        EXPECT_LT(swell.height, 0);
        EXPECT_GT(swell.height, -0.08);
      } else {
        EXPECT_GT(std::abs(swell.d), 13.9) << "mounds are beside the road";
      }
    }
  }
}

}  // namespace
}  // namespace saker::simulation
