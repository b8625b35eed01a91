#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "flight/executive/plan_report.h"

/// Viewpoints as PLAN says them.
namespace saker::flight {
namespace {

active::ViewpointCandidate candidate(int id, active::Refusal refusal) {
  active::ViewpointCandidate made;
  made.viewpoint.id = id;
  made.viewpoint.target_id = 4;
  made.viewpoint.position = Eigen::Vector3d(id, 2, 3);
  made.viewpoint.yaw = 0.5;
  made.gain = 1.25;
  made.cost_m = 6;
  made.refusal = refusal;
  return made;
}

active::ActivePlan plan_of(int open, int refused, int goal = -1) {
  active::ActivePlan plan;
  for (int i = 0; i < refused; ++i)
    plan.candidates.push_back(candidate(100 + i, active::Refusal::hidden));
  for (int i = 0; i < open; ++i) plan.candidates.push_back(candidate(i, active::Refusal::none));
  if (goal >= 0) plan.goal = candidate(goal, active::Refusal::none).viewpoint;
  return plan;
}

plan_t written(const active::ActivePlan& plan) {
  plan_t message{};
  write_candidates(plan, message);
  EXPECT_EQ(message.num_candidates, static_cast<int>(message.candidates.size()));
  EXPECT_LE(message.num_candidates, plan_t::MAX_CANDIDATES);
  return message;
}

TEST(PlanReport, WhatMayBeFlownToStandsFirstWithItsGain) {
  const plan_t message = written(plan_of(3, 5, 1));
  ASSERT_EQ(message.num_candidates, 8);
  EXPECT_EQ(message.choice, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(message.candidates[i].position[0], static_cast<float>(i));
    EXPECT_EQ(message.candidates[i].gain, 1.25f);
    EXPECT_EQ(message.candidates[i].path_m, 6.0f);
  }
}

TEST(PlanReport, OfARefusedOneTheGainIsTheReasonsPlaceNegative) {
  active::ActivePlan plan;
  for (int reason = 1; reason <= 9; ++reason)
    plan.candidates.push_back(candidate(reason, static_cast<active::Refusal>(reason)));
  const plan_t message = written(plan);
  ASSERT_EQ(message.num_candidates, 9);
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(message.candidates[i].gain, static_cast<float>(-(i + 1)));
    EXPECT_TRUE(std::isnan(message.candidates[i].path_m));
  }
}

TEST(PlanReport, OfManyRefusedOnesThoseThatFitAreEvenlyChosen) {
  const plan_t message = written(plan_of(4, 72));
  ASSERT_EQ(message.num_candidates, plan_t::MAX_CANDIDATES);
  std::set<float> places;
  for (const candidate_t& said : message.candidates) places.insert(said.position[0]);
  EXPECT_EQ(places.size(), message.candidates.size());
  for (int i = 5; i < message.num_candidates; ++i) {
    const float step = message.candidates[i].position[0] - message.candidates[i - 1].position[0];
    EXPECT_GE(step, 3);  // 72 places of which 24 are taken
    EXPECT_LE(step, 3);
  }
}

TEST(PlanReport, WhereAllMayBeFlownToNoRefusedOneTakesTheirPlace) {
  const plan_t message = written(plan_of(40, 10));
  for (const candidate_t& said : message.candidates) EXPECT_EQ(said.gain, 1.25f);
}

TEST(PlanReport, TheChosenOneKeepsItsGainThoughSomethingSpeaksAgainstIt) {
  active::ActivePlan plan = plan_of(0, 3, 101);
  const plan_t message = written(plan);
  EXPECT_EQ(message.choice, 0);
  EXPECT_EQ(message.candidates[0].position[0], 101.0f);
  EXPECT_EQ(message.candidates[0].gain, 1.25f);
}

TEST(PlanReport, WithoutAGoalNothingIsChosen) { EXPECT_EQ(written(plan_of(2, 2)).choice, -1); }

}  // namespace
}  // namespace saker::flight
