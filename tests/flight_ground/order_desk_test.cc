#include "flight/ground/order_desk.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace saker::flight::ground
