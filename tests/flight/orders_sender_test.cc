#include <gtest/gtest.h>

#include <thread>

#include "flight/orders/order_sender.h"
#include "made_folder.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using autonomy::Order;
using autonomy::OrderKind;
using autonomy::OrderState;
using std::chrono::milliseconds;
using State = OrderSender::State;

/// A ground on a network without sockets, and what a robot hears of it; time is made.
class AGround : public testing::Test {
 protected:
  void SetUp() override {
    exchange::make_key_file(key_file);
    key = exchange::read_key(key_file);
    sender.emplace(OrderSenderConfig{}, bus, key_file, "GROUND", folder.path());
    opener.emplace(key, "R1", folder / "window");
    bus.subscribe<order_t>([this](const order_t& message) {
      const OpenedOrder open = opened(*opener, "R1", message, message.utime, 0, 2);
      EXPECT_EQ(open.verdict, OrderVerdict::genuine);
      heard.push_back(open.order);
      return true;
    });
  }

  void run(milliseconds span) {
    for (const auto end = now + span; now < end; now += milliseconds(10)) {
      sender->step(now);
      while (bus.handle(milliseconds(0)) > 0) {
      }
    }
  }
  std::int64_t send(OrderKind kind, const std::string& robot = "R1") {
    const std::int64_t id = sender->send(robot, kind, now);
    run(milliseconds(10));
    return id;
  }
  void answer(Order order, OrderState state, const std::string& text,
              const std::string& robot = "R1") {
    mission_t message{};
    write_reply({order, state, text}, message);
    sender->hear(robot, message);
  }
  [[nodiscard]] State state(std::int64_t id) const { return sender->progress(id).state; }

  MadeFolder folder;
  const std::filesystem::path key_file = folder / "team.key";
  exchange::Key key{};
  Bus bus = Bus::in_memory("R1");
  std::optional<OrderSender> sender;
  std::optional<exchange::Opener> opener;
  std::vector<Order> heard;
  OrderSender::Steady::time_point now{};
};

TEST_F(AGround, SendsAnOrderAtOnceAndAgainWithTheSameIdUntilItIsAnswered) {
  const std::int64_t id = send(OrderKind::hold);
  ASSERT_EQ(heard.size(), 1u);
  EXPECT_EQ(state(id), State::sending);
  run(milliseconds(1000));
  EXPECT_EQ(heard.size(), 4u);
  for (const Order& order : heard) EXPECT_EQ(order, (Order{id, OrderKind::hold}));
  answer(heard[0], OrderState::accepted, "stops");
  EXPECT_EQ(state(id), State::accepted);
  EXPECT_EQ(sender->progress(id).text, "stops");
  run(milliseconds(1000));
  EXPECT_EQ(heard.size(), 4u);
}

TEST_F(AGround, AsksOnWhileTheRobotAsksItsFlightController) {
  const std::int64_t id = send(OrderKind::resume);
  answer({id, OrderKind::resume}, OrderState::waiting, "asks");
  EXPECT_EQ(state(id), State::waiting);
  run(milliseconds(1000));
  EXPECT_GT(heard.size(), 2u);
  answer({id, OrderKind::resume}, OrderState::refused, "no");
  EXPECT_EQ(state(id), State::refused);
}

TEST_F(AGround, GivesUpAtTheDeadlineAndAnAnswerAfterItChangesNothing) {
  const std::int64_t id = send(OrderKind::land);
  run(milliseconds(5100));
  EXPECT_EQ(state(id), State::unanswered);
  EXPECT_EQ(sender->progress(id).text, "nothing is heard of it");
  const std::size_t before = heard.size();
  answer({id, OrderKind::land}, OrderState::accepted, "lands");
  run(milliseconds(1000));
  EXPECT_EQ(state(id), State::unanswered);
  EXPECT_EQ(heard.size(), before);
}

TEST_F(AGround, ALaterOrderToTheRobotTakesTheEarlierOnesPlace) {
  const std::int64_t other = sender->send("R2", OrderKind::hold, now);
  const std::int64_t first = send(OrderKind::hold);
  const std::int64_t second = send(OrderKind::abort);
  EXPECT_GT(second, first);
  EXPECT_EQ(state(first), State::overtaken);
  EXPECT_EQ(state(other), State::sending);
  heard.clear();
  run(milliseconds(1000));
  ASSERT_FALSE(heard.empty());
  for (const Order& order : heard) EXPECT_EQ(order.id, second);
}

TEST_F(AGround, TakesNoOtherAnswerForItsOwn) {
  const std::int64_t id = send(OrderKind::hold);
  answer({id, OrderKind::hold}, OrderState::accepted, "another robot's", "R2");
  answer({id + 1, OrderKind::hold}, OrderState::accepted, "another id");
  answer({id, OrderKind::land}, OrderState::accepted, "another kind");
  sender->hear("R1", mission_t{});
  EXPECT_EQ(state(id), State::sending);
}

TEST_F(AGround, WhatItNeverSentIsUnanswered) { EXPECT_EQ(state(5), State::unanswered); }

TEST_F(AGround, KeepsTheLastOrdersOnly) {
  const std::int64_t first = send(OrderKind::hold);
  for (int i = 0; i < 300; ++i) (void)sender->send("R2", OrderKind::hold, now);
  EXPECT_EQ(state(first), State::unanswered);
}

TEST_F(AGround, OneThatBeginsAnewIsHeardAtOnce) {
  send(OrderKind::hold);
  sender.emplace(OrderSenderConfig{}, bus, key_file, "GROUND", folder.path());
  const std::int64_t id = send(OrderKind::resume);
  EXPECT_EQ(heard.back(), (Order{id, OrderKind::resume}));
}

TEST_F(AGround, IsToldThatAnotherProcessOfItsNameOrdersAndIsHeardAgainWithItsNextOrder) {
  bus.subscribe<order_t>([this](const order_t& message) {
    sender->hear("R1", message);
    return true;
  });
  const std::int64_t first = send(OrderKind::hold);
  run(milliseconds(1000));
  EXPECT_EQ(state(first), State::sending) << "its own orders are no other's";
  std::filesystem::create_directory(folder / "other");
  std::this_thread::sleep_for(milliseconds(2));  // a later life
  OrderSender other({}, bus, key_file, "GROUND", folder / "other");
  (void)other.send("R1", OrderKind::resume, now);
  run(milliseconds(10));
  EXPECT_EQ(state(first), State::overtaken);
  EXPECT_NE(sender->progress(first).text.find("another process orders as GROUND"),
            std::string::npos);
  std::this_thread::sleep_for(milliseconds(2));
  const std::int64_t next = send(OrderKind::abort);
  EXPECT_EQ(heard.back(), (Order{next, OrderKind::abort}));
}

TEST_F(AGround, SealsByARenewedKeyWithoutARestart) {
  (void)send(OrderKind::hold);
  exchange::renew_key(key_file, "R1", folder / "R1.key");
  opener.emplace(exchange::read_key(folder / "R1.key"), "R1", folder / "renewed");
  const std::int64_t id = send(OrderKind::abort);
  EXPECT_EQ(heard.back(), (Order{id, OrderKind::abort}));
}

TEST_F(AGround, RefusesANameThatIsNoneAndAFolderThatIsNotThere) {
  const auto made = [&](const std::string& name, const std::filesystem::path& where) {
    OrderSender{OrderSenderConfig{}, bus, key_file, name, where};
  };
  EXPECT_THROW(made("ground station", folder.path()), Error);
  EXPECT_THROW(made("", folder.path()), Error);
  EXPECT_THROW(made("GROUND", folder / "nowhere"), Error);
}

class FilesOfASender : public testing::Test {
 protected:
  [[nodiscard]] SenderFiles files(const std::string& key, const std::string& kept = "") const {
    return sender_files(key, kept, installed);
  }

  MadeFolder folder;
  InstalledBase installed{folder / "etc.key", folder / "var"};
};

TEST_F(FilesOfASender, AreTheInstalledBasesWhereNoOtherKeyIsThere) {
  exchange::make_key_file(installed.key);
  EXPECT_EQ(files("team.key").key, installed.key);
  EXPECT_EQ(files("team.key").folder, installed.folder);
  EXPECT_EQ(files(installed.key).folder, installed.folder) << "named by hand";
}

TEST_F(FilesOfASender, AreThoseConfiguredWhereTheyAreThere) {
  exchange::make_key_file(installed.key);
  exchange::make_key_file(folder / "own.key");
  EXPECT_EQ(files(folder / "own.key").key, folder / "own.key");
  EXPECT_EQ(files(folder / "own.key").folder, folder.path());
  EXPECT_EQ(files(folder / "own.key", "kept").folder, "kept");
  EXPECT_EQ(files("team.key", "kept").folder, "kept");
}

TEST_F(FilesOfASender, AreNamedAsConfiguredWhereThereIsNoKey) {
  EXPECT_EQ(files("team.key").key, "team.key");
  EXPECT_EQ(files("team.key").folder, ".");
}

}  // namespace
}  // namespace saker::flight
