#include <gtest/gtest.h>

#include "flight/bus/exchange_messages.h"
#include "flight/executive/order_receiver.h"
#include "made_folder.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using autonomy::Order;
using autonomy::OrderKind;
using autonomy::OrderReply;
using autonomy::OrderState;
using std::chrono::milliseconds;

class AnExecutive : public testing::Test {
 protected:
  void SetUp() override {
    config.key_file = folder / "team.key";
    exchange::make_key_file(config.key_file);
    key = exchange::read_key(config.key_file);
    sealer.emplace(key, "GROUND", folder / "counter");
  }

  void begin() { receiver.emplace(config, bus, queue, replies); }

  void hear(const order_t& message, const std::string& robot = "R1") {
    bus.publish_as(robot, message);
    while (bus.handle(milliseconds(0)) > 0) {
    }
  }
  [[nodiscard]] order_t said(std::int64_t id, OrderKind kind = OrderKind::hold, double age_s = 0) {
    return *sealed(*sealer, "R1", {id, kind},
                   system_utime() - static_cast<std::int64_t>(age_s * 1e6));
  }
  [[nodiscard]] std::string line() {
    const auto lines = receiver->take_lines();
    return lines.empty() ? "" : lines.back();
  }

  MadeFolder folder;
  ExchangeConfig config;
  exchange::Key key{};
  std::optional<exchange::Sealer> sealer;
  Bus bus = Bus::in_memory("R1");
  BoundedQueue<Order> queue{16};
  Mailbox<OrderReply> replies;
  std::optional<OrderReceiver> receiver;
};

TEST_F(AnExecutive, TakesAGenuineOrderAndTheSameOnceMoreToAnswerItAgain) {
  begin();
  hear(said(7));
  hear(said(7));  // sealed anew
  EXPECT_EQ(queue.take_all(), (std::vector<Order>{{7, OrderKind::hold}, {7, OrderKind::hold}}));
  EXPECT_EQ(receiver->refused(), 0);
  EXPECT_EQ(line(), "");
}

TEST_F(AnExecutive, RefusesCountsAndNamesAReplay) {
  begin();
  const order_t message = said(7);
  hear(message);
  hear(message);
  EXPECT_EQ(queue.size(), 1u);
  EXPECT_EQ(receiver->refused(), 1);
  EXPECT_EQ(line(), "an order is refused: heard before");
}

TEST_F(AnExecutive, RefusesAForgedOneAndOneForAnotherRobot) {
  begin();
  order_t message = said(7);
  message.data.back() ^= 1;
  hear(message);
  EXPECT_EQ(line(), "an order is refused: not sealed by the team's key for this robot");
  hear(*sealed(*sealer, "R2", {8, OrderKind::abort}, system_utime()));  // said to R1
  EXPECT_EQ(line(), "an order is refused: not sealed by the team's key for this robot");
  hear(said(9), "R2");  // not its channel
  EXPECT_EQ(queue.size(), 0u);
  EXPECT_EQ(receiver->refused(), 2);
}

TEST_F(AnExecutive, RefusesALateOneAndOneOfBeforeItBegan) {
  const order_t earlier = said(6);
  begin();
  hear(said(7, OrderKind::abort, 2.5));
  EXPECT_EQ(line(),
            "an order is refused: held back, or sealed by another clock (GROUND): the robot's is "
            "2.5 s ahead");
  hear(earlier);
  EXPECT_EQ(line().substr(0, 33), "an order is refused: held back, o");
  EXPECT_EQ(queue.size(), 0u);
}

TEST_F(AnExecutive, RefusesACopyOfAnOrderThatItsSenderHasOvertaken) {
  begin();
  const order_t copy = said(7, OrderKind::hold);  // held back by somebody
  hear(said(7, OrderKind::hold));
  hear(said(8, OrderKind::resume));
  hear(copy);
  EXPECT_EQ(queue.take_all(), (std::vector<Order>{{7, OrderKind::hold}, {8, OrderKind::resume}}));
  EXPECT_EQ(line(), "an order is refused: overtaken by a later order of its sender (GROUND)");
}

// Hazard: Orders and the radio | the clocks of robot and ground differ | each order is refused with
//   their difference, where it was given | –
TEST_F(AnExecutive, AnswersALateOrderWithTheDifferenceOfTheClocks) {
  begin();
  hear(said(7, OrderKind::land, 3.2));
  const std::string why = "held back, or sealed by another clock: the robot's is 3.2 s ";
  ASSERT_NE(replies.latest(), nullptr);
  EXPECT_EQ(*replies.latest(),
            (OrderReply{{7, OrderKind::land}, OrderState::refused, why + "ahead"}));
  hear(said(8, OrderKind::abort, -3.2));
  EXPECT_EQ(*replies.latest(),
            (OrderReply{{8, OrderKind::abort}, OrderState::refused, why + "behind"}));
}

TEST_F(AnExecutive, AnswersAnOvertakenOrderAndOneOfBeforeItBegan) {
  const order_t earlier = said(6);
  begin();
  hear(earlier);
  ASSERT_NE(replies.latest(), nullptr);
  EXPECT_EQ(replies.latest()->text,
            "held back, or sealed by another clock: it is older than this process");
  hear(said(9));
  hear(said(8));
  EXPECT_EQ(replies.latest()->order.id, 8);
  EXPECT_EQ(replies.latest()->text, "overtaken by a later order of its sender");
}

TEST_F(AnExecutive, WhoHasNoKeyAndACopyOfAnOrderThatWasTakenGetNoAnswer) {
  begin();
  const order_t message = said(7);
  hear(message);
  hear(message);
  order_t forged = said(8);
  forged.data.back() ^= 1;
  hear(forged);
  hear(said(7, OrderKind::hold, 2.5));  // sealed before the one that was taken
  EXPECT_EQ(receiver->refused(), 3);
  EXPECT_EQ(replies.latest(), nullptr);
}

TEST_F(AnExecutive, TwoWhoOrderDoNotOvertakeEachOther) {
  begin();
  exchange::Sealer other(key, "TABLET", folder / "tablet");
  hear(said(9, OrderKind::hold));
  hear(*sealed(other, "R1", {8, OrderKind::abort}, system_utime()));
  EXPECT_EQ(queue.size(), 2u);
}

TEST_F(AnExecutive, WithoutAKeyRefusesAllAndSaysSo) {
  std::filesystem::remove(config.key_file);
  begin();
  EXPECT_FALSE(receiver->can_open());
  hear(said(7));
  EXPECT_EQ(queue.size(), 0u);
  EXPECT_EQ(receiver->refused(), 1);
  EXPECT_EQ(line(), "an order is refused: there is no key of a team to open it by");
}

TEST_F(AnExecutive, RefusesAKeyThatEverybodyMayRead) {
  std::filesystem::permissions(config.key_file, std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_THROW(begin(), Error);
}

TEST_F(AnExecutive, AFloodFillsNoMemoryAndTheNextOrderIsHeard) {
  begin();
  order_t noise = said(1);
  noise.data.assign(noise.data.size(), 0xAA);
  for (int i = 0; i < 5000; ++i) hear(noise);
  hear(said(7, OrderKind::abort));
  EXPECT_EQ(queue.take_all(), (std::vector<Order>{{7, OrderKind::abort}}));
  EXPECT_EQ(receiver->refused(), 5000);
  EXPECT_LE(receiver->take_lines().size(), 8u);
}

}  // namespace
}  // namespace saker::flight
