#include <gtest/gtest.h>

#include "flight_viewers/made_robot.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

std::vector<int> ids(const Json& objects_message) {
  std::vector<int> found;
  for (const Json& object : objects_message.at("objects")) found.push_back(object.at("id"));
  return found;
}

TEST(RobotView, KeepsTheWholeMapOfWhatIsSaidInTurns) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(1, 0, 0)}), 1);
  view.hear(made_objects({made_vehicle(2, 9, 0), made_pole(5, 1, 1)}), 2);
  const Json said = *view.message(Topic::objects, 4);
  EXPECT_EQ(ids(said), (std::vector{1, 2, 5}));
  EXPECT_EQ(said.at("objects")[0].at("heard_s"), 3);
  EXPECT_EQ(said.at("objects")[1].at("heard_s"), 2);
}

TEST(RobotView, AnObjectThatIsGoneIsGone) {
  RobotView view = made_view();
  view.hear(made_objects({made_vehicle(1, 0, 0), made_vehicle(2, 9, 0)}), 1);
  object_map_t farewell = made_objects({made_vehicle(1, 0, 0)});
  farewell.objects[0].observations = 0;
  EXPECT_TRUE(view.hear(farewell, 2));
  EXPECT_EQ(ids(*view.message(Topic::objects, 2)), std::vector{2});
}

TEST(RobotView, WhatIsNoObjectIsRefusedAndTheOthersStay) {
  RobotView view = made_view();
  object_map_t message = made_objects({made_vehicle(1, 0, 0), made_vehicle(2, 9, 0)});
  message.objects[0].orientation[3] = 7;
  EXPECT_FALSE(view.hear(message, 1));
  EXPECT_EQ(ids(*view.message(Topic::objects, 1)), std::vector{2});
}

TEST(RobotView, SaysATopicNoFasterThanItsRate) {
  RobotView view = made_view();
  int said = 0;
  for (int i = 0; i < 200; ++i) {  // 2 s at 100 Hz, looked at as often
    view.hear(made_odometry(10000 * i, 0.01 * i, 0), 0.01 * i);
    said += static_cast<int>(of_topic(view.take_due(0.01 * i, none), Topic::odometry).size());
  }
  EXPECT_GE(said, 18);
  EXPECT_LE(said, 23);
}

TEST(RobotView, WhatNobodyWantsIsNotMadeButKeptTopicsAre) {
  RobotView view = made_view();
  view.hear(made_odometry(1, 0, 0), 1);
  const auto said = view.take_due(1, none);
  EXPECT_TRUE(of_topic(said, Topic::scene).empty());
  EXPECT_TRUE(of_topic(said, Topic::transforms).empty());
  EXPECT_EQ(of_topic(said, Topic::odometry).size(), 1u);
  EXPECT_EQ(of_topic(view.take_due(1.01, all), Topic::transforms).size(), 1u);
}

TEST(RobotView, EveryTransitionOfTheMissionIsSaidAndLoggedOnce) {
  RobotView view = made_view();
  view.hear(made_mission("tour", autonomy::Cause::took_off, "3 m"), 1);
  view.hear(made_mission("tour", autonomy::Cause::took_off, "3 m"), 2);
  view.hear(made_mission("hold", autonomy::Cause::lidar_silent, "no scan"), 3);
  const auto said = view.take_due(3, none);
  EXPECT_EQ(of_topic(said, Topic::mission).size(), 3u);
  const auto log = of_topic(said, Topic::log);
  ASSERT_EQ(log.size(), 2u);
  EXPECT_EQ(log[0].at("level"), static_cast<int>(LogLevel::info));
  EXPECT_EQ(log[1].at("level"), static_cast<int>(LogLevel::warning));
}

std::string state_of(const RobotView& view, int target) {
  return view.state().targets.at(target).state;
}

TEST(RobotView, TargetsArePlannedThenNextThenLeft) {
  RobotView view = made_view();
  view.hear(made_plan({4, 7, 9}, 1), 1);
  EXPECT_EQ(state_of(view, 4), "next");
  EXPECT_EQ(state_of(view, 9), "planned");
  EXPECT_EQ(view.state().targets.at(9).tour, 2);
  view.hear(made_plan({7, 9}, 2), 2);
  EXPECT_EQ(state_of(view, 4), "left");
  EXPECT_EQ(state_of(view, 7), "next");
  view.hear(made_plan({}, 2), 3);  // while it holds nothing is planned
  EXPECT_EQ(state_of(view, 9), "planned");
  view.hear(made_mission("return", autonomy::Cause::tour_complete, ""), 4);
  EXPECT_EQ(state_of(view, 9), "left");
}

TEST(RobotView, GainCountsOncePerCommittedTrajectory) {
  RobotView view = made_view();
  view.hear(made_plan({4}, 1), 1);
  view.hear(made_plan({4}, 1), 2);
  view.hear(made_plan({4}, 2), 3);
  EXPECT_DOUBLE_EQ(view.state().gain_nat, 3);
}

TEST(RobotView, AClockThatBeginsAnewIsANewFlight) {
  RobotView view = made_view();
  view.hear(made_odometry(60000000, 1, 1), 60);
  view.hear(made_objects({made_vehicle(1, 0, 0)}), 60);
  view.hear(made_odometry(1000, 0, 0), 61);
  EXPECT_TRUE(view.state().objects.empty());
  EXPECT_EQ(view.state().path.points().size(), 1u);
  EXPECT_TRUE(view.state().heard.contains("OBJECTS"));  // the link was there before
}

TEST(RobotView, ALostLinkIsSaidAtOnceAndWhenItIsBack) {
  RobotView view = made_view(made_site(), 1.5);
  view.hear(made_state(), 10);
  EXPECT_EQ(of_topic(view.take_due(10.1, none), Topic::link).at(0).at("lost"), false);
  EXPECT_TRUE(of_topic(view.take_due(10.2, none), Topic::link).empty());
  const auto lost = view.take_due(11.6, none);
  EXPECT_EQ(of_topic(lost, Topic::link).at(0).at("lost"), true);
  EXPECT_EQ(of_topic(lost, Topic::log).at(0).at("level"), static_cast<int>(LogLevel::error));
  view.hear(made_state(), 11.65);
  const auto back = view.take_due(11.7, none);
  EXPECT_EQ(of_topic(back, Topic::link).at(0).at("lost"), false);
  EXPECT_EQ(of_topic(back, Topic::log).size(), 1u);
}

TEST(RobotView, AfterAJumpAllThatIsKnownIsSaidAgain) {
  RobotView view = made_view();
  view.hear(made_state(), 5);
  view.hear(made_mission("tour", autonomy::Cause::took_off, ""), 5);
  static_cast<void>(view.take_due(5, none));
  EXPECT_TRUE(view.take_due(5.05, none).empty());
  view.say_again();
  const auto again = view.take_due(2, none);  // time may go back
  EXPECT_EQ(of_topic(again, Topic::state).size(), 1u);
  EXPECT_EQ(of_topic(again, Topic::mission).size(), 1u);
}

TEST(RobotView, NoMessageOfNonsenseIsTaken) {
  RobotView view = made_view();
  odometry_t odometry = made_odometry(1, 0, 0);
  odometry.orientation[3] = 0;
  EXPECT_FALSE(view.hear(odometry, 1));
  vehicle_state_t state = made_state();
  state.mode = 77;
  EXPECT_FALSE(view.hear(state, 1));
  EXPECT_EQ(view.message(Topic::odometry, 1), std::nullopt);
  EXPECT_EQ(view.message(Topic::state, 1), std::nullopt);
}

/// The ground's clock is set back by an hour, then the robot falls silent: that is said in time.
TEST(RobotView, AClockThatIsSetBackHidesNoLostLink) {
  RobotView view = made_view(made_site(), 1.5);
  view.hear(made_state(), 5000);
  view.hear(verdict_t{}, 5000);  // not heard again
  static_cast<void>(view.take_due(5000, none));
  view.hear(made_state(), 1400);
  EXPECT_EQ(of_topic(view.take_due(1400.1, none), Topic::link).at(0).at("lost"), false);
  EXPECT_EQ(of_topic(view.take_due(1401.6, none), Topic::link).at(0).at("lost"), true);
}

TEST(RobotView, AClockThatIsSetBackCountsNoMessagesTwice) {
  RobotView view = made_view(made_site(), 1.5);
  for (int i = 0; i < 100; ++i) view.hear(made_state(), 5000 + 0.01 * i);
  view.hear(made_state(), 1400);
  EXPECT_EQ((*view.message(Topic::link, 1400))["message_rate_hz"], 1);
}

TEST(RobotView, WhatWaitsOfATopicIsBoundedAndTakesNothingFromOthers) {
  RobotView view = made_view();
  view.say_order({{"id", 1}}, 1);
  view.log(LogLevel::info, "first", 1);
  health_t health{};
  health.process = "p";
  for (int i = 0; i < 5000; ++i) {
    health.utime = i;
    view.hear(health, 1);
  }
  const auto said = view.take_due(1, none);
  const auto kept = of_topic(said, Topic::health);
  ASSERT_EQ(kept.size(), 1000u);
  EXPECT_EQ(kept.back().at("utime"), 4999);  // the newest ones
  EXPECT_EQ(of_topic(said, Topic::orders).size(), 1u);
  EXPECT_EQ(of_topic(said, Topic::log).size(), 1u);
}

TEST(RobotView, EventsAreSaidInTheirOrderEachOnce) {
  RobotView view = made_view();
  for (const char* text : {"a", "b", "c"}) view.log(LogLevel::info, text, 1);
  const auto log = of_topic(view.take_due(1, none), Topic::log);
  ASSERT_EQ(log.size(), 3u);
  EXPECT_EQ(log[0].at("message"), "a");
  EXPECT_EQ(log[2].at("message"), "c");
  EXPECT_TRUE(of_topic(view.take_due(2, none), Topic::log).empty());
}

TEST(RobotView, OfARunThereIsNoLinkToLose) {
  RobotView view = made_view();  // for ever
  view.hear(made_state(), 1);
  const auto said = view.take_due(1000, all);
  EXPECT_TRUE(of_topic(said, Topic::link).empty());
  EXPECT_TRUE(of_topic(said, Topic::log).empty());
}

TEST(RobotView, ASiteIsSaidOnce) {
  RobotView view = made_view();
  EXPECT_EQ(of_topic(view.take_due(0, none), Topic::site).size(), 1u);
  EXPECT_TRUE(of_topic(view.take_due(100, none), Topic::site).empty());
}

TEST(RobotView, ACommittedTrajectoryIsSaidWhenItChanges) {
  RobotView view = made_view();
  const auto said = [&](double t) {
    return of_topic(view.take_due(t, none), Topic::trajectory).size();
  };
  view.hear(made_trajectory(4, 50), 1);
  EXPECT_EQ(said(1), 1u);
  view.hear(made_trajectory(4, 50), 2);
  EXPECT_EQ(said(2), 0u);
  view.hear(made_trajectory(5, 50), 3);
  EXPECT_EQ(said(3), 1u);
}

TEST(RobotView, ATrajectoryOfNonsenseIsRefused) {
  RobotView view = made_view();
  trajectory_t message = made_trajectory(4, 3);
  message.states[1].yaw = NAN;
  EXPECT_FALSE(view.hear(message, 1));
  message = made_trajectory(4, 3);
  message.step_s = 0;
  EXPECT_FALSE(view.hear(message, 1));
  EXPECT_EQ(view.message(Topic::trajectory, 1), std::nullopt);
}

TEST(RobotView, APlanOfAChoiceThatIsNotThereChoosesNothing) {
  for (const int choice : {-1, 2, 1000, INT32_MIN}) {
    RobotView view = made_view();
    plan_t plan = made_plan({4, 7}, 1);
    plan.choice = choice;
    view.hear(plan, 1);
    EXPECT_EQ(state_of(view, 4), "planned") << choice;
    EXPECT_EQ(view.state().gain_nat, 0) << choice;
    const Json shown = view.message(Topic::plan, 1).value();
    for (const Json& candidate : shown["candidates"])
      EXPECT_EQ(candidate["chosen"], false) << choice;
  }
}

TEST(RobotView, ARefusedViewpointIsNoCandidateAndSaysWhy) {
  RobotView view = made_view();
  plan_t plan = made_plan({4, 7, 8, 9, 10}, 1);
  plan.candidates[1].gain = -3;
  plan.candidates[2].gain = -9;
  plan.candidates[3].gain = -10;  // of a newer robot
  plan.candidates[4].gain = NAN;
  view.hear(plan, 1);
  const Json shown = view.message(Topic::plan, 1).value();
  ASSERT_EQ(shown["candidates"].size(), 2u);
  EXPECT_EQ(shown["candidates"][1]["target_id"], 10);
  ASSERT_EQ(shown["refused"].size(), 3u);
  EXPECT_EQ(shown["refused"][0]["reason"], "occupied");
  EXPECT_EQ(shown["refused"][1]["reason"], "outside the region");
  EXPECT_EQ(shown["refused"][2]["reason"], "refused");
}

TEST(RobotView, AGainThatIsNotKnownAddsNothing) {
  RobotView view = made_view();
  plan_t plan = made_plan({4}, 1);
  plan.candidates[0].gain = NAN;
  view.hear(plan, 1);
  EXPECT_EQ(view.state().gain_nat, 0);
}

TEST(RobotView, TheMapIsBounded) {
  RobotView view = made_view();
  object_map_t message = made_objects({made_vehicle(0, 0, 0)});
  for (int id = 0; id < 20000; ++id) {
    message.objects[0].id = id;
    ASSERT_TRUE(view.hear(message, 1));
  }
  message.objects[0].id = 20000;
  EXPECT_FALSE(view.hear(message, 1));
  message.objects[0].id = 7;  // one that is there is still said
  EXPECT_TRUE(view.hear(message, 2));
  EXPECT_EQ(view.state().objects.size(), 20000u);
}

TEST(RobotView, AnOlderMessageByAMomentIsTheSameFlight) {
  RobotView view = made_view();
  view.hear(made_odometry(60000000, 1, 1), 60);
  view.hear(made_objects({made_vehicle(1, 0, 0)}), 60);
  view.hear(made_odometry(59500000, 1, 1), 60);
  EXPECT_EQ(view.state().objects.size(), 1u);
}

TEST(RobotView, DetectionsOfAnotherClassTableAreRefused) {
  objects::Detections window;
  const objects::MapObject vehicle = made_vehicle(0, 4, 0);
  window.measurements.push_back({.class_id = vehicle.class_id,
                                 .class_probability = vehicle.class_probability,
                                 .model = vehicle.model,
                                 .covariance = {}});
  detections_t message = to_lcm(window);
  RobotView view = made_view();
  EXPECT_TRUE(view.hear(message, 1));
  message.detections[0].class_id = 100;
  EXPECT_FALSE(view.hear(message, 2));
  EXPECT_EQ(view.state().detections->t, 1);
}

TEST(RobotView, TargetsOfARunsFilesAreAsTheySay) {
  auto site = made_site();
  site->prior.objects = {made_vehicle(40, 10, 0)};
  RobotView view = made_view(site);
  view.set_map({.objects = {made_vehicle(3, 10, 0)}, .ground = {}}, 1, 1);
  view.set_targets({{40, {.state = "unreachable", .reason = "no way there"}}});
  const Json target = (*view.message(Topic::objects, 1))["objects"][0]["target"];
  EXPECT_EQ(target["state"], "unreachable");
  EXPECT_EQ(target["reason"], "no way there");
  EXPECT_FALSE(target.contains("tour"));
}

TEST(RobotView, AVerdictSaysHowLongTheWayIsClear) {
  RobotView view = made_view();
  verdict_t verdict{};
  verdict.utime = 4000000;
  verdict.clear_until_utime = 5500000;
  verdict.reason = verdict_t::OCCUPIED;
  verdict.first_hit[0] = verdict.first_hit[1] = verdict.first_hit[2] = NAN;
  verdict.clearance_m = NAN;
  EXPECT_TRUE(view.hear(verdict, 1));
  const Json said = *view.message(Topic::verdict, 1);
  EXPECT_EQ(said["clear_for_s"], 1.5);
  EXPECT_EQ(said["reason"], "occupied");
  EXPECT_FALSE(said.contains("first_hit"));
  EXPECT_FALSE(said.contains("clearance_m"));
}

}  // namespace
}  // namespace saker::flight::viewers
