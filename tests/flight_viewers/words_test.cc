#include "flight/viewers/words.h"

#include <gtest/gtest.h>

#include <set>

#include "flight_viewers/made_robot.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;
using autonomy::Cause;

MissionWords words_in(const std::string& phase, Cause cause, const std::string& text) {
  RobotView view = made_view();
  view.hear(made_mission(phase, cause, text), 1);
  return words_of(view.state(), *made_site());
}

TEST(Words, OfAVehiclesModesAreThoseOfTheMessage) {
  EXPECT_EQ(mode_word(vehicle_state_t::GUIDED), "guided");
  EXPECT_EQ(mode_word(vehicle_state_t::DESCEND), "descend");
  EXPECT_EQ(mode_word(-1), "unknown");
  EXPECT_EQ(mode_word(6), "unknown");
}

TEST(Words, OfFaultsAreOneABit) {
  EXPECT_TRUE(fault_words(0).empty());
  EXPECT_EQ(fault_words(16), std::vector<std::string>{"collision"});
  EXPECT_EQ(fault_words(31).size(), 5u);
  EXPECT_TRUE(fault_words(32).empty());  // a bit of a later version
  EXPECT_EQ(fault_words(-1).size(), 5u);
}

TEST(Words, OfVerdictsAreThoseOfTheMessage) {
  EXPECT_EQ(verdict_word(verdict_t::NONE), "none");
  EXPECT_EQ(verdict_word(verdict_t::OCCUPIED), "occupied");
  EXPECT_EQ(verdict_word(verdict_t::NO_TRAJECTORY), "no_trajectory");
  EXPECT_EQ(verdict_word(5), "unknown");
}

TEST(Words, OfOdometryAreThoseOfTheMessage) {
  EXPECT_EQ(odometry_word(odometry_t::OK), "ok");
  EXPECT_EQ(odometry_word(2), "lost");
  EXPECT_EQ(odometry_word(3), "unknown");
}

TEST(Words, OfCausesAreKnownOfEveryOneAndOfNoOther) {
  std::set<std::string> words;
  for (int code = 0; code <= static_cast<int>(autonomy::kLastCause); ++code)
    EXPECT_TRUE(words.insert(cause_word(code)).second) << cause_word(code);
  EXPECT_FALSE(words.contains("unknown"));
  for (const int code : {-1, 1000, INT32_MAX, INT32_MIN}) EXPECT_EQ(cause_word(code), "unknown");
}

TEST(Words, TroubleIsWhatIsNotAsItShouldBe) {
  for (const Cause cause : {Cause::none, Cause::took_off, Cause::tour_complete, Cause::landed,
                            Cause::recovered, Cause::ordered})
    EXPECT_FALSE(is_trouble(static_cast<int>(cause))) << to_string(cause);
  for (const Cause cause : {Cause::lidar_silent, Cause::battery_low, Cause::collision,
                            Cause::hold_deadline, Cause::command_refused})
    EXPECT_TRUE(is_trouble(static_cast<int>(cause))) << to_string(cause);
  EXPECT_TRUE(is_trouble(4711));  // one that is not known is no good news
}

TEST(Words, BeforeAMissionIsHeardThatIsWhatIsWaitedFor) {
  const MissionWords words = words_of(made_view().state(), *made_site());
  EXPECT_EQ(words.ladder, "unknown");
  EXPECT_EQ(words.waits_for, "the first word of its mission");
}

TEST(Words, PreflightWaitsForWhatIsMissing) {
  EXPECT_EQ(words_in("preflight", Cause::vehicle_silent, "no state").waits_for, "no state");
  EXPECT_EQ(words_in("preflight", Cause::none, "").waits_for, "its checks before the flight");
}

TEST(Words, TheTextIsSaidWithoutTheWordOfItsCause) {
  const MissionWords words = words_in("hold", Cause::lidar_silent, "no scan");
  EXPECT_EQ(words.waits_for.find("lidar_silent"), std::string::npos);
}

TEST(Words, OfATextThatDoesNotNameItsCauseAllIsSaid) {
  RobotView view = made_view();
  mission_t mission = made_mission("hold", Cause::lidar_silent, "");
  mission.cause = "something else";
  view.hear(mission, 1);
  EXPECT_EQ(words_of(view.state(), *made_site()).waits_for, "the end of: something else");
}

TEST(Words, ATourGoesOnToTheNextTarget) {
  EXPECT_EQ(words_in("tour", Cause::took_off, "").if_it_goes_on,
            "it looks at target 2 of 8 and goes on to the next");
}

TEST(Words, EveryPhaseSaysWhatItWaitsFor) {
  for (const char* phase :
       {"preflight", "arming", "takeoff", "tour", "return", "hold", "landing", "done"}) {
    const MissionWords words = words_in(phase, Cause::ordered, "as ordered");
    EXPECT_FALSE(words.waits_for.empty()) << phase;
    EXPECT_FALSE(words.if_it_goes_on.empty()) << phase;
  }
}

TEST(Words, WithoutACauseThereAreNoEmptyBrackets) {
  EXPECT_EQ(words_in("landing", Cause::home_reached, "at home").waits_for,
            "the ground: it lands (at home)");
  EXPECT_EQ(words_in("landing", Cause::home_reached, "").waits_for, "the ground: it lands");
  EXPECT_EQ(words_in("done", Cause::landed, "").waits_for, "nothing: the mission is over");
}

TEST(Words, APhaseThatIsNotKnownSaysItsTextAndPromisesNothing) {
  const MissionWords words = words_in("dance", Cause::ordered, "to music");
  EXPECT_EQ(words.waits_for, "to music");
  EXPECT_EQ(words.if_it_goes_on, "");
  EXPECT_EQ(words.ladder, "none");
}

TEST(Words, AHoldSaysTheSitesOwnTimeToLand) {
  RobotView view = made_view();
  view.hear(made_mission("hold", Cause::lidar_silent, ""), 1);
  Site site = *made_site();
  site.land_after_s = 7.5;
  EXPECT_EQ(words_of(view.state(), site).if_it_goes_on, "it lands 7.5 s after it began to hold");
}

TEST(Words, AHoldThatWasOrderedIsOnTheRungToo) {
  EXPECT_EQ(words_in("hold", Cause::ordered, "").ladder, "hold");
}

TEST(Words, ALandingAfterAllWasWellIsOnNoRung) {
  EXPECT_EQ(words_in("landing", Cause::home_reached, "").ladder, "none");
}

}  // namespace
}  // namespace saker::flight::viewers
