#include "flight/viewers/words.h"

#include <fmt/format.h>

#include <array>
#include <set>

#include "saker/autonomy/cause.h"

namespace saker::flight::viewers {
namespace {

using autonomy::Cause;

template <std::size_t N>
std::string word(const std::array<const char*, N>& words, int index) {
  return index >= 0 && index < static_cast<int>(N) ? words[static_cast<std::size_t>(index)]
                                                   : "unknown";
}

std::string ladder_of(const RobotState& state) {
  if (!state.mission) return "unknown";
  const mission_t& mission = state.mission->message;
  if (state.vehicle && state.vehicle->message.mode == vehicle_state_t::DESCEND) return "silence";
  if (mission.phase == "hold") return "hold";
  if (!is_trouble(mission.cause_code)) return "none";
  if (mission.phase == "landing") return "land";
  return mission.phase == "return" ? "return" : "none";
}

/// The mission's own text without the word of its cause before it.
std::string text_of(const mission_t& mission) {
  const std::string head = cause_word(mission.cause_code) + ": ";
  return mission.cause.starts_with(head) ? mission.cause.substr(head.size()) : mission.cause;
}

/// "what (why)", or without what is not known.
std::string because(const std::string& what, const std::string& why) {
  return why.empty() ? what : what + " (" + why + ")";
}

MissionWords in_flight(const mission_t& mission, const Site& site) {
  const std::string text = text_of(mission);
  if (mission.phase == "tour")
    return {{},
            "nothing: it flies its tour",
            fmt::format("it looks at target {} of {} and goes on to the next", mission.target,
                        mission.targets)};
  if (mission.phase == "return")
    return {{}, because("nothing: it flies home", text), "it lands where it took off"};
  if (mission.phase == "hold")
    return {{},
            text.empty() ? "what it holds for to end" : "the end of: " + text,
            fmt::format("it lands {:g} s after it began to hold", site.land_after_s)};
  if (mission.phase == "landing")
    return {{}, because("the ground: it lands", text), "it disarms on the ground"};
  if (mission.phase == "takeoff")
    return {{}, "its height", "it begins its tour; if it does not climb, it lands"};
  return {{}, text, {}};
}

}  // namespace

bool is_trouble(int code) {
  static const std::set<int> fine = {
      static_cast<int>(Cause::none),          static_cast<int>(Cause::ready),
      static_cast<int>(Cause::armed),         static_cast<int>(Cause::took_off),
      static_cast<int>(Cause::tour_complete), static_cast<int>(Cause::home_reached),
      static_cast<int>(Cause::landed),        static_cast<int>(Cause::recovered),
      static_cast<int>(Cause::ordered)};
  return !fine.contains(code);
}

std::string mode_word(int mode) {
  constexpr std::array kModes = {"idle", "takeoff", "guided", "hold", "land", "descend"};
  return word(kModes, mode);
}

std::vector<std::string> fault_words(int faults) {
  constexpr std::array kFaults = {"no_odometry", "odometry_rejected", "setpoint_expired",
                                  "battery_low", "collision"};
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kFaults.size(); ++i) {
    if ((faults >> i & 1) != 0) words.emplace_back(kFaults[i]);
  }
  return words;
}

std::string verdict_word(int reason) {
  constexpr std::array kReasons = {"none", "occupied", "unknown", "stale_scan", "no_trajectory"};
  return word(kReasons, reason);
}

std::string odometry_word(int status) {
  constexpr std::array kStatus = {"ok", "predicted", "lost"};
  return word(kStatus, status);
}

std::string cause_word(int code) {
  const bool known = code >= 0 && code <= static_cast<int>(autonomy::kLastCause);
  return known ? to_string(static_cast<Cause>(code)) : "unknown";
}

MissionWords words_of(const RobotState& state, const Site& site) {
  MissionWords words;
  if (!state.mission) {
    words.waits_for = "the first word of its mission";
  } else {
    const mission_t& mission = state.mission->message;
    if (mission.phase == "preflight") {
      const std::string text = text_of(mission);
      words.waits_for = text.empty() ? "its checks before the flight" : text;
      words.if_it_goes_on = "it does not take off, and gives up when preflight takes too long";
    } else if (mission.phase == "arming") {
      words.waits_for = "the flight controller to arm";
      words.if_it_goes_on = "it takes off";
    } else if (mission.phase == "done") {
      words.waits_for = because("nothing: the mission is over", text_of(mission));
      words.if_it_goes_on = "nothing: it stands";
    } else {
      words = in_flight(mission, site);
    }
  }
  words.ladder = ladder_of(state);
  return words;
}

}  // namespace saker::flight::viewers
