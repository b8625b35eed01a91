#include "saker/active/tour/target_state.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "saker/core/rng.h"

namespace saker::active {
namespace {

using Phase = TargetState::Phase;
using Eigen::Vector3d;

const GoalLimits kLimits{.patience_s = 10,
                         .standing_s = 5,
                         .progress_m = 0.5,
                         .refused_m = 3,
                         .most_refusals = 2,
                         .most_goals = 3,
                         .attempts = 2,
                         .arrived_m = 1.5,
                         .dwell_s = 3};
const Vector3d kGoal(20, 0, 3), kFar(0, 0, 3);

Viewpoint viewpoint(const Vector3d& place = kGoal) {
  Viewpoint viewpoint;
  viewpoint.id = 7;
  viewpoint.position = place;
  return viewpoint;
}

enum class Event { fly_to, progress, stall, stand, dwell, refuse, give_up, leave, see_new };

Phase after(TargetState& state, Event event) {
  switch (event) {
    case Event::fly_to:
      return state.fly_to(viewpoint(), kFar);
    case Event::progress:
      return state.update({5, 0, 3}, 1, false);
    case Event::stall:
      return state.update(kFar, 10.1, false);
    case Event::stand:
      return state.update(kFar, 5.1, true);
    case Event::dwell:
      return state.update(kGoal, 3.1, true);
    case Event::refuse:
      return state.refuse();
    case Event::give_up:
      return state.give_up();
    case Event::leave:
      state.leave();
      break;
    case Event::see_new:
      state.see_new();
      break;
  }
  return state.phase();
}

TargetState in(Phase phase) {
  static const std::map<Phase, std::vector<Event>> kWays = {
      {Phase::waiting, {}},
      {Phase::approaching, {Event::fly_to}},
      {Phase::reached, {Event::fly_to, Event::dwell}},
      {Phase::put_off, {Event::give_up}},
      {Phase::exhausted, {Event::give_up, Event::give_up}}};
  TargetState state(kLimits);
  for (const Event event : kWays.at(phase)) after(state, event);
  EXPECT_EQ(state.phase(), phase);
  return state;
}

/// Each phase with each event: fly_to, progress, stall, stand, dwell, refuse, give_up, leave,
/// see_new.
TEST(TargetState, GoesFromPhaseToPhaseByTheTable) {
  using enum Phase;
  const std::map<Phase, std::vector<Phase>> table = {
      {waiting,
       {approaching, waiting, waiting, waiting, waiting, waiting, put_off, waiting, waiting}},
      {approaching,
       {approaching, approaching, waiting, waiting, reached, waiting, put_off, waiting,
        approaching}},
      {reached, std::vector<Phase>(9, reached)},
      {put_off,
       {approaching, put_off, put_off, put_off, put_off, put_off, exhausted, put_off, put_off}},
      {exhausted, std::vector<Phase>(9, exhausted)}};
  for (const auto& [phase, row] : table) {
    for (std::size_t event = 0; event < row.size(); ++event) {
      TargetState state = in(phase);
      EXPECT_EQ(after(state, static_cast<Event>(event)), row[event])
          << "phase " << static_cast<int>(phase) << ", event " << event;
      EXPECT_EQ(state.goal().has_value(), state.phase() == approaching);
    }
  }
}

TEST(TargetState, IsPutOffAfterTooManyRefusals) {
  TargetState state(kLimits);
  state.fly_to(viewpoint(), kFar);
  EXPECT_EQ(state.refuse(), Phase::waiting);
  state.fly_to(viewpoint(), kFar);
  EXPECT_EQ(state.refuse(), Phase::put_off);
  EXPECT_EQ(state.attempts(), 1);
}

TEST(TargetState, IsPutOffAfterTooManyViewpointsInVain) {
  TargetState state(kLimits);
  for (int i = 0; i < kLimits.most_goals; ++i) {
    EXPECT_EQ(state.fly_to(viewpoint(), kFar), Phase::approaching);
  }
  EXPECT_EQ(state.fly_to(viewpoint(), kFar), Phase::put_off);
}

TEST(TargetState, ANewViewIsNotInVain) {
  TargetState state(kLimits);
  for (int i = 0; i < 10 * kLimits.most_goals; ++i) {
    EXPECT_EQ(state.fly_to(viewpoint(), kFar), Phase::approaching);
    state.see_new();
  }
}

TEST(TargetState, PatienceBeginsAnewWithProgressAndWithANewView) {
  TargetState state(kLimits);
  state.fly_to(viewpoint(), kFar);
  for (double x = 0; x < 15; x += 0.6)
    EXPECT_EQ(state.update({x, 0, 3}, 9, false), Phase::approaching);
  for (int i = 0; i < 10; ++i) {
    state.see_new();
    EXPECT_EQ(state.update({14, 0, 3}, 9, false), Phase::approaching);
  }
  EXPECT_EQ(state.update({14, 0, 3}, 9, false), Phase::waiting);
  EXPECT_NEAR(state.closest_m(), 20 - 14.4, 0.61);
}

TEST(TargetState, LessThanAStepNearerIsNoProgress) {
  TargetState state(kLimits);
  state.fly_to(viewpoint(), kFar);
  EXPECT_EQ(state.update({0.4, 0, 3}, 6, false), Phase::approaching);
  EXPECT_EQ(state.update({0.4, 0, 3}, 6, false), Phase::waiting);
  EXPECT_EQ(state.closest_m(), 20);
}

TEST(TargetState, StandingBeginsAnewWithAMove) {
  TargetState state(kLimits);
  state.fly_to(viewpoint(), kFar);
  EXPECT_EQ(state.update(kFar, 4, true), Phase::approaching);
  EXPECT_EQ(state.update(kFar, 1, false), Phase::approaching);
  EXPECT_EQ(state.update(kFar, 4, true), Phase::approaching);
}

TEST(TargetState, DwellAddsUpAtTheViewpointAlone) {
  TargetState state(kLimits);
  state.fly_to(viewpoint(), kFar);
  EXPECT_EQ(state.update({18, 0, 3}, 3.1, false), Phase::approaching);
  EXPECT_EQ(state.update({19, 0, 3}, 2, false), Phase::approaching);
  EXPECT_EQ(state.update({19, 0, 3}, 2, false), Phase::reached);
}

TEST(TargetState, RemembersWhatItGaveUpUntilTheAttemptEnds) {
  TargetState state(kLimits);
  EXPECT_FALSE(state.gave_up(kGoal));
  state.fly_to(viewpoint(), kFar);
  state.refuse();
  EXPECT_TRUE(state.gave_up(kGoal + Vector3d(2.9, 0, 0)));
  EXPECT_FALSE(state.gave_up(kGoal + Vector3d(3.1, 0, 0)));
  state.give_up();
  EXPECT_FALSE(state.gave_up(kGoal));
}

TEST(TargetState, LeavesAViewpointWithoutGivingItUp) {
  TargetState state(kLimits);
  state.fly_to(viewpoint(), kFar);
  state.leave();
  EXPECT_FALSE(state.gave_up(kGoal));
  EXPECT_EQ(state.attempts(), 0);
}

TEST(TargetState, EndsWhateverHappensWithoutANewView) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    core::Rng rng(seed);
    TargetState state(kLimits);
    int events = 0;
    for (; events < 1000 && !state.ended(); ++events) {
      if (state.phase() != Phase::approaching) {
        state.fly_to(viewpoint(), kFar);
      } else if (rng.chance(0.1)) {
        state.refuse();
      } else {
        state.update({20 * rng.uniform(), 0, 3}, 1, rng.chance(0.5));
      }
    }
    EXPECT_LT(events, 1000) << "seed " << seed;
  }
}

}  // namespace
}  // namespace saker::active
