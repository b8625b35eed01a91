#include "saker/active/views/pams_chooser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "made_model.h"
#include "made_scene.h"

namespace saker::active {
namespace {

using namespace made;
using objects::Cuboid;
using Verdict = ViewChoice::Verdict;

const std::vector<Cuboid> kOne = {car(20, 5, 0.7)};

PamsChooser chooser_with(const PamsConfig& pams, const ViewModel& model = oblique_model(),
                         const InGeofence& in_geofence = everywhere) {
  return {pams, VisitConfig(), sampler(in_geofence), model, motion::LimitsConfig()};
}

/// Targets that the map has.
Scene mapped(const ViewChooser& chooser, const std::vector<Cuboid>& cars) {
  Scene scene(chooser, cars);
  scene.have(cars);
  return scene;
}

class BothChoosers : public testing::TestWithParam<PamsConfig> {
 protected:
  PamsChooser chooser_ = chooser_with(GetParam());
};

INSTANTIATE_TEST_SUITE_P(PamsChooser, BothChoosers,
                         testing::Values(PamsConfig::paper(), PamsConfig::saker()),
                         [](const auto& one) { return one.index == 0 ? "paper" : "saker"; });

TEST_P(BothChoosers, SearchATargetThatIsNotMappedAsTheBaselineDoes) {
  VisitConfig search;
  search.sides = GetParam().search.sides;
  const VisitChooser visit(search, sampler());
  const Scene scene(chooser_, kOne);
  const ViewChoice choice = chooser_.choose(scene, 0);
  EXPECT_EQ(choice.viewpoint.id, visit.choose(scene, 0).viewpoint.id);
  EXPECT_FALSE(choice.expected);
}

TEST_P(BothChoosers, ChooseAViewOfTheRegionAndSayWhatIsExpectedOfIt) {
  const Scene scene = mapped(chooser_, kOne);
  const ViewChoice choice = chooser_.choose(scene, 0);
  ASSERT_EQ(choice.verdict, Verdict::fly);
  EXPECT_GT(std::abs(std::sin(2 * (choice.viewpoint.bearing - 0.7))), 0.76);
  ASSERT_TRUE(choice.expected);
  EXPECT_EQ(choice.expected->viewpoint_id, choice.viewpoint.id);
  EXPECT_GT(choice.expected->gain, 0);
}

TEST_P(BothChoosers, KeepTheGoalOfTheSameScene) {
  Scene scene = mapped(chooser_, kOne);
  scene.fly_to(0, chooser_.choose(scene, 0));
  EXPECT_EQ(chooser_.choose(scene, 0).verdict, Verdict::keep_goal);
}

TEST_P(BothChoosers, WeighAGoalOfTheSearchAnewOnceTheTargetIsMapped) {
  Scene scene(chooser_, kOne);
  scene.fly_to(0, chooser_.choose(scene, 0));
  scene.have(kOne);
  EXPECT_EQ(chooser_.choose(scene, 0).verdict, Verdict::fly);
}

TEST_P(BothChoosers, GoNowhereOnceTheTargetIsKnownWellEnough) {
  PamsConfig config = GetParam();
  config.enough_entropy = 10;
  config.most_size_sd_m = 10;
  const PamsChooser chooser = chooser_with(config);
  const Scene scene = mapped(chooser, kOne);
  const ViewChoice choice = chooser.choose(scene, 0);
  EXPECT_EQ(choice.verdict, Verdict::none);
  EXPECT_TRUE(choice.well_known);
  EXPECT_EQ(chooser.why_none(scene, 0, choice), "known well enough");
}

TEST_P(BothChoosers, GoNowhereAfterAsManyViewpointsAsMayBe) {
  Scene scene = mapped(chooser_, kOne);
  scene.records[0].goals = GetParam().most_views;
  const ViewChoice choice = chooser_.choose(scene, 0);
  EXPECT_EQ(choice.verdict, Verdict::none);
  EXPECT_EQ(chooser_.why_none(scene, 0, choice), "as many viewpoints were flown to as may be");
}

TEST_P(BothChoosers, RefuseWhatWasGivenUpAndWhatIsEnclosed) {
  Scene scene = mapped(chooser_, kOne);
  const ViewChoice first = chooser_.choose(scene, 0);
  scene.fly_to(0, first);
  scene.states[0].refuse();
  const ViewChoice second = chooser_.choose(scene, 0);
  EXPECT_EQ(candidate_at(second, first.viewpoint.id)->refusal, Refusal::motion);
  auto grid = free_grid(40);
  fill(grid, {6, -40, -1}, {6.5, 40, 7});
  scene.block = {&grid, SE3::Identity()};
  scene.reachability = Reachability(scene.block, scene.vehicle.position(), 0.9, everywhere);
  const ViewChoice walled = chooser_.choose(scene, 0);
  EXPECT_EQ(walled.verdict, Verdict::none);
  EXPECT_NE(chooser_.why_none(scene, 0, walled).find("enclosed"), std::string::npos);
}

TEST_P(BothChoosers, CountACellThatIsNewAndTheGoalOnceItsCellWasSeen) {
  Scene scene = mapped(chooser_, kOne);
  const ViewChoice choice = chooser_.choose(scene, 0);
  scene.fly_to(0, choice);
  scene.fly(choice.viewpoint.position);
  ViewOutcome outcome;
  int seconds = 0;
  for (; seconds < 10 && !outcome.goal_seen; ++seconds) {
    scene.fly(choice.viewpoint.position);
    outcome = scene.see(chooser_, 0);
    EXPECT_EQ(outcome.is_new, outcome.goal_seen) << "one cell";
  }
  EXPECT_TRUE(outcome.goal_seen);
  EXPECT_EQ(seconds, std::ceil(GetParam().dwell_s));
  EXPECT_EQ(scene.records[0].cells, 1);
  EXPECT_EQ(chooser_.seen_from(scene, 0), "seen from 1 cells");
}

TEST_P(BothChoosers, HaveNoMemory) {
  Scene scene = mapped(chooser_, kOne);
  const ViewChoice before = chooser_.choose(scene, 0);
  const Scene other = mapped(chooser_, {car(-30, 10, 1)});
  (void)chooser_.choose(other, 0);
  const ViewChoice after = chooser_.choose(scene, 0);
  EXPECT_EQ(before.viewpoint.position, after.viewpoint.position);
  EXPECT_EQ(before.expected->gain, after.expected->gain);
}

TEST(PamsChooser, OfThePaperReopensNothing) {
  const PamsChooser paper = chooser_with(PamsConfig::paper());
  Scene scene = mapped(paper, kOne);
  EXPECT_FALSE(paper.reopens(scene, 0));
  scene.have(objects::ObjectMap());
  EXPECT_FALSE(paper.reopens(scene, 0));
}

TEST(PamsChooser, OfSakerReopensWhatLeftTheMapOrIsKnownTooBadlyThere) {
  const PamsChooser saker = chooser_with(PamsConfig::saker());
  Scene scene(saker, kOne);
  objects::ObjectMap map = map_of(kOne);
  map.objects[0].covariance = 1e-4 * Matrix9d::Identity();
  scene.have(map);
  EXPECT_FALSE(saker.reopens(scene, 0));
  map.objects[0].covariance(6, 6) = 0.25;
  scene.have(map);
  EXPECT_TRUE(saker.reopens(scene, 0));
  scene.have(objects::ObjectMap());
  EXPECT_TRUE(saker.reopens(scene, 0));
  scene.targets.dismiss(0, "not there");
  EXPECT_FALSE(saker.reopens(scene, 0));
}

TEST(PamsChooser, OnlySakerDecidesFromWhereTheDecisionBegins) {
  EXPECT_FALSE(chooser_with(PamsConfig::paper()).decides_from_start());
  EXPECT_TRUE(chooser_with(PamsConfig::saker()).decides_from_start());
}

}  // namespace
}  // namespace saker::active
