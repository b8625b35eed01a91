#include "saker/active/views/visit_chooser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "made_scene.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;
using std::numbers::pi;
using Verdict = ViewChoice::Verdict;

const std::vector<Cuboid> kOne = {car(20, 0)};

VisitConfig sides(int count, double oblique_worth_m = 0) {
  VisitConfig config;
  config.sides = count;
  config.oblique_worth_m = oblique_worth_m;
  return config;
}

TEST(VisitChooser, TakesTheNearestViewpoint) {
  const VisitChooser chooser({}, sampler());
  const Scene scene(chooser, kOne);
  const ViewChoice choice = chooser.choose(scene, 0);
  ASSERT_EQ(choice.verdict, Verdict::fly);
  for (const ViewpointCandidate& candidate : choice.candidates) {
    if (candidate.refusal != Refusal::none) continue;
    EXPECT_GE(candidate.cost_m + 1e-9, choice.viewpoint.position.head<2>().norm());
  }
  EXPECT_FALSE(choice.expected) << "it has no model";
}

TEST(VisitChooser, TakesTheWayToTheNextTargetForTheLastSide) {
  const std::vector<Cuboid> two = {car(20, 0), car(20, 60)};
  const VisitChooser last(sides(1), sampler()), first(sides(2), sampler());
  const Scene before_last(last, two), before_first(first, two);
  EXPECT_GT(last.choose(before_last, 0).viewpoint.position.y(), 3) << "towards the next";
  EXPECT_LT(std::abs(first.choose(before_first, 0).viewpoint.position.y()), 3);
}

TEST(VisitChooser, FliesADetourForAnObliqueViewOfAMappedVehicleAlone) {
  const VisitChooser chooser(sides(2, 10), sampler());
  Scene scene(chooser, kOne);
  EXPECT_LT(std::abs(chooser.choose(scene, 0).viewpoint.position.y()), 3);
  scene.have(kOne);
  const double bearing = chooser.choose(scene, 0).viewpoint.bearing;
  EXPECT_GT(std::abs(std::sin(2 * bearing)), 0.8);
}

TEST(VisitChooser, RefusesWhatWasGivenUpAndWhatIsBesideIt) {
  const VisitChooser chooser({}, sampler());
  Scene scene(chooser, kOne);
  const ViewChoice first = chooser.choose(scene, 0);
  scene.fly_to(0, first);
  scene.states[0].refuse();
  const ViewChoice second = chooser.choose(scene, 0);
  EXPECT_EQ(candidate_at(second, first.viewpoint.id)->refusal, Refusal::motion);
  EXPECT_GE((second.viewpoint.position - first.viewpoint.position).norm(), 3);
}

TEST(VisitChooser, KeepsTheGoalUntilAnotherIsBetterByAMargin) {
  const VisitChooser chooser({}, sampler());
  Scene scene(chooser, kOne);
  const ViewChoice first = chooser.choose(scene, 0);
  scene.fly_to(0, first);
  scene.fly({0, 4, 3});
  EXPECT_EQ(chooser.choose(scene, 0).verdict, Verdict::keep_goal);
  scene.fly({40, 1, 3});
  const ViewChoice other = chooser.choose(scene, 0);
  EXPECT_EQ(other.verdict, Verdict::fly);
  EXPECT_NE(other.viewpoint.id, first.viewpoint.id);
}

TEST(VisitChooser, ATargetIsDoneOnceAllOfItsSidesWereSeen) {
  const VisitChooser chooser(sides(2), sampler());
  Scene scene(chooser, kOne);
  const auto see_from = [&](const Eigen::Vector3d& place) {
    ViewOutcome outcome;
    for (int second = 0; second < 3; ++second) {
      scene.fly(place);
      EXPECT_FALSE(outcome.is_new) << "after " << second << " s";
      outcome = scene.see(chooser, 0);
    }
    return outcome;
  };
  scene.fly({12, 0, 3});
  const ViewOutcome one = see_from({12, 0, 3});
  EXPECT_TRUE(one.is_new);
  EXPECT_FALSE(one.target_done);
  EXPECT_EQ(chooser.seen_from(scene, 0), "seen from 1 of 2 sides");
  const ViewOutcome two = see_from({28, 0, 3});
  EXPECT_TRUE(two.is_new);
  EXPECT_TRUE(two.target_done);
}

TEST(VisitChooser, NeverGoesToASideThatWasSeen) {
  const VisitChooser chooser(sides(2), sampler());
  Scene scene(chooser, kOne);
  scene.records[0].sides.add(pi, 10);
  const ViewChoice choice = chooser.choose(scene, 0);
  EXPECT_GE(std::abs(std::remainder(choice.viewpoint.bearing - pi, 2 * pi)), 119.9 * pi / 180);
  EXPECT_TRUE(std::ranges::any_of(choice.candidates, [](const ViewpointCandidate& candidate) {
    return candidate.refusal == Refusal::seen;
  }));
}

TEST(VisitChooser, LooksBetweenSidesWhereAnEndIsMissingAndNoOtherSideIsLeft) {
  VisitConfig config = sides(2);
  config.between = true;
  const VisitChooser chooser(config, sampler());
  Scene scene(chooser, kOne);
  scene.records[0].sides.add(0, 10);
  scene.records[0].sides.add(2 * pi / 3, 10);
  scene.records[0].sides.add(-2 * pi / 3, 10);
  EXPECT_EQ(chooser.choose(scene, 0).verdict, Verdict::none) << "its end is not known to miss";
  objects::ObjectMap map;
  map.incomplete = {vehicle(3, kOne[0])};
  scene.have(map);
  const ViewChoice choice = chooser.choose(scene, 0);
  EXPECT_EQ(choice.verdict, Verdict::fly);
  EXPECT_TRUE(choice.between_sides);
}

TEST(VisitChooser, SaysWhyThereIsNone) {
  const VisitChooser chooser({}, sampler([](const Eigen::Vector3d&) { return false; }));
  const Scene scene(chooser, kOne);
  const ViewChoice choice = chooser.choose(scene, 0);
  EXPECT_EQ(choice.verdict, Verdict::none);
  EXPECT_NE(chooser.why_none(scene, 0, choice).find("72 outside the geofence"), std::string::npos)
      << chooser.why_none(scene, 0, choice);
  EXPECT_EQ(chooser.seen_from(scene, 0), "");
}

TEST(VisitChooser, HasNoMemory) {
  const VisitChooser chooser(sides(2, 10), sampler());
  Scene scene(chooser, kOne);
  const ViewChoice before = chooser.choose(scene, 0);
  Scene other(chooser, {car(-30, 10, 1)});
  (void)chooser.choose(other, 0);
  const ViewChoice after = chooser.choose(scene, 0);
  EXPECT_EQ(before.viewpoint.id, after.viewpoint.id);
  EXPECT_EQ(before.viewpoint.position, after.viewpoint.position);
}

}  // namespace
}  // namespace saker::active
