#include "saker/autonomy/orders.h"

#include <fmt/format.h>

#include <algorithm>

namespace saker::autonomy {
namespace {

using enum OrderAct;

constexpr std::array<const char*, kOrderKinds> kWords = {"hold", "resume", "return", "land",
                                                         "abort"};

constexpr OrderRule kEnd = {end, "ends on the ground, motors off"};
constexpr OrderRule kReturn = {return_home, "returns and lands there"};
constexpr OrderRule kLand = {land, "lands where it is"};
constexpr OrderRule kLandNow = {land_now, "stops and descends at once, to the ground"};
constexpr OrderRule kHold = {
    hold, "stops, stays until another order or the safety ladder, 5 min at most"};
constexpr OrderRule kLands = {refuse, "it lands; the ground is the only way out"};
constexpr OrderRule kNotOurs = {refuse, "somebody else flies it: resume takes it back first"};
constexpr OrderRule kOver = {refuse, "the mission is over"};

using Row = std::array<OrderRule, kOrderKinds>;

/// A row a situation: hold, resume, return, land, abort.
constexpr std::array<Row, kSituations> kTable = {{
    // preflight
    {{{keep, "stays on the ground until resume"},
      {nothing, "waits for its take-off as it is"},
      kEnd,
      kEnd,
      kEnd}},
    // kept
    {{{keep, "stays on the ground until resume"},
      {go_on, "takes off when nothing is missing"},
      kEnd,
      kEnd,
      kEnd}},
    // not_ours
    {{{keep, "stays on the ground until resume"},
      {take_back, "the vehicle is the executive's again"},
      kEnd,
      kEnd,
      kEnd}},
    // arming
    {{{disarm, "motors off, stays on the ground until resume"},
      {nothing, "is about to take off"},
      kEnd,
      kEnd,
      kEnd}},
    // takeoff
    {{{hold_later, "climbs to its height, holds there until another order or the safety ladder"},
      {go_on, "climbs, then flies its tour"},
      kLand,
      kLand,
      kLandNow}},
    // tour
    {{kHold, {nothing, "flies its tour already"}, kReturn, kLand, kLandNow}},
    // returning
    {{kHold,
      {refuse, "its tour is over: it returns"},
      {nothing, "returns already"},
      kLand,
      kLandNow}},
    // recalled
    {{kHold, {tour_again, "goes on with its tour"}, {nothing, "returns already"}, kLand, kLandNow}},
    // held
    {{{hold_later, "holds already, until another order or the safety ladder, 5 min more at most"},
      {go_on, "goes on with what was interrupted"},
      kReturn,
      kLand,
      kLandNow}},
    // waiting
    {{{hold_later, "holds, also when the cause is gone, until another order"},
      {go_on, "goes on when the cause of the hold is gone"},
      {return_later, "returns when the cause of the hold is gone"},
      kLand,
      kLandNow}},
    // landing
    {{kLands, kLands, kLands, {nothing, "lands already"}, kLandNow}},
    // taken_over
    {{kNotOurs,
      {take_back, "flies again, goes on with what was interrupted"},
      kNotOurs,
      kNotOurs,
      kNotOurs}},
    // done
    {{kOver, kOver, kOver, kOver, kOver}},
}};

/// Whether it would undo the ladder's return.
bool stays_out(OrderAct act) {
  return act == hold || act == hold_later || act == tour_again || act == go_on;
}

}  // namespace

const char* to_string(OrderKind kind) { return kWords[static_cast<std::size_t>(kind)]; }

std::optional<OrderKind> order_kind_of(std::string_view word) {
  const auto* const found = std::find(kWords.begin(), kWords.end(), word);
  if (found == kWords.end()) return std::nullopt;
  return static_cast<OrderKind>(found - kWords.begin());
}

const char* to_string(OrderState state) {
  constexpr const char* kNames[] = {"waiting", "accepted", "refused"};
  return kNames[static_cast<int>(state)];
}

const char* to_string(Situation situation) {
  constexpr std::array<const char*, kSituations> kNames = {"preflight",     "kept on the ground",
                                                           "not ours yet",  "arming",
                                                           "take-off",      "tour",
                                                           "return",        "return by order",
                                                           "hold by order", "hold by the ladder",
                                                           "landing",       "somebody else flies",
                                                           "done"};
  return kNames[static_cast<std::size_t>(situation)];
}

OrderRule order_rule(Situation situation, OrderKind kind) {
  return kTable[static_cast<std::size_t>(situation)][static_cast<std::size_t>(kind)];
}

OrderRuling ruling(Situation situation, OrderKind kind, const SafetyDecision& safety) {
  const OrderRule rule = order_rule(situation, kind);
  if (safety.action == SafetyAction::return_home && stays_out(rule.act)) {
    return {refuse, fmt::format("{}: {}", to_string(safety.cause), safety.text)};
  }
  return {rule.act, rule.text};
}

const OrderReply* StandingOrders::reply_to(std::int64_t id) const {
  const auto found = std::find_if(replies.begin(), replies.end(),
                                  [id](const OrderReply& reply) { return reply.order.id == id; });
  return found == replies.end() ? nullptr : &*found;
}

const OrderReply& StandingOrders::keep(OrderReply reply) {
  std::erase_if(replies, [&](const OrderReply& old) { return old.order.id == reply.order.id; });
  if (replies.size() == kMostReplies) replies.erase(replies.begin());
  return replies.emplace_back(std::move(reply));
}

}  // namespace saker::autonomy
