#include "saker/active/active.h"

#include <gtest/gtest.h>

#include "made_place.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;

TEST(Active, ConfigurationThatCannotBeIsRefused) {
  EXPECT_NO_THROW((void)make_tour(visiting(), objects::ClassTable(), {}, everywhere));
  ActiveConfig crowded = visiting();
  crowded.visit_policy.sides = 3;  // and 120° apart: the third may find no room
  EXPECT_THROW((void)make_tour(crowded, objects::ClassTable(), {}, everywhere), Error);
  ActiveConfig hasty = visiting();
  hasty.goals.standing_s = hasty.visit_policy.dwell_s;
  EXPECT_THROW((void)make_tour(hasty, objects::ClassTable(), {}, everywhere), Error);
  ActiveConfig blind = visiting();
  blind.view.nearest_m = blind.view.farthest_m;
  EXPECT_THROW((void)make_tour(blind, objects::ClassTable(), {}, everywhere), Error);
  ActiveConfig out_of_bounds = visiting();
  out_of_bounds.viewpoints.bearings = 0;
  EXPECT_THROW((void)make_tour(out_of_bounds, objects::ClassTable(), {}, everywhere), Error);
}

TEST(Active, ByInformationGainIsRefusedWithoutAModelOrWithOneThatLacksATargetClass) {
  ActiveConfig config;
  for (const PolicyName policy : {PolicyName::paper, PolicyName::saker}) {
    config.policy = policy;
    EXPECT_THROW((void)make_tour(config, objects::ClassTable(), {}, everywhere), Error);
    const auto ignorant = std::make_shared<const uncertainty::Model>();
    EXPECT_THROW((void)make_tour(config, objects::ClassTable(), {}, everywhere, ignorant), Error);
  }
}

TEST(Active, ThatWouldNeverLookIsRefused) {
  ActiveConfig config = visiting();
  config.paper.enough_entropy = 0;
  EXPECT_THROW((void)make_tour(config, objects::ClassTable(), {}, everywhere), Error);
}

TEST(Active, OfARightPriorChangesNothing) {
  PlaceFlight flight(kPark, map_of(kPark));
  EXPECT_LT(flight.fly(), kLong);
  EXPECT_EQ(flight.active.targets().size(), kPark.size());
  EXPECT_EQ(flight.done(), 5);
  EXPECT_EQ(flight.stops, 0);
}

/// Where a prior is farther off than the gate (1.1 % of them), only a sweep would find the vehicle.
TEST(Active, EveryVehicleOfAPriorThatIsTwoMetresOffIsMappedWhereItIsInTheGate) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    core::Rng rng(seed);
    std::vector<Cuboid> rough = kPark;
    for (Cuboid& it : rough) {
      Eigen::Vector2d off;
      do off = {rng.normal(0, 2), rng.normal(0, 2)};
      while (off.norm() > TargetsConfig{}.gate_m);
      it.pose.translation().head<2>() += off;
    }
    PlaceFlight flight(kPark, map_of(rough));
    EXPECT_LT(flight.fly(), kLong);
    EXPECT_EQ(flight.done(), 5) << "seed " << seed << ":" << flight.story();
  }
}

/// Objects appear and vanish, places are free and are not: everything that opens again and again.
TEST(Active, WorldThatFlickersEnds) {
  ActiveConfig config = two_sided();
  config.discovery.sweep.when = SweepWhen::always;
  PlaceFlight flight({}, map_of(kPark), config);
  core::Rng rng(4);
  const auto free = shared(free_grid(60));
  int step = 0;
  for (; step < 4 * kLong; ++step) {
    objects::ObjectMap map;
    for (int i = 0; i < 8; ++i) {
      if (rng.chance(0.2)) continue;
      map.objects.push_back(vehicle(static_cast<int>(step / 20 * 100 + i), car(8 * i - 30, 12)));
    }
    flight.input.map = std::make_shared<const objects::ObjectMap>(std::move(map));
    flight.input.grid = rng.chance(0.8) ? free : nullptr;
    if (flight.decide().status == ActiveStatus::finished) break;
    const Eigen::Vector3d way = flight.plan.goal->position - flight.body;
    flight.body += way * std::min(1.0, 2 / std::max(way.norm(), 1e-9));
  }
  EXPECT_LT(step, 4 * kLong);
}

TEST(Active, InputThatIsNotFiniteOrNotNewerChangesNothing) {
  PlaceFlight flight(kPark, {});
  flight.decide();
  const int goal = flight.plan.goal->id;
  EXPECT_EQ(flight.active.plan(flight.input, kBudget).status, ActiveStatus::invalid);
  const Eigen::Vector3d body = flight.body;
  flight.body.setConstant(NAN);
  EXPECT_EQ(flight.decide().status, ActiveStatus::invalid);
  flight.body = body;
  EXPECT_EQ(flight.decide().goal->id, goal);
}

TEST(Active, DecidesTheSameTwice) {
  PlaceFlight once(kPark, {}), twice(kPark, {});
  EXPECT_EQ(once.fly(), twice.fly());
  EXPECT_EQ(once.body, twice.body);
}

}  // namespace
}  // namespace saker::active
