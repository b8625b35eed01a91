#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/autonomy/config.h"
#include "saker/autonomy/delayed.h"
#include "saker/autonomy/lockstep.h"
#include "saker/autonomy/pipeline.h"
#include "saker/autonomy/schedule.h"
#include "saker/autonomy/stage_delays.h"
#include "saker/autonomy/stepped.h"
#include "saker/autonomy/supervisor.h"
#include "saker/autonomy/worker_pool.h"
#include "saker/core/timings.h"
#include "saker/lidar/sensor_gate.h"

/// The lockstep driver of a flown mission: every loop of the executive on the plant's time, in a
/// fixed order, each result as late as on the vehicle's computer (`latency`).
///
///     every 10 ms: plant ─▶ packets ─▶ pose of the body ─▶ plant
///                     └─ scan ─▶ odometry ─▶ collision checker
///                                   └─ labels ─▶ detection, SLAM ─▶ planning ─▶ proposal
///     every 20 ms: safety, mission, guidance ─▶ setpoint, command ─▶ plant
///
/// Segmentation, mapping and planning may be computed side by side on workers while their latency
/// runs; when they are taken follows from the stamps alone: the result is the same to the byte for
/// any number of threads.
namespace saker::autonomy {

/// Hears what happens, in order, on the driver's thread.
class MissionObserver {
 public:
  virtual ~MissionObserver() = default;
  virtual void on_scan(const IngestedScan& /*scan*/) {}
  virtual void on_map(const MapSnapshot& /*map*/) {}
  virtual void on_plan(const PlanningReport& /*report*/, const active::ActivePlan& /*plan*/) {}
  virtual void on_event(const MissionEvent& /*event*/) {}
  virtual void on_reply(const OrderReply& /*reply*/) {}
  /// 50 Hz, in flight.
  virtual void on_setpoint(const Setpoint& /*setpoint*/, const VehicleOdometry& /*odometry*/) {}
};

struct MissionCounters {
  int scans = 0;
  int scans_not_registered = 0;
  int scans_not_held = 0;  ///< registered, where nothing in sight held the pose in a direction
  int labelled_scans = 0;
  int slam_cycles = 0;
  int plans = 0;
  int refused_plans = 0;
  int commits = 0;
  int refused_commits = 0;  ///< late, or begun on what was no longer flown
  int stops = 0;            ///< by the verdict, or a hold
};

struct MissionResult {
  bool succeeded = false;  ///< all targets that can be reached, home and landed there
  MissionPhase phase = MissionPhase::preflight;  ///< at the end; done unless time ran out
  Cause outcome = Cause::none;
  double flight_time_s = 0;  ///< from take-off to touch-down
  double path_m = 0;         ///< flown, by odometry
  std::vector<ScanRecord> scans;
  std::vector<SE3> T_world_lidar;  ///< beside `scans`: after SLAM
  objects::ObjectMap map;
  slam::History history;  ///< what other robots are told; robot and flight are the caller's to know
  std::vector<active::Target> targets;
  std::vector<MissionEvent> events;
  MissionCounters counters;
};

class MissionLockstep {
 public:
  /// \param prior    rough places of the targets, `world`
  /// \param threads  in all, this one included
  /// Throws Error on an invalid configuration, prior map or model.
  MissionLockstep(const Config& config, const lidar::SensorInfo& sensor,
                  const objects::ObjectMap& prior, SteppedPlant& plant, SteppedChecker& checker,
                  int threads, core::Timings& timings);
  ~MissionLockstep();

  /// Stages are slower from now on as `delays` says, which has to outlive this; null: as
  /// configured.
  void delay_stages(const StageDelays* delays) { delays_ = delays; }

  /// Until it has landed, or for `limit_s` of the plant's time.
  [[nodiscard]] MissionResult run(double limit_s, MissionObserver& observer);

  /// An operator's order, at any moment, also from inside the plant: heard at the next step of
  /// safety.
  void give(const Order& order) { given_.push_back(order); }

  /// Results that are on their way between the stages.
  [[nodiscard]] std::size_t waiting() const {
    return scans_.size() + labels_.size() + maps_.size() + plans_.size();
  }

 private:
  using Labels = std::shared_future<std::shared_ptr<const lidar::Labels>>;
  using Map = std::shared_future<std::shared_ptr<const MapSnapshot>>;
  using Plan = std::shared_future<Planning::Output>;
  struct Labelled {
    RegisteredScan registered;
    Labels labels;
  };

  void step(Time now);
  void receive(Time now);
  void take_packet(const std::vector<std::uint8_t>& payload, Time now);
  void ingest(Time now);
  void take_scan(const IngestedScan& scan, Time now);
  void segment(const IngestedScan& scan, Time now);
  void map(Time now);
  void check();
  void plan(Time now);
  void take_plan(const Planning::Output& output, Time now);
  void supervise(Time now);
  void guide(Time now);
  void send_trajectory();
  [[nodiscard]] Time due(Stage stage, double latency_s, Time now) const;
  [[nodiscard]] MissionResult finish();

  Config config_;
  core::Timings& timings_;
  SteppedPlant& plant_;
  SteppedChecker& checker_;
  MissionObserver* observer_ = nullptr;  // during a run
  const StageDelays* delays_ = nullptr;

  lidar::SensorGate gate_;
  Ingestion ingestion_;
  BodyPose body_pose_;
  ContactSense contact_;
  MotionLog motion_log_;
  LabelledWindow window_;
  std::shared_ptr<const uncertainty::Model> uncertainty_;  // null: nothing needs it
  Mapping mapping_;
  Planning planning_;
  Guidance guidance_;
  Supervisor supervisor_;
  const lidar::SensorInfo sensor_;

  Schedule segmentation_schedule_;
  Schedule slam_schedule_;
  Schedule planning_schedule_;
  Delayed<IngestedScan> scans_;
  Delayed<Labelled> labels_;
  Delayed<Map> maps_;
  Delayed<Plan> plans_;
  Map last_map_;  // the cycle that was begun last

  // The newest of everything.
  Heard heard_;
  VehicleState vehicle_;
  VehicleOdometry odometry_;
  std::vector<CommandAck> acks_;
  std::shared_ptr<const MapSnapshot> map_;
  std::shared_ptr<const occupancy::OccupancyGrid> grid_;
  std::optional<motion::Verdict> verdict_;
  std::optional<Setpoint> setpoint_;
  PlanningReport report_;
  MissionOrders orders_;
  std::vector<Order> given_;  // by an operator
  std::int64_t sent_trajectory_ = 0;
  bool odd_tick_ = false;
  Time took_off_ = 0;
  MissionResult result_;

  WorkerPool<segmentation::Segmentation> pool_;  // last: its threads use what stands above
};

}  // namespace saker::autonomy
