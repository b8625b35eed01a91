#pragma once

#include <string>
#include <vector>

#include "flight/viewers/robot_state.h"

namespace saker::flight::viewers {

/// What the mission does, for people: plain sentences.
struct MissionWords {
  std::string ladder;         ///< the rung of the safety ladder, as safety.h names them
  std::string waits_for;      ///< what it waits for now
  std::string if_it_goes_on;  ///< what would happen if nothing changed
};

/// Of the phase, the cause of the last transition and the vehicle's mode. \param site  says when a
/// vehicle that holds lands
[[nodiscard]] MissionWords words_of(const RobotState& state, const Site& site);

/// Whether a cause of mission_t is none of those that are as it should be.
[[nodiscard]] bool is_trouble(int cause_code);

/// Of vehicle_state_t: "idle" … ; "unknown" of another value.
[[nodiscard]] std::string mode_word(int mode);
/// Of vehicle_state_t, one word a bit.
[[nodiscard]] std::vector<std::string> fault_words(int faults);
/// Of verdict_t.
[[nodiscard]] std::string verdict_word(int reason);
/// Of odometry_t.
[[nodiscard]] std::string odometry_word(int status);
/// Of mission_t.
[[nodiscard]] std::string cause_word(int code);

}  // namespace saker::flight::viewers
