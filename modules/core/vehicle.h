#pragma once

#include <cstdint>
#include <string>

#include "saker/core/se3.h"
#include "saker/core/time.h"

/// What crosses between the executive and the flight controller, as plain structs: the LCM messages
/// (`lcmtypes`) hold the same fields. All stamps are the sensor's clock.
namespace saker {

/// What the flight controller is doing.
enum class VehicleMode {
  idle,     ///< on the ground, rotors still or idling
  takeoff,  ///< climbs straight up
  guided,   ///< follows setpoints
  hold,     ///< keeps its place: no valid setpoint
  land,     ///< descends where it is, on odometry
  descend,  ///< levelled, on IMU and barometer alone: there is no odometry that it trusts
};

[[nodiscard]] inline const char* to_string(VehicleMode mode) {
  constexpr const char* kNames[] = {"idle", "takeoff", "guided", "hold", "land", "descend"};
  return kNames[static_cast<int>(mode)];
}

/// Bits of VehicleState::faults.
enum VehicleFault : std::uint32_t {
  kNoOdometry = 1,        ///< none came, or it was too old
  kOdometryRejected = 2,  ///< it contradicts IMU and barometer
  kSetpointExpired = 4,   ///< the last setpoint ran out
  kBatteryLow = 8,
  kCollision = 16,  ///< it has hit something
  kTakenOver =
      32,  ///< a pilot, or a failsafe of the autopilot, flies it: nothing of ours is obeyed
};

/// 50 Hz, flight controller → executive.
struct VehicleState {
  Time stamp = 0;
  bool armed = false;
  VehicleMode mode = VehicleMode::idle;
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< body in a level frame
  double height_m = NAN;       ///< by the barometer, above where it was armed
  double battery_share = NAN;  ///< 0 … 1
  std::uint32_t faults = 0;    ///< VehicleFault bits
};

enum class CommandKind {
  arm,
  disarm,
  takeoff,
  hold,
  land,
  resume,  ///< an operator gives the vehicle back to us after somebody else flew it
};

[[nodiscard]] inline const char* to_string(CommandKind kind) {
  constexpr const char* kNames[] = {"arm", "disarm", "takeoff", "hold", "land", "resume"};
  return kNames[static_cast<int>(kind)];
}

/// Executive → flight controller. Sent again with the same id until it is acknowledged: obeying it
/// twice does what obeying it once does.
struct Command {
  Time stamp = 0;
  std::int64_t id = 0;  ///< ascending
  CommandKind kind = CommandKind::hold;
  double height_m = NAN;  ///< takeoff: above where it stands
};

struct CommandAck {
  Time stamp = 0;
  std::int64_t id = 0;
  bool accepted = false;
  std::string reason;  ///< why not; empty when accepted
};

/// 50 Hz, executive → flight controller: where to be now, in `odom`. Not obeyed after `expiry`.
struct Setpoint {
  Time stamp = 0;
  Time expiry = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);      ///< m, of the body
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(NAN);      ///< m/s
  Eigen::Vector3d acceleration = Eigen::Vector3d::Constant(NAN);  ///< m/s²
  double yaw = NAN;                                               ///< rad
  double yaw_rate = NAN;                                          ///< rad/s
};

enum class VehicleOdometryStatus { ok, predicted, lost };

/// 100 Hz, executive → all: where the body is, LiDAR odometry propagated by the IMU.
struct VehicleOdometry {
  Time stamp = 0;
  SE3 T_odom_body = SE3::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(NAN);          ///< m/s, in `odom`
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Constant(NAN);  ///< rad/s, in body
  Matrix6d covariance = Matrix6d::Constant(NAN);  ///< of the pose: [rotation, translation], right
  VehicleOdometryStatus status = VehicleOdometryStatus::lost;
  int reset_counter = 0;  ///< jumps of `odom` so far
};

}  // namespace saker
