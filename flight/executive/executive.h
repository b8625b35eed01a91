#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/bus/object_messages.h"
#include "flight/bus/occupancy_messages.h"
#include "flight/bus/presence.h"
#include "flight/executive/blackboard.h"
#include "flight/executive/flight_line.h"
#include "flight/executive/loop.h"
#include "flight/executive/robot_exchange.h"
#include "flight/process/configuration.h"
#include "flight/process/service.h"
#include "saker/autonomy/body_pose.h"
#include "saker/autonomy/contact.h"
#include "saker/autonomy/supervisor.h"
#include "saker/core/timings.h"
#include "saker/lidar/udp_receiver.h"

/// The autonomy executive: the stages of `modules/autonomy` under real time, one thread a loop.
///
///     UDP ─▶ sensor ─▶ ingestion ─▶ segmentation ─▶ mapping ─▶ planning ─▶ guidance ─▶ LCM
///                └────▶ pose ◀──┘      LCM ─▶ io ─▶ safety (and mission) ───┘
///                                           └──▶ exchange ◀── mapping
///
/// Loops meet on the blackboard only. Throws at set-up, never in a loop.
namespace saker::flight {

struct ExecutiveInput {
  lidar::SensorInfo sensor;
  objects::ObjectMap prior;
  RobotExchange* exchange = nullptr;  ///< has to outlive the executive; null: it tells nobody
  std::vector<std::pair<std::string, long>> figures{};  ///< of the set-up, for `_HEALTH`
};

class Executive {
 public:
  /// Subscribes to `bus`, which has to outlive this, as `presence`. Throws Error on an invalid
  /// configuration, prior map or model, and where a port cannot be had.
  Executive(const ProcessConfig& config, const ExecutiveInput& input, Bus& bus, Presence& presence);
  ~Executive();

  /// Until the mission is done, and a base in reach has what there is to tell. The first stop
  /// request lands, the second one ends at once. Feeds the watchdog of `service` while no loop
  /// hangs, and sets `mark` before it arms. \return whether the mission succeeded
  [[nodiscard]] bool run(Service& service, const FlightMark& mark);

  /// Map, trajectories and timings, as `saker replay` leaves them, and history.bin, what this
  /// flight has to tell. After `run`.
  void save(const std::filesystem::path& out);
  /// What this flight has to tell. After `run`.
  [[nodiscard]] slam::History history() const;

 private:
  void make_loops();
  void subscribe();
  [[nodiscard]] bool start_loops(Service& service);
  [[nodiscard]] bool wait_for_sensor(Service& service);
  void feed_watchdog(Service& service);
  void hand_over(Service& service);
  void stop();

  LoopStatus io();
  LoopStatus sensor();
  void take_packet(std::span<const std::uint8_t> payload);
  LoopStatus ingest();
  void take_scan(autonomy::IngestedScan scan);
  LoopStatus segment();
  LoopStatus map();
  LoopStatus pose();
  LoopStatus plan();
  LoopStatus guide();
  void begin_anew();
  void take_proposal(Time now);
  void send_trajectory(Time now);
  LoopStatus supervise();
  LoopStatus exchange();
  [[nodiscard]] autonomy::SupervisorInput seen(Time now);

  void publish_mission(const autonomy::MissionEvent* event);
  void publish_plan(const autonomy::Planning::Output& output);
  void publish_map(const autonomy::MapSnapshot& map);
  void say_events(const FlightMark& mark);
  void say_health();
  void say_progress(const Service& service);
  [[nodiscard]] FlightStatus status();
  void say_totals() const;
  void save_loops(const std::filesystem::path& file) const;
  [[nodiscard]] const autonomy::PlanningReport& tour_report();
  [[nodiscard]] double age_ms(Time stamp) const;

  struct ScanRow {
    Time stamp;
    SE3 T_odom_lidar;
  };

  ProcessConfig config_;
  lidar::SensorInfo sensor_;
  Bus& bus_;
  Presence& presence_;
  Blackboard board_;
  core::Timings timings_;

  // Each is used by its own loop alone.
  OccupancyJoiner grid_joiner_;
  lidar::UdpReceiver lidar_port_;
  lidar::UdpReceiver imu_port_;
  autonomy::Ingestion ingestion_;
  std::int32_t scan_sequence_ = 0;
  std::vector<ScanRow> rows_;
  segmentation::Segmentation segmentation_;
  autonomy::MotionLog motion_log_;
  autonomy::LabelledWindow window_;
  std::shared_ptr<const uncertainty::Model> uncertainty_;  // null: nothing needs it
  autonomy::Mapping mapping_;
  MapSender map_sender_;
  int map_cycles_ = 0;
  autonomy::BodyPose body_pose_;
  autonomy::Contact contact_;
  autonomy::Planning planning_;
  std::vector<std::pair<Time, active::Viewpoint>> viewpoints_;  // flown to, in their order
  const bool has_targets_;
  autonomy::Guidance guidance_;
  int anchors_seen_ = 0;
  std::int64_t sent_trajectory_ = 0;
  std::shared_ptr<const autonomy::Planning::Output> last_plan_;
  autonomy::Supervisor supervisor_;
  int anchors_ = 0;
  std::chrono::steady_clock::time_point announced_;

  RobotExchange* exchange_;  // null: it tells nobody
  const std::vector<std::pair<std::string, long>> figures_;

  std::string hanging_;  // the loop that was said to hang
  Time took_off_ = 0;
  autonomy::MissionEvent last_event_;
  autonomy::PlanningReport tour_report_;
  double ran_s_ = 0, ran_cpu_s_ = 0;          // what `run` took
  std::vector<std::unique_ptr<Loop>> loops_;  // last: their threads use what stands above
};

}  // namespace saker::flight
