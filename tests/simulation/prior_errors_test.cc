#include "saker/simulation/mission/prior_errors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drawn.h"
#include "saker/core/error.h"

namespace saker::simulation {
namespace {

/// Ten vehicles in two rows, twelve trunks beside them; the first eight vehicles are the targets.
struct Surveyed {
  Surveyed() {
    for (int i = 0; i < 10; ++i) {
      objects::Cuboid car;
      car.pose = placed(8.0 * (i % 5) - 16, i < 5 ? -6 : 6, 0.75);
      car.size = {4.5, 1.8, 1.5};
      world.add({"vehicle", "sedan", car});
      if (i >= 8) continue;
      objects::MapObject entry;
      entry.id = i + 1;
      entry.model = car;
      prior.objects.push_back(entry);
    }
    for (int i = 0; i < 12; ++i) {
      objects::Cylinder trunk;
      trunk.root = {4.0 * i - 22, 14, 0};
      trunk.axis = Eigen::Vector3d::UnitZ();
      trunk.radius = 0.2;
      trunk.height = 3;
      world.add({i % 2 == 0 ? "trunk" : "pole", "any", trunk});
    }
    fence.polygon_m = {-40, -40, 40, -40, 40, 40, -40, 40};
  }

  [[nodiscard]] objects::ObjectMap with(const PriorErrorsConfig& errors,
                                        std::uint64_t seed = 1) const {
    MissionSiteConfig site;
    site.prior_errors = errors;
    core::Rng rng(seed);
    return with_errors(prior, world, SE3::Identity(), fence, site, rng);
  }
  [[nodiscard]] static int targets_of(const objects::ObjectMap& map) {
    return static_cast<int>(
        std::ranges::count_if(map.objects, [](const objects::MapObject& o) { return o.id <= 8; }));
  }

  World world;
  objects::ObjectMap prior;
  MissionFence fence;
};

TEST(PriorErrors, WithoutAnyThePriorStaysAsItIs) {
  const Surveyed s;
  const objects::ObjectMap map = s.with({});
  ASSERT_EQ(map.objects.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(map.objects[i].id, s.prior.objects[i].id);
    EXPECT_EQ(objects::place(map.objects[i].model), objects::place(s.prior.objects[i].model));
  }
}

TEST(PriorErrors, EachKindIsAsOftenAsAsked) {
  const Surveyed s;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const objects::ObjectMap map =
        s.with({.missing_share = 0.25, .invented = 3, .duplicates = 2, .mistaken = 4}, seed);
    EXPECT_EQ(Surveyed::targets_of(map), 6);
    EXPECT_EQ(map.objects.size(), 6U + 3 + 2 + 4);
  }
}

TEST(PriorErrors, EveryIdIsGivenOnceAndNewOnesFollowTheWorlds) {
  const Surveyed s;
  const objects::ObjectMap map = s.with({.invented = 2, .duplicates = 3, .mistaken = 2});
  std::set<int> ids;
  for (const auto& object : map.objects) {
    ids.insert(object.id);
    EXPECT_TRUE(object.id <= 8 || object.id > static_cast<int>(s.world.objects.size()));
  }
  EXPECT_EQ(ids.size(), map.objects.size());
}

TEST(PriorErrors, MissingOnesAreDrawnFromAllTargets) {
  const Surveyed s;
  std::set<int> ever_missing;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::set<int> there;
    for (const auto& object : s.with({.missing_share = 0.125}, seed).objects)
      there.insert(object.id);
    for (int id = 1; id <= 8; ++id) {
      if (!there.contains(id)) ever_missing.insert(id);
    }
  }
  EXPECT_EQ(ever_missing.size(), 8U);
}

TEST(PriorErrors, AllMayBeMissing) {
  EXPECT_TRUE(Surveyed().with({.missing_share = 1}).objects.empty());
}

TEST(PriorErrors, InventedOnesAreFarFromEveryVehicleAndInsideTheFence) {
  const Surveyed s;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const objects::ObjectMap map = s.with({.invented = 5}, seed);
    for (std::size_t i = 8; i < map.objects.size(); ++i) {
      const Eigen::Vector3d p = objects::place(map.objects[i].model);
      EXPECT_LE(p.head<2>().cwiseAbs().maxCoeff(), 36);
      for (const TrueObject& object : s.world.objects) {
        if (object.class_name != "vehicle") continue;
        EXPECT_GE((objects::place(object.model) - p).head<2>().norm(), 8);
      }
    }
  }
}

TEST(PriorErrors, MistakenOnesStandAtTreesAndPolesEachOnce) {
  const Surveyed s;
  MissionSiteConfig site;
  site.prior_sd_m = 0;
  site.prior_errors.mistaken = 9;
  core::Rng rng(3);
  const objects::ObjectMap map = with_errors(s.prior, s.world, SE3::Identity(), s.fence, site, rng);
  std::set<long> places;
  for (std::size_t i = 8; i < map.objects.size(); ++i) {
    const Eigen::Vector3d p = objects::place(map.objects[i].model);
    EXPECT_NEAR(p.y(), 14, 1e-9);
    places.insert(std::lround(p.x()));
  }
  EXPECT_EQ(places.size(), 9U);
}

TEST(PriorErrors, DuplicatesAreAsRoughAsThePrior) {
  const Surveyed s;
  Spread apart;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const objects::ObjectMap map = s.with({.duplicates = 3}, seed);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d d =
          objects::place(map.objects[8 + i].model) - objects::place(s.prior.objects[i].model);
      apart.add(d.x());
      apart.add(d.y());
    }
  }
  EXPECT_NEAR(apart.sd(), 1, 0.08);
  EXPECT_NEAR(apart.mean(), 0, 0.1);
}

TEST(PriorErrors, TheSameSeedMakesTheSameErrors) {
  const Surveyed s;
  const PriorErrorsConfig errors{.missing_share = 0.25, .invented = 2, .mistaken = 1};
  const objects::ObjectMap a = s.with(errors, 5), b = s.with(errors, 5), c = s.with(errors, 6);
  ASSERT_EQ(a.objects.size(), b.objects.size());
  bool differs = false;
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(objects::place(a.objects[i].model), objects::place(b.objects[i].model));
    differs |= objects::place(a.objects[i].model) != objects::place(c.objects[i].model);
  }
  EXPECT_TRUE(differs);
}

TEST(PriorErrors, WhereNoPlaceIsFarFromAllVehiclesItSaysSo) {
  Surveyed s;
  s.fence.polygon_m = {-20, -10, 20, -10, 20, 10, -20, 10};
  try {
    (void)s.with({.invented = 1});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("prior_errors.invented"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::simulation
