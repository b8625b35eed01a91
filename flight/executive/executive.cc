#include "flight/executive/executive.h"

#include <spdlog/spdlog.h>

#include <thread>

#include "flight/bus/messages.h"
#include "flight/process/loop_report.h"
#include "flight/process/process.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_io.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLook{100};      // of the main thread at what the loops say
constexpr int kLooksPerHealth = 10;     // 1 Hz
constexpr int kHealthsPerProgress = 5;  // a line every 5 s
// What flies comes first, what feeds it next; maps and plans take what is left.
constexpr int kSafetyPriority = 70, kGuidancePriority = 65, kPosePriority = 60,
              kSensorPriority = 55, kIoPriority = 50, kIngestionPriority = 20;

}  // namespace

Executive::Executive(const ProcessConfig& config, const ExecutiveInput& input, Bus& bus,
                     Presence& presence)
    : config_(config),
      sensor_(input.sensor),
      bus_(bus),
      presence_(presence),
      timings_({"odometry", "segmentation", "mapping", "planning"}),
      lidar_port_(input.sensor.lidar_port),
      imu_port_(input.sensor.imu_port),
      ingestion_(config.autonomy.odometry, config.autonomy.standstill, input.sensor,
                 lidar::mount_pose(config.autonomy.mount)),
      segmentation_(config.autonomy.segmentation, config.autonomy.objects,
                    autonomy::up_as_mounted(config.autonomy)),
      window_(config.autonomy.detection.window_s),
      uncertainty_(autonomy::uncertainty_for(config.autonomy)),
      mapping_(config.autonomy.detection, config.autonomy.slam, config.autonomy.objects,
               uncertainty_),
      body_pose_(config.autonomy.body_pose, config.autonomy.odometry.motion.inertial,
                 lidar::mount_pose(config.autonomy.mount)),
      contact_(config.autonomy.contact),
      planning_(config.autonomy.planning, autonomy::active_as_flown(config.autonomy, input.sensor),
                config.autonomy.motion, config.autonomy.objects, input.prior,
                config.autonomy.mission.height_m, uncertainty_),
      has_targets_(!planning_.active().idle()),
      guidance_(config.autonomy.guidance),
      supervisor_(config.autonomy.safety, config.autonomy.mission, planning_.geofence()),
      exchange_(input.exchange),
      figures_(input.figures) {
  board_.orders.put(Orders{});
  subscribe();
  make_loops();
}

Executive::~Executive() { stop(); }

void Executive::subscribe() {
  bus_.subscribe<vehicle_state_t>([this](const vehicle_state_t& message) {
    auto state = from_lcm(message);
    if (state) board_.vehicle.put(std::move(*state));
    return state.has_value();
  });
  bus_.subscribe<command_ack_t>([this](const command_ack_t& message) {
    auto ack = from_lcm(message);
    if (ack) board_.acks.push(std::move(*ack));
    return ack.has_value();
  });
  bus_.subscribe<verdict_t>([this](const verdict_t& message) {
    auto verdict = from_lcm(message);
    if (verdict) board_.verdict.put(std::move(*verdict));
    return verdict.has_value();
  });
  bus_.subscribe<occupancy_t>([this](const occupancy_t& chunk) {
    if (auto grid = grid_joiner_.add(chunk)) board_.grid.put(std::move(*grid));
    return grid_joiner_.accepted();
  });
}

void Executive::make_loops() {
  const auto add = [this](const char* name, double rate_hz, int priority,
                          LoopStatus (Executive::*body)()) {
    loops_.push_back(
        std::make_unique<Loop>(name, rate_hz, priority, [this, body] { return (this->*body)(); }));
  };
  const autonomy::Config& config = config_.autonomy;
  add("io", 200, kIoPriority, &Executive::io);
  add("sensor", 200, kSensorPriority, &Executive::sensor);
  add("ingestion", 50, kIngestionPriority, &Executive::ingest);
  add("segmentation", config.rates.flight_segmentation_hz, 0, &Executive::segment);
  add("mapping", config.rates.slam_hz, 0, &Executive::map);
  add("planning", config.planning.rate_hz, 0, &Executive::plan);
  add("pose", 100, kPosePriority, &Executive::pose);
  add("guidance", 50, kGuidancePriority, &Executive::guide);
  add("safety", 50, kSafetyPriority, &Executive::supervise);
  if (exchange_ != nullptr) add("exchange", 50, 0, &Executive::exchange);
}

/// The mission's time is the sensor's: without it nothing begins.
bool Executive::wait_for_sensor(Service& service) {
  const auto deadline = std::chrono::steady_clock::now() +
                        std::chrono::duration<double>(config_.autonomy.mission.preflight_s);
  while (board_.clock.now() == 0) {
    if (stop_requests() > 0) return false;
    if (std::chrono::steady_clock::now() > deadline) {
      spdlog::error("lidar_silent: no packet on UDP ports {} and {} for {:g} s", sensor_.lidar_port,
                    sensor_.imu_port, config_.autonomy.mission.preflight_s);
      return false;
    }
    std::this_thread::sleep_for(kLook);
    feed_watchdog(service);
  }
  return true;
}

/// Who holds the watchdog restarts the whole process: loops that do not all run are no executive.
void Executive::feed_watchdog(Service& service) {
  const auto now = std::chrono::steady_clock::now();
  for (const auto& loop : loops_) {
    if (!loop->hangs(now)) continue;
    if (loop->name() != hanging_) spdlog::critical("{} hangs: the watchdog starves", loop->name());
    hanging_ = loop->name();
    return;
  }
  service.alive(now);
}

bool Executive::start_loops(Service& service) {
  for (auto& loop : loops_) {
    const bool flies = loop->name() == "safety" || loop->name() == "guidance" ||
                       loop->name() == "planning" || loop->name() == "pose";
    if (flies && board_.clock.now() == 0 && !wait_for_sensor(service)) return false;
    loop->start();
    if (!loop->priority_granted()) {
      spdlog::warn("{}: no real-time priority (limit rtprio); it may be late", loop->name());
    }
  }
  return true;
}

bool Executive::run(Service& service, const FlightMark& mark) {
  if (const std::string fault = lock_memory(); !fault.empty()) {
    spdlog::warn("memory is not locked: {}", fault);
  }
  const auto begin = std::chrono::steady_clock::now();
  const double begin_cpu_s = process_seconds();
  FlightLine line;
  if (!start_loops(service)) return false;
  for (int look = 1; !board_.mission_done && stop_requests() < 2; ++look) {
    std::this_thread::sleep_for(kLook);
    if (stop_requests() > 0) board_.land_ordered = true;
    feed_watchdog(service);
    say_events(mark);
    line.show(status());
    if (look % kLooksPerHealth == 0) say_health();
    if (look % (kLooksPerHealth * kHealthsPerProgress) == 0) say_progress(service);
  }
  if (board_.mission_done && exchange_ != nullptr) hand_over(service);
  service.stopping();
  stop();
  say_events(mark);
  line.show(status());
  say_health();
  say_progress(service);
  ran_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ran_cpu_s_ = process_seconds() - begin_cpu_s;
  say_totals();
  return supervisor_.mission().succeeded();
}

/// Landed: what flew stops, and a base in reach is told what it lacks.
void Executive::hand_over(Service& service) {
  for (auto& loop : loops_) {
    if (loop->name() != "io" && loop->name() != "exchange") loop->stop();
  }
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(config_.exchange.landed_s);
  for (int look = 1; !exchange_->settled() && stop_requests() < 2; ++look) {
    if (std::chrono::steady_clock::now() > end) {
      spdlog::warn("the base lacks some of this flight after {:g} s", config_.exchange.landed_s);
      return;
    }
    std::this_thread::sleep_for(kLook);
    feed_watchdog(service);
    if (look % kLooksPerHealth == 0) say_health();
  }
  if (exchange_->handed_over()) {
    spdlog::info("the base has this flight, number {}", exchange_->flight());
  } else {
    spdlog::info("no base has all of flight {}: it waits in {}", exchange_->flight(),
                 config_.exchange.folder);
  }
}

void Executive::stop() {
  for (auto& loop : loops_) loop->stop();
}

double Executive::age_ms(Time stamp) const {
  return stamp == 0 ? NAN : 1e3 * to_seconds(board_.clock.now() - stamp);
}

void Executive::save(const std::filesystem::path& out) {
  const slam::Slam& slam = mapping_.slam();
  const objects::ObjectMap map = mapping_.map_with_covariance(planning_.active().targets());
  objects::write_map(out / "map.json", map, config_.autonomy.objects);
  objects::write_map(out / "map.smap", map, config_.autonomy.objects);
  std::string world, odom;
  const auto row = [](Time stamp, const SE3& T) {
    const Eigen::Vector3d t = T.translation();
    const Eigen::Quaterniond q(T.linear());
    return fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.8f} {:.8f} {:.8f} {:.8f}\n",
                       to_seconds(stamp), t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  };
  for (const ScanRow& scan : rows_) {
    world += row(scan.stamp, slam.corrected(scan.stamp, scan.T_odom_lidar));
    odom += row(scan.stamp, scan.T_odom_lidar);
  }
  core::write_file(out / "trajectory.txt", world);
  core::write_file(out / "odometry.txt", odom);
  std::string viewpoints;
  for (const auto& [stamp, viewpoint] : viewpoints_) viewpoints += row(stamp, viewpoint.pose());
  core::write_file(out / "viewpoints.txt", viewpoints);
  core::write_file(out / "timings.csv", timings_.csv());
  save_loops(out / "loops.json");
  core::write_file(out / "history.bin",
                   exchange::packed(history(), config_.autonomy.objects.size(),
                                    autonomy::takeoff_pose(config_.team.takeoff)));
}

slam::History Executive::history() const {
  slam::History history = mapping_.slam().history();
  history.robot = bus_.robot();
  history.flight = exchange_ != nullptr ? exchange_->flight() : 1;
  return history;
}

}  // namespace saker::flight
