#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/bus/object_messages.h"
#include "flight/bus/presence.h"
#include "flight/executive/blackboard.h"
#include "flight/executive/bus_listener.h"
#include "flight/executive/flight_line.h"
#include "flight/executive/guidance_loop.h"
#include "flight/executive/health_counters.h"
#include "flight/executive/loop.h"
#include "flight/executive/loop_faults.h"
#include "flight/executive/order_receiver.h"
#include "flight/executive/robot_exchange.h"
#include "flight/executive/safety_loop.h"
#include "flight/executive/sensor_line.h"
#include "flight/executive/stage_timings.h"
#include "flight/process/configuration.h"
#include "flight/process/service.h"
#include "saker/autonomy/body_pose.h"
#include "saker/autonomy/supervisor.h"

/// The autonomy executive: the stages of `modules/autonomy` under real time, one thread a loop.
///
///     UDP ─▶ sensor ─▶ ingestion ─▶ segmentation ─▶ mapping ─▶ planning ─▶ guidance ─▶ LCM
///                └────▶ pose ◀──┘      LCM ─▶ io ─▶ safety (and mission) ───┘
///                                           └──▶ exchange ◀── mapping
///
/// Loops meet on the blackboard only. Throws at set-up; what a loop throws ends that run alone
/// (loop.h). Guidance and safety decide over the vehicle and wait for no other loop: one that hangs
/// or is switched off ends in what safety makes of the age of what it made, which is a hold, then
/// a landing, and nothing for what only informs (exchange, this object's own thread, the log). The
/// watchdog is fed by a thread of its own as long as safety runs, whoever else hangs. Guidance that
/// hangs is no reason to starve it: the flight controller holds, then safety lands on odometry,
/// which a restart would end.
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
  /// request lands, the second one ends at once. Feeds the watchdog of `service`, which has to
  /// outlive this, until this is destroyed, and sets `mark` when nothing is missing any more: no
  /// mark, no arming.
  /// \return whether the mission succeeded
  [[nodiscard]] bool run(Service& service, const FlightMark& mark);

  /// Map, trajectories and timings, as `saker replay` leaves them, and history.bin, what this
  /// flight has to tell. After `run`. What belongs to a loop that hangs is left out, with a line.
  void save(const std::filesystem::path& out);
  /// What this flight has to tell. After `run`.
  [[nodiscard]] slam::History history() const;
  /// Whether every loop of these ended within `run`; of no names: of all. Where one did not, this
  /// must not be destroyed: the process is to be left (_Exit).
  [[nodiscard]] bool ended(std::initializer_list<const char*> names = {}) const;

 private:
  void make_loops();
  void start_watchdog(Service& service);
  [[nodiscard]] bool start_loops();
  [[nodiscard]] bool wait_for_sensor();
  void look(Service& service, const FlightMark& mark, FlightLine& line, int look);
  void guarded(const std::function<void()>& words);
  void hand_over();
  void stop();
  void save_flown(const std::filesystem::path& out) const;

  LoopStatus io();
  LoopStatus sensor();
  void take_packet(SensorLine::Packet packet);
  LoopStatus ingest();
  void take_scan(autonomy::IngestedScan scan);
  LoopStatus segment();
  LoopStatus map();
  LoopStatus pose();
  LoopStatus plan();
  void send_trajectory(Time now);
  LoopStatus exchange();

  void publish_mission(const autonomy::MissionEvent* event);
  void publish_plan(const autonomy::Planning::Output& output);
  void publish_map(const autonomy::MapSnapshot& map);
  void say_events(const FlightMark& mark);
  void say_sensor();
  void say_health();
  [[nodiscard]] HealthFigures health_figures() const;
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
  StageTimings timings_;

  // Each is used by its own loop alone.
  SensorLine sensor_line_;
  SensorNews sensor_news_;
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
  autonomy::ContactSense contact_;
  autonomy::Planning planning_;
  std::vector<std::pair<Time, active::Viewpoint>> viewpoints_;  // flown to, in their order
  std::shared_ptr<const autonomy::Planning::Output> newest_plan_, plan_before_;
  GuidanceLoop guidance_;
  std::int64_t sent_trajectory_ = 0;
  BusListener listener_;
  OrderReceiver order_receiver_;
  autonomy::Supervisor supervisor_;
  SafetyLoop safety_;
  std::chrono::steady_clock::time_point announced_;
  long io_cut_turns_ = 0;  // after which a network had more

  RobotExchange* exchange_;  // null: it tells nobody
  const std::vector<std::pair<std::string, long>> figures_;

  LoopFaultLog faults_;
  long main_threw_ = 0;
  bool lands_alone_said_ = false;
  Time took_off_ = 0;
  autonomy::MissionEvent last_event_;
  autonomy::PlanningReport tour_report_;
  double ran_s_ = 0, ran_cpu_s_ = 0;          // what `run` took
  std::vector<std::unique_ptr<Loop>> loops_;  // last: their threads use what stands above
  std::unique_ptr<Loop> watchdog_;
};

}  // namespace saker::flight
