#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "saker/autonomy/cause.h"
#include "saker/autonomy/command_sender.h"
#include "saker/autonomy/guidance.h"
#include "saker/autonomy/orders.h"
#include "saker/autonomy/planning_report.h"
#include "saker/autonomy/safety.h"
#include "saker/core/config.h"
#include "saker/core/short_list.h"
#include "saker/core/text.h"
#include "saker/core/vehicle.h"

/// The mission's state machine, 50 Hz — reads what the other stages say (safety, planning, the
/// vehicle, acknowledgements), makes orders to guidance and planning, commands to the vehicle and
/// an event with its cause at every transition.
///
///     preflight ─▶ arming ─▶ takeoff ─▶ tour ─▶ return ─▶ landing ─▶ done
///                                        └──── hold ────┘      ▲
///                                               └──────────────┘
///
/// Every wait has a deadline, but one on the ground by order and one while a pilot flies, and what
/// happens then only goes to the right: a mission ends. A hold goes back to what it interrupted, at
/// most `most_holds` times; one by order returns after kOrderedHold_s. Landing alone has no way out
/// but the ground, or that vehicle and lidar are gone: at each deadline the command is given again,
/// and said so. Where there is time (home, an order to land) it first waits for planning to find a
/// place that is fit, at most `place_s`, and says what is wrong with the one below. An operator's
/// orders act as orders.h has them; while a pilot flies the phase is hold. Reads no clock.
namespace saker::autonomy {

enum class MissionPhase { preflight, arming, takeoff, tour, return_home, hold, landing, done };

[[nodiscard]] const char* to_string(MissionPhase phase);

struct MissionConfig {
  double height_m = 3.0;
  double height_tolerance_m = 0.4;
  double settle_s = 2.0;
  double preflight_s = 30;
  double least_classified_share = 0.05;
  double takeoff_s = 20;
  double tour_s = 1500;
  double return_s = 240;
  double landing_s = 60;
  double place_s = 30;
  double gone_s = 3;
  int most_holds = 10;
  CommandConfig command;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("height_m", height_m, {1, 60}, "m",
              "The take-off goes to this height over the ground, within the geofence; the way home "
              "has it, too.");
    v.field("height_tolerance_m", height_tolerance_m, {0.05, 5}, "m", "of the take-off");
    v.setting("settle_s", settle_s, {0, 60}, "s",
              "Nothing may be wrong for so long before the motors are armed.");
    v.setting("preflight_s", preflight_s, {1, 3600}, "s",
              "All that a flight needs must be there within this time.");
    v.field("least_classified_share", least_classified_share, {0, 1}, "",
            "of the points of a scan on the ground: fewer, and segmentation does not work here");
    v.setting("takeoff_s", takeoff_s, {2, 300}, "s",
              "The take-off must reach its height within this time, else it lands.");
    v.setting("tour_s", tour_s, {1, 86400}, "s",
              "All targets together get this time, then it returns.");
    v.setting("return_s", return_s, {1, 3600}, "s",
              "The way home may take this time, then it lands where it is.");
    v.setting("landing_s", landing_s, {5, 600}, "s",
              "It must touch down within this time, else the command is repeated.");
    v.setting("place_s", place_s, {0, 600}, "s",
              "It looks for a fit place to land on for so long, then it lands where it is.");
    v.field("gone_s", gone_s, {1, 600}, "s",
            "landing, neither vehicle nor lidar heard: nothing is left to be flown; then end");
    v.setting("most_holds", most_holds, {0, 1000}, "",
              "A mission may hold so many times; the next time it lands.");
    v.group("command", command, "commands to the flight controller");
  }
};

struct MissionEvent {
  Time stamp = 0;
  MissionPhase from = MissionPhase::preflight;
  MissionPhase to = MissionPhase::preflight;  ///< the same as `from`: something to be said
  Cause cause = Cause::none;
  core::Text text;
};

/// Of a step: more than commands that wait for one.
using Acks = core::ShortList<CommandAck, 16>;

struct MissionInput {
  Time now = 0;
  VehicleState vehicle;
  VehicleOdometry odometry;
  Acks acks;                          ///< since the last step
  std::span<const Finding> findings;  ///< of safety, on the ground and while somebody else flies
  SafetyDecision safety;              ///< in flight
  PlanningReport planning;            ///< the newest
  GuidanceStop stop;                  ///< the last one
  Time plant_heard = 0;               ///< the newest state of the vehicle, or scan
  bool land_ordered = false;          ///< by a signal
  bool marked = true;                 ///< a restart would know of this flight: else it does not arm
  bool looked_up = true;              ///< the column above was looked at: else it does not arm
  std::vector<Order> orders;          ///< of an operator, since the last step
};

/// What holds from one step to the next.
struct MissionOrders {
  GuidanceOrder guidance = GuidanceOrder::silent;
  PlanningOrder planning = PlanningOrder::none;

  bool operator==(const MissionOrders&) const = default;
};

class Mission {
 public:
  explicit Mission(const MissionConfig& config);  ///< throws Error on an invalid value

  struct Output {
    MissionOrders orders;
    std::optional<Command> command;  ///< to be sent now
    bool anchor = false;             ///< guidance is to begin here
    core::ShortList<MissionEvent, 8> events;
    std::optional<OrderReply> reply;  ///< to an operator's order, where it is new or asked again
  };
  [[nodiscard]] Output step(const MissionInput& input);

  [[nodiscard]] MissionPhase phase() const { return phase_; }
  [[nodiscard]] bool flying() const;
  /// A pilot, or a failsafe of the autopilot, flies: the ladder has no say.
  [[nodiscard]] bool taken_over() const { return standing_.taken_over; }
  [[nodiscard]] bool done() const { return phase_ == MissionPhase::done; }
  /// Whether it went as it should: all targets that can be reached, home, landed there.
  [[nodiscard]] bool succeeded() const { return done() && outcome_ == Cause::landed; }
  [[nodiscard]] Cause outcome() const { return outcome_; }  ///< the first cause that ended it early

 private:
  void preflight(const MissionInput& input);
  void arming(const MissionInput& input);
  void takeoff(const MissionInput& input);
  void tour(const MissionInput& input);
  void return_home(const MissionInput& input);
  void hold(const MissionInput& input);
  void landing(const MissionInput& input);
  void come_down(const MissionInput& input, Cause cause, core::Text text);
  [[nodiscard]] bool below_is_fit(const MissionInput& input) const;
  [[nodiscard]] bool seeks(const MissionInput& input);
  void say_stop(const GuidanceStop& stop);
  [[nodiscard]] bool obey_safety(const MissionInput& input);

  // mission_orders.cc
  [[nodiscard]] Situation situation(const MissionInput& input) const;
  void obey_orders(const MissionInput& input);
  void reply(const Order& order, OrderState state, std::string text);
  void act(OrderAct act, const MissionInput& input);
  [[nodiscard]] bool turns_off(OrderAct act, const MissionInput& input) const;
  void act_on_the_ground(OrderAct act, const MissionInput& input);
  void recall(bool later, Cause cause, core::Text text);
  [[nodiscard]] bool stays_on_the_ground(const MissionInput& input);
  [[nodiscard]] bool holds_above();
  [[nodiscard]] bool stays_held(const MissionInput& input);
  void run_own_time();
  [[nodiscard]] bool somebody_else_flies(const MissionInput& input);
  void hand_over();
  void follow_motors_off();
  void begin_take_back(const Order& order, const MissionInput& input);
  void follow_take_back(const MissionInput& input);
  void regain();

  void begin_hold(const SafetyDecision& safety);
  [[nodiscard]] std::optional<Cause> failed_command() const;
  [[nodiscard]] core::Text command_text() const;

  void fail(Cause cause);
  void go(MissionPhase phase, Cause cause, core::Text text);
  void land(Cause cause, core::Text text);
  void say(Cause cause, core::Text text);
  [[nodiscard]] bool overdue(double seconds) const;
  [[nodiscard]] MissionOrders orders() const;

  MissionConfig config_;
  CommandSender commands_;
  MissionPhase phase_ = MissionPhase::preflight;
  MissionPhase interrupted_ = MissionPhase::tour;  // by the hold
  Cause outcome_ = Cause::landed;
  Time now_ = 0;
  Time begun_ = 0;             // the phase
  Time clear_since_ = 0;       // preflight; 0: a fault is there
  Cause fault_ = Cause::none;  // preflight: the last one said
  double takeoff_floor_m_ = NAN;
  Time tour_begun_ = 0;  // the first time: a hold does not begin it anew
  Time return_begun_ = 0;
  Cause hold_cause_ = Cause::none;
  int holds_ = 0;
  int stops_ = 0;        // of guidance, that were said
  bool silent_ = false;  // odometry is lost
  bool land_refusal_said_ = false;
  bool seeking_ = false;                // landing: a fit place, before the command
  bool rests_ = false;                  // since it seeks
  Ground ground_ = Ground::not_looked;  // seeking: what was said last of the place below
  StandingOrders standing_;
  Output out_;
};

}  // namespace saker::autonomy
