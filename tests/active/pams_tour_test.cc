#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "made_flight.h"
#include "made_model.h"
#include "made_pams_flight.h"
#include "saker/active/tour/target_tour.h"
#include "saker/core/rng.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;
using std::numbers::pi;

const GoalsConfig kGoals;

double obliqueness(const Viewpoint& viewpoint, double heading) {
  return std::abs(std::sin(2 * (viewpoint.bearing - heading)));
}

class BothPolicies : public testing::TestWithParam<PamsConfig> {};

INSTANTIATE_TEST_SUITE_P(Pams, BothPolicies,
                         testing::Values(PamsConfig::paper(), PamsConfig::saker()),
                         [](const auto& one) { return one.index == 0 ? "paper" : "saker"; });

TEST_P(BothPolicies, EndWithEveryTargetDone) {
  PamsFlight flight(GetParam(), kStreet);
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.plan.done, 4);
  EXPECT_EQ(flight.plan.pending, 0);
}

TEST_P(BothPolicies, WithoutTargetsAreFinishedAtOnce) {
  PamsFlight flight(GetParam(), {});
  EXPECT_EQ(flight.decide().status, ActiveStatus::finished);
}

TEST_P(BothPolicies, FlyToTheViewsThatTheModelSaysAreGood) {
  PamsFlight flight(GetParam(), {car(20, 5, 0.7)});
  flight.fly(600);
  ASSERT_GE(flight.goals.size(), 1U);
  for (const Viewpoint& viewpoint : flight.goals) EXPECT_GT(obliqueness(viewpoint, 0.7), 0.7);
}

TEST_P(BothPolicies, FlyElsewhereWhenTheModelSaysStraightViewsAreGood) {
  ViewModel straight = oblique_model();
  straight.predict = [](objects::ClassId id, const uncertainty::View& view) {
    uncertainty::Prediction prediction = predict(id, view);
    const double sd = view_sd(view.angle + pi / 4);
    prediction.covariance = Eigen::MatrixXd::Identity(4, 4) * sd * sd;
    return prediction;
  };
  straight.in_region = [](objects::ClassId, const uncertainty::View& view) {
    return std::abs(std::sin(2 * view.angle)) < 0.6;
  };
  PamsFlight flight(GetParam(), {car(20, 5, 0.7)}, everywhere, straight);
  flight.fly(600);
  ASSERT_GE(flight.goals.size(), 1U);
  EXPECT_LT(obliqueness(flight.goals.front(), 0.7), 0.6);
}

TEST_P(BothPolicies, LookForATargetThatIsNotMappedAsVisitDoes) {
  PamsFlight flight(GetParam(), kStreet);
  flight.map({});
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.plan.visited, 4);
  EXPECT_TRUE(flight.flown.empty());
}

TEST_P(BothPolicies, EndATargetAtTheEntropyThreshold) {
  PamsConfig config = GetParam();
  config.enough_entropy = -6;  // the first view is enough
  config.most_size_sd_m = 10;
  config.price_per_s = 0;
  PamsFlight flight(config, {car(20, 5)});
  flight.fly(600);
  EXPECT_EQ(flight.target(0).status, TargetStatus::done);
  EXPECT_NE(flight.target(0).reason.find("well enough"), std::string::npos);
}

TEST_P(BothPolicies, DoNotEndItThereWhileItsClassIsUnsure) {
  PamsConfig config = GetParam();
  config.enough_entropy = -6;
  PamsFlight flight(config, {car(20, 5)});
  objects::ObjectMap unsure = map_of({car(20, 5)});
  unsure.objects[0].class_probability = {0.5, 0.5, 0, 0, 0};
  flight.input.map = std::make_shared<const objects::ObjectMap>(unsure);
  flight.fly(600);
  EXPECT_EQ(flight.target(0).reason.find("well enough"), std::string::npos);
}

TEST(Saker, DoesNotEndATargetThereWhileItsViewsDisagree) {
  const auto reason = [](const PamsConfig& policy) {
    PamsConfig config = policy;
    config.enough_entropy = -6;
    PamsFlight flight(config, {car(20, 5)});
    objects::ObjectMap unsure = map_of({car(20, 5)});
    unsure.objects[0].covariance = 0.25 * Matrix9d::Identity();
    flight.input.map = std::make_shared<const objects::ObjectMap>(unsure);
    flight.fly(600);
    return flight.target(0).reason;
  };
  EXPECT_EQ(reason(PamsConfig::saker()).find("well enough"), std::string::npos);
  EXPECT_NE(reason(PamsConfig::paper()).find("well enough"), std::string::npos);
}

TEST_P(BothPolicies, EndWhenNothingReachableTellsMore) {
  PamsFlight flight(never_enough(GetParam()), {car(20, 5)});
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.target(0).status, TargetStatus::done);
  EXPECT_EQ(flight.target(0).reason.find("well enough"), std::string::npos);
}

TEST_P(BothPolicies, OutsideTheGeofenceNothingIsTried) {
  PamsFlight flight(GetParam(), kStreet, [](const Eigen::Vector3d& p) { return p.x() < 0; });
  EXPECT_EQ(flight.fly(5), 0);
  EXPECT_EQ(flight.plan.unreachable, 4);
  EXPECT_TRUE(flight.goals.empty());
}

TEST_P(BothPolicies, TargetBehindAClosedWallIsUnreachableAndTheReasonSaysSo) {
  auto grid = free_grid();
  fill(grid, {6, -30, -1}, {6.5, 30, 7});
  PamsFlight flight(GetParam(), {car(16, 0)});  // all viewpoints are in the block
  flight.see(grid);
  EXPECT_LT(flight.fly(100), 100);
  EXPECT_EQ(flight.target(0).status, TargetStatus::unreachable);
  EXPECT_NE(flight.target(0).reason.find("enclosed"), std::string::npos) << flight.target(0).reason;
}

TEST_P(BothPolicies, WithAVehicleThatNeverMovesEnd) {
  PamsFlight flight(GetParam(), kStreet);
  flight.speed = 0;
  const double each = kGoals.attempts * kGoals.most_refusals * (kGoals.standing_s + 3);
  EXPECT_LT(flight.fly(2000), 4 * each);
}

TEST_P(BothPolicies, WithMotionThatRefusesEverythingEnd) {
  PamsFlight flight(GetParam(), kStreet);
  int decisions = 0;
  while (decisions < 1000 && flight.decide().goal) {
    flight.tour.refuse(flight.plan.goal->id, "no path");
    ++decisions;
  }
  EXPECT_LE(decisions, 4 * kGoals.attempts * kGoals.most_refusals);
  EXPECT_EQ(flight.plan.unreachable, 4);
}

TEST_P(BothPolicies, DoNotOfferARefusedViewpointAgainNorOneBesideIt) {
  PamsFlight flight(GetParam(), {car(12, 0)});
  const Viewpoint refused = *flight.decide().goal;
  flight.tour.refuse(refused.id, "no path");
  flight.decide();
  ASSERT_TRUE(flight.plan.goal);
  EXPECT_GE((flight.plan.goal->position - refused.position).norm(), kGoals.refused_m);
}

TEST_P(BothPolicies, EndWhileEstimatesTremble) {
  core::Rng rng(3);
  PamsFlight flight(never_enough(GetParam()), kStreet);
  int step = 0;
  for (; step < 1000 && flight.decide().status == ActiveStatus::flying; ++step) {
    std::vector<Cuboid> trembling = kStreet;
    for (Cuboid& cuboid : trembling) {
      cuboid.pose.translation().head<2>() += Eigen::Vector2d(rng.normal(), rng.normal()) * 0.05;
      cuboid.pose.rotate(Eigen::AngleAxisd(0.05 * rng.normal(), Eigen::Vector3d::UnitZ()));
    }
    flight.map(trembling);
    const Eigen::Vector3d way = flight.plan.goal->position - flight.body;
    flight.body += way * std::min(1.0, 2 / std::max(way.norm(), 1e-9));
  }
  EXPECT_LT(step, 1000);
  EXPECT_EQ(flight.plan.done, 4);
  EXPECT_LE(flight.goals.size(), 4U * static_cast<std::size_t>(GetParam().most_views));
}

TEST_P(BothPolicies, PredictEachViewpointBeforeItIsFlownAndTheRecursionComesTrue) {
  PamsConfig config = never_enough(GetParam());
  config.drift_counts = false;
  config.price_per_s = 0;
  PamsFlight flight(config, {car(20, 0)});
  flight.fly(600);
  ASSERT_GE(flight.flown.size(), 2U);
  const double prior = config.prior_length_m * config.prior_length_m;
  double last = std::log(prior);
  for (const Expectation& flown : flight.flown) {
    EXPECT_EQ(flown.target_id, 0);
    EXPECT_GT(flown.gain, 0);
    ASSERT_EQ(flown.covariance.rows(), 4);
    const double now = std::log(flown.covariance(2, 2));
    EXPECT_LT(now, last + 1e-9);                     // each view leaves less
    EXPECT_GT(flown.covariance(2, 2), 0.05 * 0.05);  // and never less than what is common
    last = now;
  }
}

TEST_P(BothPolicies, DecideTheSameTwice) {
  PamsFlight once(GetParam(), kStreet), twice(GetParam(), kStreet);
  once.fly(600);
  twice.fly(600);
  ASSERT_EQ(once.goals.size(), twice.goals.size());
  for (std::size_t i = 0; i < once.goals.size(); ++i) {
    EXPECT_EQ(once.goals[i].position, twice.goals[i].position);
  }
}

TEST_P(BothPolicies, CountWhatIsSeenUnderWay) {
  PamsFlight flight(GetParam(), {car(20, 0)});
  for (double bearing = 0; bearing < 2 * pi; bearing += 0.1) {  // somebody else flies around it
    flight.body = {20 + 10 * std::cos(bearing), 10 * std::sin(bearing), 3};
    flight.decide();
  }
  EXPECT_LT(flight.fly(600), 3);
  EXPECT_EQ(flight.plan.done, 1);
}

TEST_P(BothPolicies, LookNoMoreOnceThePoseHasDriftedTooFar) {
  PamsConfig config = never_enough(GetParam());
  config.drift_m = 1;
  config.most_drift_m = 0.5;
  PamsFlight flight(config, {car(20, 5)});
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_LE(flight.flown.size(), 1U);
}

TEST_P(BothPolicies, FlyToNoMoreViewpointsOfATargetThanTheyMay) {
  PamsConfig config = never_enough(GetParam());
  config.most_views = 2;
  PamsFlight flight(config, {car(20, 5)});
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_LE(flight.goals.size(), 2U);
  EXPECT_EQ(flight.plan.done, 1);
}

TEST_P(BothPolicies, MapATargetThatIsAddedOnTheWay) {
  PamsFlight flight(GetParam(), {car(20, 5)});
  const std::vector<Cuboid> both = {car(20, 5), car(35, 5)};
  flight.map(both);
  flight.decide();
  flight.tour.target_list().add(vehicle(1, both[1]), true);
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.plan.done, 2);
}

TEST_P(BothPolicies, LeaveATargetThatIsDismissed) {
  PamsFlight flight(GetParam(), {car(20, 5)});
  flight.map({car(20, 5)});
  ASSERT_TRUE(flight.decide().goal);
  flight.tour.target_list().dismiss(0, "nothing there");
  EXPECT_EQ(flight.decide().status, ActiveStatus::finished);
}

TEST(Paper, FliesNowhereElseThanToTheRegion) {
  ViewModel nowhere = oblique_model();
  nowhere.in_region = [](objects::ClassId, const uncertainty::View&) { return false; };
  PamsFlight flight(PamsConfig::paper(), {car(20, 5)}, everywhere, nowhere);
  EXPECT_EQ(flight.fly(5), 0);
  EXPECT_TRUE(flight.goals.empty());
}

TEST(Saker, GoesBeyondTheRegionWhereNothingInItCanBeReached) {
  ViewModel nowhere = oblique_model();
  nowhere.in_region = [](objects::ClassId, const uncertainty::View&) { return false; };
  PamsFlight flight(PamsConfig::saker(), {car(20, 5)}, everywhere, nowhere);
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.plan.done, 1);
}

TEST(Paper, KeepsTheGoalUntilItIsSeenFromThere) {
  PamsFlight flight(PamsConfig::paper(), {car(30, 0)});
  const int goal = flight.decide().goal->id;
  for (int step = 0; step < 5; ++step) {
    flight.body.y() += 2;  // towards other samples
    EXPECT_EQ(flight.decide().goal->id, goal);
  }
}

TEST(Saker, TakesABetterViewpointWhenOneAppears) {
  PamsConfig config = PamsConfig::saker();
  config.price_per_s = 0.05;
  PamsFlight flight(config, {car(30, 0)});
  const Viewpoint first = *flight.decide().goal;
  flight.body = {60, first.position.y() > 0 ? -20.0 : 20.0, 3};  // a gust, to the other side
  flight.decide();
  EXPECT_NE(flight.plan.goal->id, first.id);
  EXPECT_LT((flight.plan.goal->position - flight.body).norm(),
            (first.position - flight.body).norm());
}

/// The next viewpoint is chosen while the vehicle still comes nearer to this one.
TEST(Saker, TakesWhatIsCommittedForFlown) {
  PamsConfig config = never_enough(PamsConfig::saker());
  config.price_per_s = 0;  // worth the way, however far
  PamsFlight flight(config, {car(30, 0)});
  const Viewpoint first = *flight.decide().goal;
  ActiveStart start{.stamp = flight.input.stamp + from_seconds(1.7)};
  start.T_world_body.translation() = first.position;
  flight.input.start = start;
  flight.decide();
  ASSERT_EQ(flight.flown.size(), 1U);
  EXPECT_EQ(flight.flown[0].viewpoint_id, first.id);
  EXPECT_EQ(flight.flown[0].seen_until, start.stamp);
  EXPECT_TRUE(!flight.plan.goal || flight.plan.goal->id != first.id);
}

TEST(Paper, TakesAViewpointForFlownOnceTheVehicleIsThere) {
  PamsFlight flight(never_enough(PamsConfig::paper()), {car(30, 0)});
  const Viewpoint first = *flight.decide().goal;
  flight.input.start = ActiveStart{};
  flight.input.start->T_world_body.translation() = first.position;
  flight.decide();
  flight.decide();
  EXPECT_TRUE(flight.flown.empty());
}

TEST(Saker, WeighsTheNeighboursThatAViewpointSees) {
  const std::vector<Cuboid> pair = {car(20, 0, pi / 2), car(22.6, 0, pi / 2)};
  PamsConfig both = PamsConfig::saker();
  both.sampling = Sampling::uniform;
  PamsConfig alone = both;
  alone.at_once = 1;
  PamsFlight together(both, pair), one(alone, pair);
  together.decide();
  one.decide();
  ASSERT_TRUE(together.plan.expected && one.plan.expected);
  EXPECT_GT(together.plan.expected->gain, 1.5 * one.plan.expected->gain);
}

TEST_P(BothPolicies, PredictOfAViewpointWhatIsKnownOnceItWasSeenFrom) {
  const std::vector<Cuboid> cars = {car(25, 5, 0.4)};
  const ViewModel model = oblique_model();
  const ActiveConfig config;
  const TargetList targets(config.targets, kTable, map_of(cars));
  PamsConfig pams = never_enough(GetParam());
  pams.price_per_s = std::min(pams.price_per_s, 0.05);
  pams.dwell_s = pams.window_s = 1.5;  // more than a decision: one on the way counts for no cell
  PamsFlight flight(pams, cars);
  ViewHistory views(36, 0.5);
  Target target = targets[0];
  target.extent = cars[0];
  double flown_m = 0;
  for (int step = 0; step < 60 && flight.flown.empty(); ++step) {
    const Eigen::Vector3d before = flight.body;
    flight.fly(1);
    flown_m += (flight.body - before).norm();
    if (in_field_of_view(before, 0, target.extent, config.view, 0)) {
      views.add(before, target.place(), 1, flown_m);
    }
  }
  ASSERT_FALSE(flight.flown.empty());
  const Knowledge known(target, views, model, pams);
  Eigen::Matrix4d after = known.belief().covariance();
  if (!GetParam().common_counts) after += model.common(target.class_id);
  const Eigen::Matrix4d predicted = flight.flown.front().covariance;
  EXPECT_NEAR(0.5 * std::log(predicted.determinant() / after.determinant()), 0, 0.4);
}

TEST(Saker, FliesLessWhenASecondCostsMore) {
  PamsConfig dear = never_enough(PamsConfig::saker()), cheap = dear;
  dear.price_per_s = 0.3;
  cheap.price_per_s = 0.01;
  PamsFlight short_one(dear, kStreet), long_one(cheap, kStreet);
  EXPECT_LT(short_one.fly(1000) + 20, long_one.fly(1000));
  EXPECT_EQ(short_one.plan.done, 4);
}

TEST(Saker, NeedsNoMoreTimeThanThePaper) {
  PamsFlight paper(PamsConfig::paper(), kStreet), saker(PamsConfig::saker(), kStreet);
  EXPECT_LE(saker.fly(1000), paper.fly(1000));
}

}  // namespace
}  // namespace saker::active
