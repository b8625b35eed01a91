#include "saker/autonomy/orders.h"

#include <gtest/gtest.h>

#include <string>

namespace saker::autonomy {
namespace {

using Row = std::array<OrderAct, kOrderKinds>;
using enum OrderAct;

/// What docs/flying.md promises, cell for cell: hold, resume, return, land, abort.
constexpr std::array<std::pair<Situation, Row>, kSituations> kPromised = {{
    {Situation::preflight, {keep, nothing, end, end, end}},
    {Situation::kept, {keep, go_on, end, end, end}},
    {Situation::not_ours, {keep, take_back, end, end, end}},
    {Situation::arming, {disarm, nothing, end, end, end}},
    {Situation::takeoff, {hold_later, go_on, land, land, land_now}},
    {Situation::tour, {hold, nothing, return_home, land, land_now}},
    {Situation::returning, {hold, refuse, nothing, land, land_now}},
    {Situation::recalled, {hold, tour_again, nothing, land, land_now}},
    {Situation::held, {hold_later, go_on, return_home, land, land_now}},
    {Situation::waiting, {hold_later, go_on, return_later, land, land_now}},
    {Situation::landing, {refuse, refuse, refuse, nothing, land_now}},
    {Situation::taken_over, {refuse, take_back, refuse, refuse, refuse}},
    {Situation::done, {refuse, refuse, refuse, refuse, refuse}},
}};

std::string name(Situation situation, std::size_t kind) {
  return std::string(to_string(situation)) + ", " + to_string(static_cast<OrderKind>(kind));
}

TEST(OrderTable, EveryCellIsWhatIsPromised) {
  for (const auto& [situation, row] : kPromised) {
    for (std::size_t kind = 0; kind < kOrderKinds; ++kind) {
      EXPECT_EQ(order_rule(situation, static_cast<OrderKind>(kind)).act, row[kind])
          << name(situation, kind);
    }
  }
}

TEST(OrderTable, EveryCellSaysWhatHappens) {
  for (std::size_t s = 0; s < kSituations; ++s) {
    for (std::size_t kind = 0; kind < kOrderKinds; ++kind) {
      const auto situation = static_cast<Situation>(s);
      EXPECT_GT(std::string(order_rule(situation, static_cast<OrderKind>(kind)).text).size(), 10u)
          << name(situation, kind);
    }
  }
}

TEST(OrderTable, WithoutTheLadderTheRulingIsTheCell) {
  for (const auto& [situation, row] : kPromised) {
    for (std::size_t kind = 0; kind < kOrderKinds; ++kind) {
      EXPECT_EQ(ruling(situation, static_cast<OrderKind>(kind), {}).act, row[kind]);
    }
  }
}

TEST(OrderTable, NothingKeepsItOutWhereTheLadderReturns) {
  const SafetyDecision low = {SafetyAction::return_home, Cause::battery_low, "battery at 28 %"};
  for (const Situation situation : {Situation::takeoff, Situation::tour, Situation::returning,
                                    Situation::recalled, Situation::held, Situation::waiting}) {
    for (const OrderKind kind : {OrderKind::hold, OrderKind::resume}) {
      const OrderRuling ruled = ruling(situation, kind, low);
      const OrderAct cell = order_rule(situation, kind).act;
      if (cell == nothing) continue;  // it changes nothing
      EXPECT_EQ(ruled.act, refuse) << to_string(situation) << " " << to_string(kind);
      if (cell != refuse) {
        EXPECT_EQ(ruled.text, "battery_low: battery at 28 %");
      }
    }
    for (const OrderKind kind : {OrderKind::land, OrderKind::abort}) {
      EXPECT_EQ(ruling(situation, kind, low).act, order_rule(situation, kind).act);
    }
  }
}

/// Land and silence bring it to the phase of landing: from there nothing leads up again.
TEST(OrderTable, NoOrderLeadsOutOfALandingButToTheGround) {
  for (std::size_t kind = 0; kind < kOrderKinds; ++kind) {
    const OrderAct act = order_rule(Situation::landing, static_cast<OrderKind>(kind)).act;
    EXPECT_TRUE(act == refuse || act == nothing || act == land_now);
  }
}

TEST(OrderTable, WhoFliesKeepsItUnlessAnOperatorResumes) {
  for (std::size_t kind = 0; kind < kOrderKinds; ++kind) {
    const auto order = static_cast<OrderKind>(kind);
    EXPECT_EQ(order_rule(Situation::taken_over, order).act == take_back,
              order == OrderKind::resume);
  }
}

TEST(OrderTable, AnAbortNeverLeadsUpOrOn) {
  for (std::size_t s = 0; s < kSituations; ++s) {
    const OrderAct act = order_rule(static_cast<Situation>(s), OrderKind::abort).act;
    EXPECT_TRUE(act == end || act == land_now || act == refuse);
  }
}

TEST(OrderWords, AreThoseOfTheCommandLineAndNoOthers) {
  for (const char* word : {"hold", "resume", "return", "land", "abort"}) {
    const auto kind = order_kind_of(word);
    ASSERT_TRUE(kind) << word;
    EXPECT_STREQ(to_string(*kind), word);
  }
  for (const char* word : {"", "Hold", "return_home", "stop", "landing"})
    EXPECT_FALSE(order_kind_of(word)) << word;
}

TEST(Replies, AreKeptForWhoAsksAgainAndTheOldestGoes) {
  StandingOrders standing;
  for (int id = 1; id <= 20; ++id)
    (void)standing.keep({{id, OrderKind::hold}, OrderState::accepted, std::to_string(id)});
  EXPECT_EQ(standing.replies.size(), StandingOrders::kMostReplies);
  EXPECT_EQ(standing.reply_to(4), nullptr);
  ASSERT_NE(standing.reply_to(5), nullptr);
  EXPECT_EQ(standing.reply_to(20)->text, "20");
  (void)standing.keep({{20, OrderKind::hold}, OrderState::refused, "later"});
  EXPECT_EQ(standing.replies.size(), StandingOrders::kMostReplies);
  EXPECT_EQ(standing.reply_to(20)->state, OrderState::refused);
}

}  // namespace
}  // namespace saker::autonomy
