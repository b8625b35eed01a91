#include "flight/viewers/robot_views.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "flight_viewers/made_robot.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

template <class Message>
std::vector<std::uint8_t> encoded(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

struct RobotViewsTest : ::testing::Test {
  template <class Message>
  bool hear(const std::string& channel, const Message& message) {
    return views.hear(channel, encoded(message), 1);
  }
  [[nodiscard]] const RobotState& state(const std::string& robot) {
    return views.find(robot)->state();
  }
  bool hear_scan(int points) {
    bool all_taken = true;
    for (const scan_t& chunk : to_lcm(made_scan(points), 1))
      all_taken = hear("R1_SCAN", chunk) && all_taken;
    return all_taken;
  }

  RobotViews views{made_site(), kForever};
};

TEST_F(RobotViewsTest, AMessageGoesToTheRobotAndTheTopicOfItsChannel) {
  EXPECT_TRUE(hear("R1_STATE", made_state()));
  EXPECT_TRUE(hear("R2_ODOMETRY", made_odometry(1, 5, 0)));
  EXPECT_TRUE(hear("R2_MISSION", made_mission("tour", autonomy::Cause::took_off, "")));
  ASSERT_EQ(views.all().size(), 2u);
  EXPECT_TRUE(state("R1").vehicle);
  EXPECT_FALSE(state("R1").odometry);
  EXPECT_EQ(state("R2").odometry->message.position[0], 5);
  EXPECT_EQ(state("R2").mission->message.phase, "tour");
}

TEST_F(RobotViewsTest, WhatViewersAreNotToldIsNotHeard) {
  for (const char* channel :
       {"R1_SETPOINT", "R1_COMMAND", "R1_ORDER", "R1_", "R1", "", "_STATE_", "R1_STATE_STATE"})
    EXPECT_FALSE(hear(channel, made_state())) << channel;
  EXPECT_TRUE(views.all().empty());
}

TEST_F(RobotViewsTest, BytesOfAnotherTypeAreCountedAndChangeNothing) {
  EXPECT_TRUE(hear("R1_STATE", made_state()));
  EXPECT_FALSE(hear("R1_STATE", made_odometry(1, 0, 0)));
  EXPECT_FALSE(views.hear("R1_STATE", {}, 1));
  EXPECT_EQ(state("R1").malformed, 2);
  EXPECT_EQ(state("R1").vehicle->message.battery_share, 0.5f);
}

TEST_F(RobotViewsTest, EveryMessageThatIsCutIsRefused) {
  const auto whole = encoded(made_objects({made_vehicle(1, 0, 0)}));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(views.hear("R1_OBJECTS", std::span(whole).first(size), 1)) << size;
  EXPECT_TRUE(state("R1").objects.empty());
  EXPECT_TRUE(views.hear("R1_OBJECTS", whole, 1));
}

TEST_F(RobotViewsTest, OfWhateverBytesNothingIsThrown) {
  auto bytes = encoded(made_plan({1, 2, 3}, 1));
  std::uint32_t random = 1;
  for (int round = 0; round < 5000; ++round) {
    auto changed = bytes;
    for (int k = 0; k < 3; ++k) {
      random = random * 1664525 + 1013904223;  // Numerical Recipes' generator
      changed[8 + (random >> 8) % (changed.size() - 8)] = static_cast<std::uint8_t>(random >> 24);
    }
    EXPECT_NO_THROW(views.hear("R1_PLAN", changed, round));
    if (RobotView* view = views.find("R1"); view != nullptr) {
      EXPECT_NO_THROW(static_cast<void>(view->take_due(round, all)));
    }
  }
}

TEST_F(RobotViewsTest, AMessageOfNonsenseIsCounted) {
  odometry_t odometry = made_odometry(1, 0, 0);
  odometry.position[0] = NAN;
  EXPECT_FALSE(hear("R1_ODOMETRY", odometry));
  EXPECT_EQ(state("R1").malformed, 1);
}

TEST_F(RobotViewsTest, ThereAreAtMost32Robots) {
  for (int i = 0; i < 40; ++i) hear(fmt::format("R{}_STATE", i), made_state());
  EXPECT_EQ(views.all().size(), 32u);
  EXPECT_EQ(views.of("R39"), nullptr);
  EXPECT_FALSE(hear("R39_STATE", made_state()));
  EXPECT_TRUE(hear("R3_STATE", made_state()));
}

TEST_F(RobotViewsTest, AQuestionMakesNoRobot) {
  EXPECT_EQ(views.find("R1"), nullptr);
  EXPECT_TRUE(views.all().empty());
  RobotView* const view = views.of("R1");
  EXPECT_EQ(views.find("R1"), view);
  EXPECT_EQ(views.of("R1"), view);
}

TEST_F(RobotViewsTest, RobotsGetTheirColoursInTheOrderInWhichTheyCome) {
  views.of("R9");
  views.of("R1");
  EXPECT_EQ(state("R9").colour.red, colour_of_robot(0).red);
  EXPECT_EQ(state("R1").colour.blue, colour_of_robot(1).blue);
}

TEST_F(RobotViewsTest, ScansAreDecodedForThoseWhoWantThem) {
  EXPECT_TRUE(hear_scan(20));
  EXPECT_EQ(views.find("R1"), nullptr);
  views.want_bulk(true, false);
  EXPECT_TRUE(hear_scan(20));
  ASSERT_TRUE(state("R1").scan);
  EXPECT_EQ(state("R1").scan->message.points->size(), 20u);
}

TEST_F(RobotViewsTest, AScanOfManyChunksIsThereOnceAllOfThemAre) {
  views.want_bulk(true, false);
  const auto chunks = to_lcm(made_scan(20000), 1);
  ASSERT_GT(chunks.size(), 1u);
  for (std::size_t i = 1; i < chunks.size(); ++i) EXPECT_TRUE(hear("R1_SCAN", chunks[i]));
  EXPECT_FALSE(state("R1").scan);
  EXPECT_TRUE(hear("R1_SCAN", chunks[0]));
  ASSERT_TRUE(state("R1").scan);
  EXPECT_EQ(state("R1").scan->message.points->size(), 20000u);
}

TEST_F(RobotViewsTest, ScansAndBlocksThatAreNoneAreCounted) {
  views.want_bulk(true, true);
  EXPECT_FALSE(hear("R1_SCAN", made_state()));
  EXPECT_FALSE(hear("R1_OCCUPANCY", made_state()));
  scan_t scan = to_lcm(made_scan(10), 1).front();
  scan.chunk = scan.num_chunks;
  EXPECT_FALSE(hear("R1_SCAN", scan));
  EXPECT_EQ(state("R1").malformed, 3);
}

TEST_F(RobotViewsTest, ABlockOfOccupancyIsPutTogether) {
  views.want_bulk(false, true);
  occupancy::OccupancyGrid grid{.stamp = 1000000,
                                .resolution_m = 0.5,
                                .origin = {1, 2, 3},
                                .size = {4, 2, 1},
                                .cells = std::vector<occupancy::Cell>(8)};
  grid.cells[5] = occupancy::Cell::occupied;
  for (const occupancy_t& chunk : to_lcm(grid, 1)) EXPECT_TRUE(hear("R1_OCCUPANCY", chunk));
  ASSERT_TRUE(state("R1").occupancy);
  EXPECT_EQ(state("R1").occupancy->message.cells, grid.cells);
}

TEST_F(RobotViewsTest, ClearedNobodyWasHeard) {
  hear("R1_STATE", made_state());
  views.clear();
  EXPECT_TRUE(views.all().empty());
  hear("R2_STATE", made_state());
  EXPECT_EQ(state("R2").colour.red, colour_of_robot(0).red);
}

TEST_F(RobotViewsTest, ARobotOfARunHasASiteOfItsOwn) {
  auto own = made_site();
  own->prior.objects = {made_vehicle(31, 0, 0)};
  RobotView* const view = views.add("R1", own);
  EXPECT_EQ((*view->message(Topic::site, 0))["prior"]["objects"].size(), 1u);
  EXPECT_EQ((*views.of("R2")->message(Topic::site, 0))["prior"]["objects"].size(), 0u);
}

}  // namespace
}  // namespace saker::flight::viewers
