#pragma once

#include "saker/simulation/mission/mission_world.h"
#include "saker/simulation/sensor/lidar_unit.h"
#include "saker/simulation/vehicle/collision.h"

namespace saker::simulation {

/// What is so, for recorders and tests: the pipeline never sees it.
struct VehicleTruth {
  Time stamp = 0;
  SE3 T_world_body = SE3::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, world
  bool airborne = false;
  bool has_flown = false;
  int collisions = 0;            ///< with what is no ground, and touchdowns harder than 2 m/s
  double min_clearance_m = NAN;  ///< of the body's sphere in flight, at most 6; NaN before take-off
  int nearest_label = 0;         ///< SemanticKITTI id of what was nearest then
  double flight_time_s = 0;
  double path_m = 0;
  int events_begun = 0;  ///< of the scenario
};

/// Where the lidar was at a scan's stamp.
struct ScanTruth {
  Time stamp = 0;
  SE3 T_world_lidar = SE3::Identity();
};

/// The whole plant in simulated time: world, vehicle, its flight controller and its LiDAR.
/// Odometry, setpoints and commands in; packets, states and acknowledgements out, at their times.
///
/// Physics at 1 kHz, flight controller at 500 Hz, wind, ground and the lidar's inertial unit at
/// 100 Hz (configured), barometer, contacts and states at 50 Hz; the world moves and beams are cast
/// a packet at a time. Nothing depends on how time is cut into steps: the result is a function of
/// config, seed and what came in at which time, to the byte. Throws nothing after its construction.
/// Cost on one core: see README.md.
class SimulatedVehicle {
 public:
  /// Throws Error on an invalid value or a site without room.
  SimulatedVehicle(const MissionConfig& config, std::uint64_t seed)
      : SimulatedVehicle(config, seed, std::nullopt, seed) {}
  /// One of a team in the world of `seed`. \param own_seed of its instruments and its wind
  SimulatedVehicle(const MissionConfig& config, std::uint64_t seed,
                   const std::optional<TakeoffPlace>& place, std::uint64_t own_seed);

  [[nodiscard]] Time now() const { return now_; }
  /// Does nothing for a time that has passed.
  void step_to(Time time);

  /// What has arrived since the last call, in the order of arrival.
  [[nodiscard]] std::vector<SensorDatagram> take_packets() { return packets_.take_until(now_); }
  /// The newest one, if there is one since the last call.
  [[nodiscard]] std::optional<VehicleState> take_state();
  [[nodiscard]] std::vector<CommandAck> take_acks() { return controller_.take_acks(); }

  void send(const VehicleOdometry& odometry);
  void send(const Setpoint& setpoint) { controller_.receive(setpoint); }
  void send(const Command& command) { controller_.receive(command); }

  [[nodiscard]] const lidar::SensorInfo& sensor() const { return lidar_.info(); }
  [[nodiscard]] const MissionWorld& site() const { return site_; }
  /// The site as rays meet it now.
  [[nodiscard]] const RayCaster& caster() const { return caster_; }
  /// Where the flight controller takes the vehicle to be, in `odom`.
  [[nodiscard]] const OdometryEstimator& odometry() const { return controller_.odometry(); }
  [[nodiscard]] const char* odometry_doubt() const { return controller_.odometry_doubt(); }

  [[nodiscard]] VehicleTruth truth() const;
  /// Objects of the map in `world`, with the returns that hit them so far.
  [[nodiscard]] objects::ObjectMap true_map() const;
  /// Of the revolutions that ended since the last call; at most the last 1000.
  [[nodiscard]] std::vector<ScanTruth> take_scan_truth();

 private:
  void settle();
  void tick();
  void fly();
  void send_imu();
  void at_100_hz();
  void at_50_hz();
  void turn_lidar();
  void probe_ground();
  void watch_contacts();
  void run_events();
  void begin(const ScenarioEvent& event);
  void insert_obstacle(const ScenarioEvent& event);
  void send_mover(const ScenarioEvent& event);
  void move_movers();
  [[nodiscard]] bool every(int ticks) const { return ticks_ % ticks == 0; }
  [[nodiscard]] SE3 body_at(Time time) const;
  [[nodiscard]] SE3 T_world_sim() const { return site_.T_sim_world.inverse(); }

  MissionConfig config_;
  MissionWorld site_;
  RayCaster caster_;
  double plain_m_;  // height of the plain about the world: its lowest point
  SE3 T_body_lidar_;
  Quadrotor body_;
  Wind wind_;
  Barometer barometer_;
  Battery battery_;
  InertialUnit controller_imu_;
  InertialUnit lidar_imu_;
  FlightController controller_;
  CollisionMonitor contacts_;
  LidarUnit lidar_;

  int controller_period_;  // ticks
  int lidar_imu_period_;
  Time start_;
  Time now_;
  std::int64_t ticks_ = 0;
  MotorThrusts thrusts_ = MotorThrusts::Zero();
  Eigen::Vector3d air_ = Eigen::Vector3d::Zero();
  Quadrotor::GroundHeights ground_{};
  std::optional<double> barometer_m_;
  std::deque<std::pair<Time, SE3>> recent_;  // poses of the body, a tick apart: one packet's time

  DatagramQueue packets_;
  std::optional<VehicleState> state_;
  std::deque<ScanTruth> scans_;

  Time took_off_ = 0;
  Time airborne_ticks_ = 0;
  double path_m_ = 0;
  int crashes_ = 0;
  bool was_airborne_ = false;

  std::vector<ScenarioEvent> events_;  // that have not begun
  std::size_t inserted_ = 0;
  struct Mover {
    std::size_t index = 0;  // of the world's movers
    Time since = 0;
    SE3 T_sim_start;
    double speed_mps = 0;  // along its x
  };
  std::vector<Mover> movers_;  // on their way
  Time gust_ends_ = 0;
  bool lidar_on_ = true;
  bool odometry_on_ = true;
  bool odometry_frozen_ = false;
  std::optional<VehicleOdometry> last_odometry_;
};

}  // namespace saker::simulation
