#include "saker/active/views/viewpoint_sampler.h"

#include <gtest/gtest.h>

#include "made_scene.h"

namespace saker::active {
namespace {

using namespace made;

const TargetList kTargets({}, {}, map_of({car(20, 5), car(40, -4)}));

TEST(ViewpointSampler, GivesEachTargetIdsOfItsOwn) {
  const std::vector<ViewpointCandidate> first = sampler().around(kTargets[0], 0, {});
  const std::vector<ViewpointCandidate> second = sampler().around(kTargets[1], 1, {});
  EXPECT_EQ(first.front().viewpoint.id, 0);
  EXPECT_EQ(first.back().viewpoint.id + 1, second.front().viewpoint.id);
  EXPECT_EQ(second.front().viewpoint.target_id, kTargets[1].id);
}

/// An estimate that moves by a few decimetres makes a new lattice; the goal stays.
TEST(ViewpointSampler, AGoalStaysGoodWhileItsTargetTrembles) {
  Target target = kTargets[0];
  const Viewpoint goal = sampler().around(target, 0, {}).front().viewpoint;
  const double half_deg = FieldOfViewConfig().margin_deg / 2;
  target.extent.pose.translation() += 0.1 * (goal.position - target.place()).normalized();
  EXPECT_FALSE(sampler().sees(goal.position, goal.yaw, target, {}, 2 * half_deg));
  EXPECT_EQ(sampler().goal(goal, target, {}).refusal, Refusal::none);
  target.extent.pose.translation() += 2 * (goal.position - target.place()).normalized();
  EXPECT_EQ(sampler().goal(goal, target, {}).refusal, Refusal::out_of_view);
}

TEST(ViewpointSampler, SeesWhatIsInTheFieldOfViewAndNotHidden) {
  auto grid = free_grid();
  const OccupancyView block{&grid, SE3::Identity()};
  const Eigen::Vector3d eye(10, 5, 3);
  EXPECT_TRUE(sampler().sees(eye, 0, kTargets[0], block, 0));
  EXPECT_FALSE(sampler().sees({-10, 5, 3}, 0, kTargets[0], block, 0)) << "too far";
  fill(grid, {13, -5, 0}, {13.5, 15, 7});
  EXPECT_FALSE(sampler().sees(eye, 0, kTargets[0], block, 0));
}

TEST(ViewpointSampler, CountsRefusals) {
  std::vector<ViewpointCandidate> candidates(5);
  for (ViewpointCandidate& candidate : candidates) candidate.refusal = Refusal::hidden;
  candidates[3].refusal = Refusal::occupied;
  EXPECT_EQ(count_refusals(candidates), "no viewpoint left: 1 occupied, 4 hidden");
  candidates[0].refusal = Refusal::none;
  EXPECT_EQ(count_refusals(candidates), "too many viewpoints were flown to in vain");
  EXPECT_EQ(count_refusals({}), "no viewpoint left:");
}

}  // namespace
}  // namespace saker::active
