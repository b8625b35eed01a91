#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "saker/core/vehicle.h"
#include "saker/motion/trajectory.h"
#include "saker/occupancy/grid.h"

/// What lies outside of the autonomy, behind interfaces: in one process on simulated time
/// (lockstep) or over UDP and LCM (real time). No call blocks.
namespace saker::autonomy {

/// A UDP payload of the sensor, lidar or inertial.
struct SensorPacket {
  Time received = 0;
  std::vector<std::uint8_t> payload;
};

/// The vehicle: sensor packets out, setpoints in.
class Plant {
 public:
  virtual ~Plant() = default;

  /// What came since the last call, in the order of arrival.
  [[nodiscard]] virtual std::vector<SensorPacket> take_packets() = 0;
  /// The newest one, if it came since the last call.
  [[nodiscard]] virtual std::optional<VehicleState> take_state() = 0;
  [[nodiscard]] virtual std::vector<CommandAck> take_acks() = 0;

  virtual void send(const VehicleOdometry& odometry) = 0;
  virtual void send(const Setpoint& setpoint) = 0;
  virtual void send(const Command& command) = 0;
};

/// A deskewed scan with its pose, for the collision checker.
struct RegisteredScan {
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
  std::shared_ptr<const std::vector<Eigen::Vector3f>> points;        ///< lidar frame at `stamp`
  std::shared_ptr<const std::vector<float>> reflectivity = nullptr;  ///< 0 … 1, one a point; null:
                                                                     ///< unknown
};

/// The collision checker, which alone writes occupancy.
class CollisionCheckerLink {
 public:
  virtual ~CollisionCheckerLink() = default;

  virtual void send(const RegisteredScan& scan) = 0;
  virtual void send(const motion::Trajectory& trajectory) = 0;
  /// The newest ones, if they came since the last call.
  [[nodiscard]] virtual std::optional<motion::Verdict> take_verdict() = 0;
  [[nodiscard]] virtual std::shared_ptr<const occupancy::OccupancyGrid> take_grid() = 0;
};

}  // namespace saker::autonomy
