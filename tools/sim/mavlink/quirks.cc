#include "tools/sim/mavlink/quirks.h"

#include "mavlink/messages.h"

namespace saker::tools {
namespace {

using namespace flight::mavlink;

constexpr double kNever = 1e9;

Quirks ardupilot(bool all_checks) {
  Quirks q{};
  q.dialect = dialect_of(Autopilot::ardupilot);
  q.estimator_s = 6.19;  // [R more_acks] the origin of 4.185 was not seen, that of 10.889 was
  q.aligned_s = 7.33;    // [R more_acks] is using external nav data, without an origin as well
  q.origin_s = 0.24;     // [R basic_50_50, final_40_30] pos_abs after 0.25 to 0.30
  // [R basic_50_50, final_40_30] both refusals; the other flights had these checks off.
  if (all_checks)
    q.checks = {{"Arm: Accels inconsistent", 14.5}, {"Arm: Gyros inconsistent", 24.5}};
  q.refusal = AckResult::failed;                // [R more_acks]
  q.no_such_mode = AckResult::failed;           // [R more_acks] mode 99
  q.no_height = "Arm: Need Alt Estimate";       // [R more_acks]
  q.no_home = "Arm: AHRS: waiting for home";    // [R more_acks]
  q.no_odometry = "Arm: VisOdom: not healthy";  // ArduPilot's sources, AP_Arming
  q.armed_text = "Arming motors";               // [R more_acks]
  q.disarmed_text = "Disarming motors";         // [R more_acks]
  q.idle_disarm_s = 9.98;                       // [R more_acks] 14.102 to 24.082
  q.guided_needs_stream = false;                // [R more_acks] guided before the estimator
  q.hold_needs_origin = false;                  // its hold is guided
  q.spool_s = 3.3;                              // [R basic_50_50] landed_state 3
  q.in_air_s = 0.37;                            // [R basic_50_50] landed_state 2
  q.landed_s = 1.67;                            // [R more_acks2] hit ground to landed_state 1
  q.disarm_s = 0.4;                             // [R more_acks2]
  q.failsafe_pause_s = 4;       // [R fail_odom_stop, fail_hb_255] 12.1 s from LAND to the ground
  q.pauses = true;              // [R more_acks2] 193
  q.says_takeoff = true;        // [R basic_50_50]
  q.setpoint_timeout_s = 0.5;   // [P] GUID_TIMEOUT
  q.flies_on = true;            // [R fail_sp_stop_t05]
  q.drops_half_targets = true;  // [R more_acks2] mask 0x838
  q.least_gap_s = 0.02;         // issue text: one in 20 ms
  q.most_gap_s = kNever;        // [R fail_odom_gap2] 6 s are bridged
  q.only_local_frd = true;      // issue text
  q.refused_estimator = -1;
  q.lost_s = 7.94;                                     // [R fail_odom_stop, fail_qual_bad]
  q.lost_flags_s = 7.4;                                // [R fail_odom_stop] 0x25
  q.lost_text = "EKF Failsafe: changed to LAND Mode";  // [R fail_odom_stop]
  q.good_flags = 0x33F;                                // [R fail_odom_stop]
  q.no_place_flags = 0x25;                             // [R fail_odom_stop]
  q.trusted_exchanges = 0;                             // the least late stamp counts
  q.timesync_hz = 0.1;                                 // [R basic_50_50] TIMESYNC_REQ
  q.odometry_delay_s = 0.01;                           // of ours in the simulator
  q.dies_of_nan = true;                                // [R more_acks] floating point exception
  q.ground_station_s = 5;      // ArduPilot's FS_GCS_TIMEOUT; [R fail_hb_255], not with system 1
  q.modes = {0, 2, 5, 6, 17};  // [R more_acks, more_acks2]
  q.streams = {{Heartbeat::kId, 1}};  // issue text: little unasked
  return q;
}

Quirks px4() {
  Quirks q{};
  q.dialect = dialect_of(Autopilot::px4);
  q.estimator_s = 4;                                 // [–]
  q.aligned_s = 5;                                   // [–]
  q.origin_s = 0.3;                                  // [–]
  q.refusal = AckResult::temporarily_rejected;       // [X] Commander
  q.no_such_mode = AckResult::temporarily_rejected;  // [X] Commander
  // [X] Commander: one text for all of them.
  q.no_height = q.no_home = q.no_odometry = "Arming denied: Resolve system health failures first";
  q.armed_text = "Armed by external command";                // [X] Commander
  q.disarmed_text = "Disarmed by auto preflight disarming";  // [X] Commander
  q.idle_disarm_s = 10;                                      // [X] COM_DISARM_PRFLT
  q.guided_needs_stream = true;                              // [X] mode_req_offboard_signal
  q.hold_needs_origin = true;                   // [X] mode_req_global_position of AUTO_LOITER
  q.spool_s = 1;                                // [X] COM_SPOOLUP_TIME
  q.in_air_s = 0.3;                             // [–]
  q.landed_s = 1;                               // [–]
  q.disarm_s = 2;                               // [X] COM_DISARM_LAND
  q.failsafe_pause_s = 0;                       // [–]
  q.pauses = false;                             // [–]
  q.says_takeoff = false;                       // [X] landed_state 3 is of its take-off mode alone
  q.setpoint_timeout_s = 1;                     // [X] COM_OF_LOSS_T
  q.flies_on = false;                           // [X] COM_OBL_RC_ACT 4: LAND
  q.drops_half_targets = false;                 // [–]
  q.least_gap_s = 0;                            // [–]
  q.most_gap_s = 0.2;                           // issue text: none when the gap exceeds 0.2 s
  q.only_local_frd = false;                     // [X] mavlink_receiver: LOCAL_NED, too
  q.refused_estimator = 5;                      // issue text: LIDAR
  q.lost_s = 5;                                 // issue text: 5 s of dead reckoning
  q.lost_flags_s = 5;                           // [–]
  q.lost_text = "Failsafe activated: landing";  // [–]
  q.good_flags = 0x3F;        // [X] ESTIMATOR_STATUS: attitude, velocities, places
  q.no_place_flags = 0x25;    // [–]
  q.trusted_exchanges = 500;  // issue text
  q.timesync_hz = 10;         // issue text
  q.odometry_delay_s = 0.01;  // of ours in the simulator
  q.dies_of_nan = false;      // [X] fields that are no number are left out
  q.ground_station_s = 0;     // [X] NAV_DLL_ACT 0
  q.modes = {1U << 16, 3U << 16, 4U << 16 | 5U << 24};  // [X] manual, position, return
  q.streams = {{Heartbeat::kId, 1},       {SysStatus::kId, 1},         {ExtendedSysState::kId, 1},
               {BatteryStatus::kId, 0.5}, {EstimatorStatus::kId, 0.5}, {Attitude::kId, 15},
               {LocalPositionNed::kId, 1}};  // [X] its mode `normal`
  return q;
}

}  // namespace

Quirks quirks_of(Autopilot autopilot, bool all_checks) {
  return autopilot == Autopilot::px4 ? px4() : ardupilot(all_checks);
}

}  // namespace saker::tools
