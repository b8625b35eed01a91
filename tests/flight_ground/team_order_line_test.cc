#include "flight/ground/team_order_line.h"

#include <gtest/gtest.h>

#include "flight/orders/order_messages.h"
#include "flight_viewers/scratch_folder.h"
#include "saker/core/error.h"
#include "saker/exchange/key.h"

namespace saker::flight::ground {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using State = OrderLine::State;

/// A line of the team's key on a network without sockets; time is made.
struct TeamOrderLineTest : ::testing::Test {
  TeamOrderLineTest() {
    exchange::make_key_file(folder / "team.key");
    line.emplace(bus, folder / "team.key", "GROUND", folder.path());
    bus.subscribe_all<order_t>([this](const std::string& robot, const order_t&) {
      sent.push_back(robot);
      return true;
    });
  }

  void run(milliseconds span) {
    for (const auto end = now + span; now < end; now += milliseconds(100)) {
      line->step(now);
      while (bus.handle(milliseconds(0)) > 0) {
      }
    }
  }
  void answer(std::int64_t id, autonomy::OrderState state, const std::string& text) {
    mission_t message{};
    write_reply({{id, autonomy::OrderKind::hold}, state, text}, message);
    line->hear("R1", message);
  }
  [[nodiscard]] State state(std::int64_t id) const { return line->progress(id).state; }

  testing::ScratchFolder folder;
  Bus bus = Bus::in_memory("GROUND");
  std::optional<TeamOrderLine> line;
  std::vector<std::string> sent;
  OrderLine::Steady::time_point now{};
};

TEST_F(TeamOrderLineTest, AnOrderGoesToItsRobotAloneUntilItIsAnswered) {
  const std::int64_t id = line->send("R1", "hold", now);
  run(seconds(1));
  EXPECT_GE(sent.size(), 3u);
  for (const std::string& robot : sent) EXPECT_EQ(robot, "R1");
  EXPECT_EQ(state(id), State::sent);
  answer(id, autonomy::OrderState::accepted, "holds");
  EXPECT_EQ(state(id), State::acknowledged);
  EXPECT_EQ(line->progress(id).text, "holds");
}

TEST_F(TeamOrderLineTest, OneThatWaitsForTheFlightControllerIsNotOver) {
  const std::int64_t id = line->send("R1", "hold", now);
  answer(id, autonomy::OrderState::waiting, "asks");
  EXPECT_EQ(state(id), State::sent);
}

TEST_F(TeamOrderLineTest, OneThatTheRobotRefusesIsRefused) {
  const std::int64_t id = line->send("R1", "hold", now);
  answer(id, autonomy::OrderState::refused, "it lands already");
  EXPECT_EQ(state(id), State::refused);
  EXPECT_EQ(line->progress(id).text, "it lands already");
}

TEST_F(TeamOrderLineTest, OneThatALaterOneOvertookIsRefused) {
  const std::int64_t first = line->send("R1", "hold", now);
  const std::int64_t second = line->send("R1", "land", now);
  run(milliseconds(200));
  EXPECT_EQ(state(first), State::refused);
  EXPECT_EQ(state(second), State::sent);
}

TEST_F(TeamOrderLineTest, ARobotThatDoesNotAnswerIsSilentAfterFiveSeconds) {
  const std::int64_t id = line->send("R7", "land", now);
  run(milliseconds(4900));
  EXPECT_EQ(state(id), State::sent);
  run(milliseconds(300));
  EXPECT_EQ(state(id), State::silent);
}

TEST_F(TeamOrderLineTest, AnOrderThatIsNotKnownIsSilent) { EXPECT_EQ(state(4711), State::silent); }

TEST_F(TeamOrderLineTest, EveryKindOfTheDeskCanBeSent) {
  for (const char* kind : {"hold", "resume", "return", "land", "abort"})
    EXPECT_GT(line->send("R1", kind, now), 0) << kind;
}

TEST(TeamOrderLine, NeedsAFolderForItsEpoch) {
  const testing::ScratchFolder folder;
  Bus bus = Bus::in_memory("GROUND");
  exchange::make_key_file(folder / "team.key");
  EXPECT_THROW(TeamOrderLine(bus, folder / "team.key", "GROUND", folder / "none"), Error);
}

TEST(TeamOrderLine, NeedsTheTeamsKey) {
  const testing::ScratchFolder folder;
  Bus bus = Bus::in_memory("GROUND");
  EXPECT_THROW(TeamOrderLine(bus, folder / "team.key", "GROUND", folder.path()), Error);
}

}  // namespace
}  // namespace saker::flight::ground
