#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saker/autonomy/safety.h"
#include "saker/core/time.h"

/// What an operator may order in flight, and what each order does: a table.
///
/// Reads an order, the situation of the mission in which it comes and what the safety ladder says;
/// makes the act that the mission carries out and the words of the acknowledgement. An order never
/// undoes what the ladder calls for: it holds where the ladder holds, and where the ladder returns
/// or lands only what is more urgent is taken. No state, no clock.
namespace saker::autonomy {

enum class OrderKind : std::uint8_t {
  hold,         ///< stop, and stay kOrderedHold_s, until another order, or until the ladder acts
  resume,       ///< go on with the mission, also after somebody else flew
  return_home,  ///< to above the place of take-off, and land
  land,         ///< where it is, after the place has been looked at where there is time for that
  abort,        ///< the fastest end that is safe: down at once; on the ground motors off
};
inline constexpr std::size_t kOrderKinds = 5;

/// A hold by order lasts so long in flight, then it returns: the link may be gone and the battery
/// unknown. A fifth of a battery's flight; whoever wants more orders it again.
inline constexpr double kOrderedHold_s = 300;

/// The word of the command line: hold, resume, return, land, abort.
[[nodiscard]] const char* to_string(OrderKind kind);
[[nodiscard]] std::optional<OrderKind> order_kind_of(std::string_view word);

struct Order {
  std::int64_t id = 0;  ///< of the sender's choice; the same once more is the same order
  OrderKind kind = OrderKind::hold;

  bool operator==(const Order&) const = default;
};

enum class OrderState : std::uint8_t { waiting, accepted, refused };

[[nodiscard]] const char* to_string(OrderState state);

/// What became of an order, for MISSION.
struct OrderReply {
  Order order;
  OrderState state = OrderState::waiting;
  std::string text;  ///< what it does and until when, or why it is refused

  bool operator==(const OrderReply&) const = default;
};

/// What the mission is in when an order comes: its phase, and why it is in it.
enum class Situation : std::uint8_t {
  preflight,
  kept,      ///< preflight, by an order
  not_ours,  ///< preflight, the vehicle is still somebody else's
  arming,
  takeoff,
  tour,
  returning,
  recalled,    ///< returns, by an order
  held,        ///< holds, by an order
  waiting,     ///< holds, by the ladder
  landing,     ///< also what a lost odometry leaves
  taken_over,  ///< a pilot, or a failsafe of the autopilot, flies
  done,
};
inline constexpr std::size_t kSituations = 13;

[[nodiscard]] const char* to_string(Situation situation);

enum class OrderAct : std::uint8_t {
  refuse,
  nothing,       ///< it is so already
  keep,          ///< on the ground
  disarm,        ///< and keep on the ground
  end,           ///< on the ground, motors off
  hold,          ///< now
  hold_later,    ///< when the climb, or the ladder's hold, is over
  go_on,         ///< no longer held by an order
  tour_again,    ///< after a return that was ordered
  return_home,   ///< now
  return_later,  ///< when the ladder's hold is over
  land,
  land_now,   ///< without looking for a better place
  take_back,  ///< from who flies, where the flight controller agrees
};

struct OrderRule {
  OrderAct act = OrderAct::refuse;
  const char* text = "";  ///< what happens and until when, or why not

  bool operator==(const OrderRule&) const = default;
};

/// A cell of the table, as long as the ladder has no say.
[[nodiscard]] OrderRule order_rule(Situation situation, OrderKind kind);

/// What an order comes to: the cell, unless the ladder is on a rung that it would undo.
struct OrderRuling {
  OrderAct act = OrderAct::refuse;
  std::string text;
};
[[nodiscard]] OrderRuling ruling(Situation situation, OrderKind kind, const SafetyDecision& safety);

/// What orders leave behind in a mission, from one step to the next.
struct StandingOrders {
  bool held = false;        ///< by an order, also while the ladder holds or somebody else flies
  bool recalled = false;    ///< on the way home by an order
  bool ending = false;      ///< on the ground: waits for motors off
  bool taken_over = false;  ///< somebody else flies, until an operator resumes
  bool regaining = false;   ///< resumed; setpoints are not obeyed yet
  Time held_since = 0;      ///< in flight: the last order to hold
  Time since = 0;           ///< when the mission's own time stopped; 0: it runs
  std::optional<OrderReply> motors_off;  ///< on the ground: to be said when they are
  std::optional<Order> taking_back;
  Time taken_back = 0;  ///< the flight controller agreed to `taking_back`; 0: not yet
  std::vector<OrderReply> replies;

  static constexpr std::size_t kMostReplies = 16;

  /// Of an order that came before; null: it is new.
  [[nodiscard]] const OrderReply* reply_to(std::int64_t id) const;
  /// Kept for who asks again; the oldest goes.
  const OrderReply& keep(OrderReply reply);
};

}  // namespace saker::autonomy
