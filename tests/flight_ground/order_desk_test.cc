#include "flight/ground/order_desk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "flight_viewers/scratch_folder.h"
#include "saker/core/files.h"

namespace saker::flight::ground {
namespace {

using testing::ScratchFolder;

/// Answers what the test has put there.
struct MadeLine : OrderLine {
  std::int64_t send(const std::string& robot, const std::string& kind,
                    Steady::time_point) override {
    sent.push_back(robot + " " + kind);
    return static_cast<std::int64_t>(sent.size());
  }
  [[nodiscard]] Progress progress(std::int64_t id) const override {
    const auto at = answers.find(id);
    return at == answers.end() ? Progress{State::sent, ""} : at->second;
  }
  void hear(const std::string&, const mission_t&) override {}
  void step(Steady::time_point) override {}

  std::vector<std::string> sent;
  std::map<std::int64_t, Progress> answers;
};

struct OrderDeskTest : ::testing::Test {
  void ask(const std::string& payload) {
    std::string message = service_response(2, 1, payload);  // a request has the same bytes
    message[0] = 2;
    static_cast<void>(
        hub.hear(client, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()},
                 true, now));
  }
  std::vector<std::string> answers() {
    std::vector<std::string> all;
    while (const auto next = hub.take(client, now)) all.push_back(*next->body);
    return all;
  }
  void begin(OrderDesk& desk) {
    desk.offer_to(hub);
    client = hub.open("10.0.0.7", false, now);
    answers();
  }
  void step(OrderDesk& desk, double t) {
    desk.step(t, now, [&](const std::string&, const Json& order) { said.push_back(order); });
  }

  ScratchFolder scratch;
  Hub::Steady::time_point now = Hub::Steady::now();
  Hub hub{{.mode = "live", .version = "1", .session = "s", .begin = {}, .end = {}}};
  Hub::SessionId client = 0;
  std::vector<Json> said;
};

TEST_F(OrderDeskTest, AnOrderIsSentAndAnsweredOnceTheRobotHasAcknowledgedIt) {
  auto line = std::make_unique<MadeLine>();
  MadeLine& robot = *line;
  OrderDesk desk(std::move(line), scratch / "orders.log");
  begin(desk);
  ask(R"({"robot":"R1","kind":"hold"})");
  step(desk, 100);
  EXPECT_EQ(robot.sent, std::vector<std::string>{"R1 hold"});
  EXPECT_TRUE(answers().empty());
  robot.answers[1] = {OrderLine::State::acknowledged, "holds"};
  step(desk, 100.25);
  const std::string answer = answers().at(0);
  const Json json = Json::parse(answer.substr(answer.find('{')));
  EXPECT_EQ(json["state"], "acknowledged");
  EXPECT_EQ(json["took_s"], 0.25);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_EQ(said[0]["state"], "sent");
  EXPECT_EQ(said[1]["text"], "holds");
}

TEST_F(OrderDeskTest, WhoOrderedWhatAndWhenIsWrittenDown) {
  auto line = std::make_unique<MadeLine>();
  line->answers[1] = {OrderLine::State::refused, "lands already"};
  OrderDesk desk(std::move(line), scratch / "orders.log");
  begin(desk);
  ask(R"({"robot":"R2","kind":"land"})");
  step(desk, 100);
  const std::string log = core::read_file(scratch / "orders.log");
  const Json last = Json::parse(log.substr(log.find('\n') + 1));
  EXPECT_EQ(last["by"], "10.0.0.7");
  EXPECT_EQ(last["robot"], "R2");
  EXPECT_EQ(last["kind"], "land");
  EXPECT_EQ(last["state"], "refused");
  EXPECT_EQ(last["t_s"], 100);
}

TEST_F(OrderDeskTest, WithoutAKeyOfTheTeamEveryOrderIsRefused) {
  OrderDesk desk(nullptr, {});
  begin(desk);
  ask(R"({"robot":"R1","kind":"abort"})");
  step(desk, 100);
  EXPECT_NE(answers().at(0).find(R"("state":"refused")"), std::string::npos);
}

TEST_F(OrderDeskTest, WhatIsNoOrderIsRefusedAtOnce) {
  auto line = std::make_unique<MadeLine>();
  MadeLine& robot = *line;
  OrderDesk desk(std::move(line), {});
  begin(desk);
  for (const char* payload :
       {R"({"robot":"R1","kind":"arm"})", R"({"robot":"r1","kind":"hold"})",
        R"({"robot":"R1_X","kind":"hold"})", R"({"kind":"hold"})", R"({"robot":1,"kind":2})"}) {
    ask(payload);
    EXPECT_NE(answers().at(0).find("serviceCallFailure"), std::string::npos) << payload;
  }
  step(desk, 1);
  EXPECT_TRUE(robot.sent.empty());
}

TEST_F(OrderDeskTest, TheFolderOfItsLogIsMade) {
  OrderDesk desk(nullptr, scratch / "saker-ground/kept/orders.log");
  begin(desk);
  ask(R"({"robot":"R1","kind":"land"})");
  step(desk, 100);
  const Json line = Json::parse(core::read_file(scratch / "saker-ground/kept/orders.log"));
  EXPECT_EQ(line["state"], "refused");
  EXPECT_EQ(line["by"], "10.0.0.7");
}

TEST_F(OrderDeskTest, AnEarlierLogIsAddedTo) {
  core::write_file(scratch / "orders.log", "{}\n");
  OrderDesk desk(nullptr, scratch / "orders.log");
  begin(desk);
  ask(R"({"robot":"R1","kind":"land"})");
  step(desk, 100);
  EXPECT_TRUE(core::read_file(scratch / "orders.log").starts_with("{}\n{\"id\":0,"));
}

TEST_F(OrderDeskTest, ALogThatCannotBeWrittenKeepsNoOrderBack) {
  core::write_file(scratch / "file", "");
  auto line = std::make_unique<MadeLine>();
  MadeLine& robot = *line;
  OrderDesk desk(std::move(line), scratch / "file/orders.log");
  begin(desk);
  ask(R"({"robot":"R1","kind":"land"})");
  step(desk, 100);
  EXPECT_EQ(robot.sent.size(), 1u);
}

TEST_F(OrderDeskTest, EachOrderGetsItsOwnAnswerInWhateverOrderTheyCome) {
  auto line = std::make_unique<MadeLine>();
  MadeLine& robot = *line;
  OrderDesk desk(std::move(line), {});
  begin(desk);
  ask(R"({"robot":"R1","kind":"hold"})");
  ask(R"({"robot":"R2","kind":"land"})");
  step(desk, 100);
  robot.answers[2] = {OrderLine::State::silent, ""};
  step(desk, 105);
  const auto first = answers();
  ASSERT_EQ(first.size(), 1u);
  EXPECT_NE(first[0].find(R"("robot":"R2","kind":"land")"), std::string::npos);
  EXPECT_NE(first[0].find(R"("state":"silent")"), std::string::npos);
  robot.answers[1] = {OrderLine::State::acknowledged, ""};
  step(desk, 106);
  EXPECT_NE(answers().at(0).find(R"("robot":"R1","kind":"hold")"), std::string::npos);
  step(desk, 107);
  EXPECT_TRUE(answers().empty());  // each once
}

TEST_F(OrderDeskTest, MoreThan32AtOnceAreRefused) {
  auto line = std::make_unique<MadeLine>();
  MadeLine& robot = *line;
  OrderDesk desk(std::move(line), {});
  begin(desk);
  for (int i = 0; i < 40; ++i) ask(R"({"robot":"R1","kind":"hold"})");
  const auto refused = answers();
  EXPECT_EQ(refused.size(), 8u);
  EXPECT_NE(refused.at(0).find("too many orders at once"), std::string::npos);
  step(desk, 100);
  EXPECT_EQ(robot.sent.size(), 32u);
}

TEST_F(OrderDeskTest, AnOrderOfWhoIsGoneIsStillSentAndWrittenDown) {
  auto line = std::make_unique<MadeLine>();
  MadeLine& robot = *line;
  OrderDesk desk(std::move(line), scratch / "orders.log");
  begin(desk);
  ask(R"({"robot":"R1","kind":"land"})");
  hub.close(client);
  step(desk, 100);
  robot.answers[1] = {OrderLine::State::acknowledged, ""};
  step(desk, 101);
  EXPECT_EQ(robot.sent, std::vector<std::string>{"R1 land"});
  EXPECT_EQ(said.back()["state"], "acknowledged");
}

TEST_F(OrderDeskTest, WhatARobotAnswersIsSaidAsUtf8) {
  auto line = std::make_unique<MadeLine>();
  line->answers[1] = {OrderLine::State::refused, "bad \xff byte\nand a line"};
  OrderDesk desk(std::move(line), scratch / "orders.log");
  begin(desk);
  ask(R"({"robot":"R1","kind":"hold"})");
  EXPECT_NO_THROW(step(desk, 100));
  const std::string answer = answers().at(0);
  EXPECT_EQ(Json::parse(answer.substr(answer.find('{')))["text"],
            "bad \xef\xbf\xbd byte\nand a line");
  const std::string log = core::read_file(scratch / "orders.log");
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 2);  // a line an entry: no text adds one
}

TEST_F(OrderDeskTest, ALineThatComesLaterIsUsedFromThenOn) {
  OrderDesk desk(nullptr, {});
  begin(desk);
  auto line = std::make_unique<MadeLine>();
  MadeLine& robot = *line;
  desk.send_by(std::move(line));
  ask(R"({"robot":"R1","kind":"hold"})");
  step(desk, 100);
  EXPECT_EQ(robot.sent.size(), 1u);
}

TEST_F(OrderDeskTest, ANameIsOneWholeRobotsName) {
  OrderDesk desk(std::make_unique<MadeLine>(), {});
  begin(desk);
  for (const std::string& robot :
       {std::string("R1\\n"), std::string("R1 "), std::string("../R1"), std::string("1R"),
        std::string(17, 'R'), std::string(60000, 'R')}) {
    ask(R"({"kind":"hold","robot":")" + robot + R"("})");
    EXPECT_NE(answers().at(0).find("serviceCallFailure"), std::string::npos) << robot.size();
  }
  ask(R"({"kind":"hold","robot":")" + std::string(16, 'R') + R"("})");
  EXPECT_TRUE(answers().empty());
}

TEST_F(OrderDeskTest, AKindIsOneOfTheFiveAsTheyAreWritten) {
  OrderDesk desk(std::make_unique<MadeLine>(), {});
  begin(desk);
  for (const char* kind : {"", "Hold", "hold ", "takeoff", "land;abort"}) {
    ask(std::string(R"({"robot":"R1","kind":")") + kind + R"("})");
    EXPECT_NE(answers().at(0).find("serviceCallFailure"), std::string::npos) << kind;
  }
}

}  // namespace
}  // namespace saker::flight::ground
