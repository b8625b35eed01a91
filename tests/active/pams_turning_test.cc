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

/// The border of a cell lies between where the vehicle was and the sample beside it.
TEST(Saker, DoesNotFlyToASampleBesideWhereItLookedFrom) {
  PamsConfig config = never_enough(PamsConfig::saker());
  config.sampling = Sampling::uniform;
  config.price_per_s = 0;
  const double beside = 0.005;  // rad, of the border of a cell at 30°
  const Cuboid target = car(25, 5, pi / 6 - beside);
  ViewModel alike = oblique_model();  // so that the nearest cell is the next
  alike.predict = [](objects::ClassId id, const uncertainty::View& view) {
    uncertainty::Prediction prediction = predict(id, view);
    prediction.covariance = 0.04 * Eigen::MatrixXd::Identity(4, 4);
    return prediction;
  };
  PamsFlight flight(config, {target}, everywhere, alike);
  const auto sample =
      std::ranges::find_if(flight.decide().candidates, [&](const ViewpointCandidate& one) {
        return std::abs(one.viewpoint.bearing - pi / 3) < 1e-6;
      });
  ASSERT_NE(sample, flight.plan.candidates.end());
  const Eigen::Vector3d out = sample->viewpoint.position - target.pose.translation();
  flight.body =
      target.pose.translation() + Eigen::AngleAxisd(-2 * beside, Eigen::Vector3d::UnitZ()) * out;
  const Eigen::Vector3d place = flight.body;
  for (int step = 0; step < 3; ++step) flight.decide();
  flight.goals.clear();
  flight.fly(60);
  for (const Viewpoint& viewpoint : flight.goals) {
    EXPECT_GT((viewpoint.position - place).norm(), config.looked_from.near_m);
  }
}

}  // namespace
}  // namespace saker::active
