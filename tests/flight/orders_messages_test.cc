#include <gtest/gtest.h>

#include "flight/orders/order_messages.h"
#include "made_folder.h"

namespace saker::flight {
namespace {

using autonomy::Order;
using autonomy::OrderKind;

constexpr std::int64_t kNow = 1'800'000'000'000'000;  // us
constexpr double kMostAge = 2;                        // s

class AnOrder : public testing::Test {
 protected:
  [[nodiscard]] order_t said(std::int64_t utime = kNow, const std::string& robot = "R1") {
    return *sealed(sealer, robot, order, utime);
  }
  [[nodiscard]] OpenedOrder heard(const order_t& message, std::int64_t since = 0) {
    return opened(opener, "R1", message, kNow, since, kMostAge);
  }

  MadeFolder folder;
  exchange::Key key = [] {
    exchange::Key made{};
    made.fill(3);
    return made;
  }();
  exchange::Sealer sealer{key, "OPERATOR", folder / "counter"};
  exchange::Opener opener{key, "R1", folder / "window"};
  Order order{1234567890123, OrderKind::return_home};
};

TEST_F(AnOrder, ComesOutAsItWentIn) {
  const OpenedOrder open = heard(said(kNow - 500'000));
  EXPECT_EQ(open.verdict, OrderVerdict::genuine);
  EXPECT_EQ(open.sender, "OPERATOR");
  EXPECT_EQ(open.order, order);
  EXPECT_NEAR(open.age_s, 0.5, 1e-9);
}

TEST_F(AnOrder, IsHeardOnce) {
  const order_t message = said();
  EXPECT_EQ(heard(message).verdict, OrderVerdict::genuine);
  EXPECT_EQ(heard(message).verdict, OrderVerdict::replayed);
}

TEST_F(AnOrder, ThatWasHeldBackOrComesFromAnotherClockIsLate) {
  EXPECT_EQ(heard(said(kNow - 2'100'000)).verdict, OrderVerdict::late);
  EXPECT_EQ(heard(said(kNow + 2'100'000)).verdict, OrderVerdict::late);
  EXPECT_EQ(heard(said(kNow - 1'900'000)).verdict, OrderVerdict::genuine);
}

TEST_F(AnOrder, OfBeforeTheHearerBeganIsLate) {
  EXPECT_EQ(heard(said(kNow - 1000), kNow - 900).verdict, OrderVerdict::late);
  EXPECT_EQ(heard(said(kNow - 800), kNow - 900).verdict, OrderVerdict::genuine);
}

TEST_F(AnOrder, ThatSaysAnotherTimeOutsideThanItSealsIsJudgedByTheSealed) {
  order_t message = said(kNow - 5'000'000);
  message.utime = kNow;
  EXPECT_EQ(heard(message).verdict, OrderVerdict::late);
}

TEST_F(AnOrder, ForAnotherRobotIsNone) {
  EXPECT_EQ(heard(said(kNow, "R2")).verdict, OrderVerdict::forged);
}

TEST_F(AnOrder, ByAnotherKeyOrChangedInAnyByteIsForged) {
  exchange::Key other{};
  other.fill(4);
  exchange::Sealer stranger(other, "OPERATOR", folder / "other");
  EXPECT_EQ(heard(*sealed(stranger, "R1", order, kNow)).verdict, OrderVerdict::forged);
  const order_t message = said();
  for (std::size_t i = 0; i < message.data.size(); ++i) {
    order_t changed = message;
    changed.data[i] ^= 0x10;
    EXPECT_NE(heard(changed).verdict, OrderVerdict::genuine) << i;
  }
  for (std::size_t size = 0; size < message.data.size(); ++size) {
    order_t cut = message;
    cut.data.resize(size);
    EXPECT_EQ(heard(cut).verdict, OrderVerdict::forged) << size;
  }
}

TEST_F(AnOrder, ThatIsGenuineButNoneIsMalformed) {
  const auto sealed_bytes = [&](std::string payload) {
    const auto bytes = sealer.seal("R1_ORDER", payload);
    order_t message{};
    message.data.assign(bytes->begin(), bytes->end());
    message.num_data = static_cast<std::int32_t>(message.data.size());
    return message;
  };
  const std::string numbers(16, '\1');
  const std::string name("\2R1", 3);
  using namespace std::string_literals;
  EXPECT_EQ(heard(sealed_bytes("")).verdict, OrderVerdict::malformed);
  EXPECT_EQ(heard(sealed_bytes("\1"s + name + "\5"s + numbers)).verdict, OrderVerdict::malformed);
  EXPECT_EQ(heard(sealed_bytes("\2"s + name + "\0"s + numbers)).verdict, OrderVerdict::malformed);
  EXPECT_EQ(heard(sealed_bytes("\1"s + name + "\0"s + numbers + "x")).verdict,
            OrderVerdict::malformed);
  EXPECT_EQ(heard(sealed_bytes("\1"s + name + "\0"s + std::string(16, '\0'))).verdict,
            OrderVerdict::malformed);  // no id
  EXPECT_EQ(heard(sealed_bytes("\1\2R9"s + "\0"s + numbers)).verdict, OrderVerdict::elsewhere);
}

TEST_F(AnOrder, TheLargestFitsIntoItsMessage) {
  exchange::Sealer longest(key, std::string(16, 'X'), folder / "longest");
  const std::string robot(16, 'R');
  const auto message = sealed(longest, robot, {order.id, OrderKind::abort}, kNow);
  EXPECT_LE(message->num_data, order_t::MAX_DATA);
}

TEST(AReply, ComesOutOfMissionAsItWentIn) {
  const autonomy::OrderReply reply = {
      {77, OrderKind::abort}, autonomy::OrderState::refused, "the mission is over"};
  mission_t message{};
  EXPECT_FALSE(reply_of(message));  // none yet
  write_reply(reply, message);
  EXPECT_EQ(reply_of(message), reply);
}

TEST(AReply, ThatIsNoneIsNotRead) {
  mission_t message{};
  write_reply({{77, OrderKind::hold}, autonomy::OrderState::accepted, ""}, message);
  mission_t wrong = message;
  wrong.order_kind = 5;
  EXPECT_FALSE(reply_of(wrong));
  wrong = message;
  wrong.order_state = -1;
  EXPECT_FALSE(reply_of(wrong));
  wrong = message;
  wrong.order_id = -5;
  EXPECT_FALSE(reply_of(wrong));
}

}  // namespace
}  // namespace saker::flight
