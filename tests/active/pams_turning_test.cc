/// Estimates that turn in flight.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "made_pams_flight.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;
using std::numbers::pi;

class TurningEstimate : public testing::TestWithParam<PamsConfig> {};

INSTANTIATE_TEST_SUITE_P(Pams, TurningEstimate,
                         testing::Values(PamsConfig::paper(), PamsConfig::saker()),
                         [](const auto& one) { return one.index == 0 ? "paper" : "saker"; });

TEST_P(TurningEstimate, EndsThoughTheHeadingFlipsAllTheTime) {
  PamsFlight flight(never_enough(GetParam()), kStreet);
  int step = 0;
  for (; step < 2000 && flight.decide().status == ActiveStatus::flying; ++step) {
    std::vector<Cuboid> flipped = kStreet;
    for (Cuboid& cuboid : flipped) {
      cuboid.pose.rotate(Eigen::AngleAxisd(step % 4 * pi / 2, Eigen::Vector3d::UnitZ()));
    }
    flight.map(flipped);
    const Eigen::Vector3d way = flight.plan.goal->position - flight.body;
    flight.body += way * std::min(1.0, 2 / std::max(way.norm(), 1e-9));
  }
  EXPECT_LT(step, 2000);
}

TEST_P(TurningEstimate, IsNoViewpointFlown) {
  PamsConfig config = never_enough(GetParam());
  config.price_per_s = 0;
  PamsFlight flight(config, {car(25, 5)});
  std::size_t flown = 0;
  for (int step = 0; step < 200 && flight.decide().status == ActiveStatus::flying; ++step) {
    for (; flown < flight.flown.size(); ++flown) {
      const int id = flight.flown[flown].viewpoint_id;
      const auto goal = std::ranges::find(flight.goals, id, &Viewpoint::id);
      ASSERT_NE(goal, flight.goals.end());
      EXPECT_LT((goal->position - flight.body).norm(), 2 * kCellRange) << "decision " << step;
    }
    flight.map({car(25, 5, step / 6 % 4 * pi / 2)});
    const Eigen::Vector3d way = flight.plan.goal->position - flight.body;
    flight.body += way * std::min(1.0, 2 / std::max(way.norm(), 1e-9));
  }
  EXPECT_GT(flown, 0U);
}

/// Wherever the cells' borders come to lie.
TEST(Saker, DoesNotFlyAgainToWhereItLookedFromWhenTheEstimateTurns) {
  for (double turn = 0; turn < 0.6; turn += 0.1) {
    PamsConfig config = never_enough(PamsConfig::saker());
    config.price_per_s = 0;
    PamsFlight flight(config, {car(25, 5)});
    for (int step = 0; step < 60 && flight.flown.empty(); ++step) flight.fly(1);
    ASSERT_FALSE(flight.flown.empty());
    for (int step = 0; step < 3; ++step) flight.decide();  // stands there
    const Eigen::Vector3d place = flight.body;
    flight.map({car(25, 5, turn)});
    flight.goals.clear();
    flight.fly(60);
    for (const Viewpoint& viewpoint : flight.goals) {
      EXPECT_GT((viewpoint.position - place).norm(), config.looked_from.near_m) << turn;
    }
  }
}

}  // namespace
}  // namespace saker::active
