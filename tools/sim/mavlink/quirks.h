#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flight/mavlink/commands.h"
#include "flight/mavlink/dialect.h"

/// What an autopilot does that nobody would guess: a table, with the source of each row.
///
/// Sources: [R name] a record of ArduCopter 4.6 in its own simulator, ../shared/data/mavlink/
/// behaviour/name.txt; [P] the parameters that flew there, extnav.parm; [X] PX4's sources, read
/// (mode_requirements.cpp, Commander.cpp, mavlink_timesync.cpp, the defaults of COM_*);
/// [–] nothing is recorded: chosen like the other autopilot's, or at once.
namespace saker::tools {

using flight::mavlink::AckResult;
using flight::mavlink::Autopilot;
using flight::mavlink::Dialect;

/// A check that keeps it from arming for a while after boot.
struct ArmingCheck {
  const char* text;
  double until_s;  ///< since boot
};

/// A stream that nobody has to ask for.
struct OwnStream {
  std::uint32_t id;
  double rate_hz;
};

struct Quirks {
  Dialect dialect;
  // Boot, s since it.
  double estimator_s;  ///< the estimator runs: an origin before it is forgotten without a word
  double aligned_s;    ///< the estimator takes odometry
  double origin_s;     ///< from the origin to a place by it
  // Arming.
  std::vector<ArmingCheck> checks;  ///< where all are on (ARMING_CHECK)
  AckResult refusal;                ///< of an order that it does not obey now
  AckResult no_such_mode;
  const char* no_height;      ///< refusals' texts …
  const char* no_home;        ///< … of no origin
  const char* no_odometry;    ///< … of no odometry
  const char* armed_text;     ///< severity 6
  const char* disarmed_text;  ///< severity 6
  double idle_disarm_s;       ///< armed and on the ground
  bool guided_needs_stream;   ///< the mode is refused without setpoints
  bool hold_needs_origin;     ///< the mode cannot be armed in or flown without a global place
  // Take-off and landing.
  double spool_s;           ///< from the order to the climb
  double in_air_s;          ///< from the height reached to `in air`
  double landed_s;          ///< from the touchdown to `on ground`
  double disarm_s;          ///< from `on ground` to disarmed
  double failsafe_pause_s;  ///< from a failsafe's LAND to the descent
  bool pauses;              ///< knows DO_PAUSE_CONTINUE
  bool says_takeoff;        ///< landed_state 3 in a climb
  // Setpoints.
  double setpoint_timeout_s;
  bool flies_on;            ///< at the last velocity until then, and stands there; else LAND
  bool drops_half_targets;  ///< acceleration without velocity: dropped without a word
  // Odometry.
  double least_gap_s;     ///< of two that are taken
  double most_gap_s;      ///< a longer gap: the next one is not taken either
  bool only_local_frd;    ///< frame 20 with child 12 alone
  int refused_estimator;  ///< MAV_ESTIMATOR_TYPE
  double lost_s;          ///< without odometry: it lands by itself
  double lost_flags_s;    ///< … and before it its estimator says so
  const char* lost_text;  ///< severity 2
  std::uint16_t good_flags, no_place_flags;
  int trusted_exchanges;    ///< of TIMESYNC before stamps are believed
  double timesync_hz;       ///< its own questions
  double odometry_delay_s;  ///< VISO_DELAY_MS, EKF2_EV_DELAY
  bool dies_of_nan;
  // The line.
  std::vector<std::uint32_t> modes;  ///< besides its dialect's: others do not exist
  double ground_station_s;           ///< without HEARTBEAT of system 255: LAND; 0: never
  std::vector<OwnStream> streams;
};

/// \param all_checks  of arming; the records were flown with and without
[[nodiscard]] Quirks quirks_of(Autopilot autopilot, bool all_checks = true);

}  // namespace saker::tools
