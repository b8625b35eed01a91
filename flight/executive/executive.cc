#include "flight/executive/executive.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <ranges>
#include <thread>
#include <utility>

#include "flight/bus/messages.h"
#include "flight/process/loop_report.h"
#include "flight/process/process.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_io.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr int kInvalid = 2;             // the process's status after an error
constexpr milliseconds kLook{100};      // of the main thread at what the loops say
constexpr int kLooksPerHealth = 10;     // 1 Hz
constexpr int kHealthsPerProgress = 5;  // a line every 5 s
constexpr double kSensorRate_hz = 200;
// What flies comes first, what feeds it next; maps and plans take what is left.
constexpr int kSafetyPriority = 70, kWatchdogPriority = 68, kGuidancePriority = 65,
              kPosePriority = 60, kSensorPriority = 55, kIoPriority = 50, kIngestionPriority = 20;
constexpr double kWatchdog_hz = 4;  // twice as often as it is fed
// Stages that make something anew in each run: who throws so often in a row has a broken state, and
// what else it holds is worth more. What the pose and the way down hang on is tried for ever.
constexpr int kMostThrows = 3;
// For all loops together: ten times the longest run of a stage on a machine that is busy.
constexpr std::chrono::seconds kLongestEnd{10};

}  // namespace

Executive::Executive(const ProcessConfig& config, const ExecutiveInput& input, Bus& bus,
                     Presence& presence)
    : config_(config),
      sensor_(input.sensor),
      bus_(bus),
      presence_(presence),
      sensor_line_(config.sensor, input.sensor, kSensorRate_hz),
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
      contact_(config.autonomy.contact, lidar::mount_pose(config.autonomy.mount)),
      planning_(config.autonomy.planning, autonomy::active_as_flown(config.autonomy, input.sensor),
                config.autonomy.motion, config.autonomy.objects, input.prior,
                config.autonomy.mission.height_m, uncertainty_),
      guidance_(config.autonomy.guidance, board_, bus),
      listener_(board_, bus_),
      order_receiver_(config_.exchange, bus_, board_.operator_orders, board_.order_reply),
      supervisor_(config.autonomy.safety, config.autonomy.mission, planning_.geofence()),
      safety_(
          {.step = [this](autonomy::SupervisorInput in) { return supervisor_.step(std::move(in)); },
           .mission_done = [this] { return supervisor_.mission().done(); },
           .land_ordered = [] { return stop_requests() > 0; },
           .has_targets = !planning_.active().idle()},
          board_, bus),
      exchange_(input.exchange),
      figures_(input.figures) {
  board_.orders.put(Orders{});
  make_loops();
}

/// After a fault: who ran to the end has asked `ended`.
Executive::~Executive() {
  stop();
  if (ended()) return;
  spdlog::default_logger()->flush();
  std::_Exit(kInvalid);
}

void Executive::make_loops() {
  const auto add = [this](const char* name, double rate_hz, int priority, Loop::Body body,
                          int most_throws = 0) {
    loops_.push_back(std::make_unique<Loop>(name, rate_hz, priority, std::move(body), most_throws));
  };
  const autonomy::Config& config = config_.autonomy;
  add("io", 200, kIoPriority, [this] { return io(); });
  add("sensor", kSensorRate_hz, kSensorPriority, [this] { return sensor(); });
  add("ingestion", 50, kIngestionPriority, [this] { return ingest(); });
  add(
      "segmentation", config.rates.flight_segmentation_hz, 0, [this] { return segment(); },
      kMostThrows);
  add(
      "mapping", config.rates.slam_hz, 0, [this] { return map(); }, kMostThrows);
  add(
      "planning", config.planning.rate_hz, 0, [this] { return plan(); }, kMostThrows);
  add("pose", 100, kPosePriority, [this] { return pose(); });
  add("guidance", 50, kGuidancePriority, [this] { return guidance_.run(); });
  add("safety", 50, kSafetyPriority, [this] { return safety_.run(); });
  if (exchange_ != nullptr)
    add(
        "exchange", 50, 0, [this] { return exchange(); }, kMostThrows);
}

/// The mission's time is the sensor's: without it nothing begins.
bool Executive::wait_for_sensor() {
  const auto deadline = std::chrono::steady_clock::now() +
                        std::chrono::duration<double>(config_.autonomy.mission.preflight_s);
  while (board_.clock.now() == 0) {
    if (stop_requests() > 0) return false;
    if (std::chrono::steady_clock::now() > deadline) {
      spdlog::error("lidar_silent: no packet of the sensor on UDP ports {} and {} for {:g} s",
                    sensor_.lidar_port, sensor_.imu_port, config_.autonomy.mission.preflight_s);
      say_sensor();
      return false;
    }
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

/// Who holds the watchdog restarts the whole process, which is a blind descent.
void Executive::start_watchdog(Service& service) {
  const auto safety = std::ranges::find(loops_, "safety", &Loop::name);
  watchdog_ = std::make_unique<Loop>("watchdog", kWatchdog_hz, kWatchdogPriority,
                                     [&service, &loop = **safety] {
                                       const auto now = Loop::Steady::now();
                                       if (!loop.hangs(now)) service.alive(now);
                                       return LoopStatus{};
                                     });
  watchdog_->start();
}

bool Executive::start_loops() {
  for (auto& loop : loops_) {
    const bool flies = loop->name() == "safety" || loop->name() == "guidance" ||
                       loop->name() == "planning" || loop->name() == "pose";
    if (flies && board_.clock.now() == 0 && !wait_for_sensor()) return false;
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
  start_watchdog(service);
  if (!start_loops()) {
    stop();
    return false;
  }
  for (int look = 1; !board_.mission_done && stop_requests() < 2; ++look) {
    std::this_thread::sleep_for(kLook);
    guarded([&] { this->look(service, mark, line, look); });
  }
  if (board_.mission_done && exchange_ != nullptr) hand_over();
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

/// What this thread says of the others; none of them waits for it.
void Executive::look(Service& service, const FlightMark& mark, FlightLine& line, int look) {
  say_events(mark);
  faults_.say(loops_, Loop::Steady::now());
  if (safety_.lands_alone() && !std::exchange(lands_alone_said_, true))
    spdlog::critical("safety threw again and again: lands without the mission");
  line.show(status());
  if (look % kLooksPerHealth == 0) say_health();
  if (look % (kLooksPerHealth * kHealthsPerProgress) == 0) say_progress(service);
}

/// In flight this thread has no right to end the others by what it throws.
void Executive::guarded(const std::function<void()>& words) {
  try {
    words();
  } catch (const std::exception& error) {
    if (++main_threw_ == 1) spdlog::error("what is said of the flight: {}", error.what());
  }
}

/// Landed: what flew stops, and a base in reach is told what it lacks.
void Executive::hand_over() {
  const auto flew = [](const auto& loop) {
    return loop->name() != "io" && loop->name() != "exchange";
  };
  for (auto& loop : loops_ | std::views::filter(flew)) loop->ask_to_stop();
  const auto stopped = Loop::Steady::now() + kLongestEnd;
  for (auto& loop : loops_ | std::views::filter(flew))
    (void)loop->stop(std::max(Loop::Steady::duration::zero(), stopped - Loop::Steady::now()));
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(config_.exchange.landed_s);
  for (int look = 1; !exchange_->settled() && stop_requests() < 2; ++look) {
    if (std::chrono::steady_clock::now() > end) {
      spdlog::warn("the base lacks some of this flight after {:g} s", config_.exchange.landed_s);
      return;
    }
    std::this_thread::sleep_for(kLook);
    guarded([&] { faults_.say(loops_, Loop::Steady::now()); });
    if (look % kLooksPerHealth == 0) guarded([&] { say_health(); });
  }
  if (exchange_->handed_over()) {
    spdlog::info("the base has this flight, number {}", exchange_->flight());
  } else {
    spdlog::info("no base has all of flight {}: it waits in {}", exchange_->flight(),
                 config_.exchange.folder);
  }
}

/// A loop that hangs is not waited for longer than this.
void Executive::stop() {
  for (auto& loop : loops_) loop->ask_to_stop();
  const auto end = Loop::Steady::now() + kLongestEnd;
  for (auto& loop : loops_) {
    const auto left = std::max(Loop::Steady::duration::zero(), end - Loop::Steady::now());
    if (!loop->stop(left))
      spdlog::critical("{} does not end: what it holds is left where it is", loop->name());
  }
}

bool Executive::ended(std::initializer_list<const char*> names) const {
  return std::ranges::none_of(loops_, [&](const auto& loop) {
    const bool asked = names.size() == 0 || std::ranges::find(names, loop->name()) != names.end();
    return asked && loop->running();
  });
}

double Executive::age_ms(Time stamp) const {
  return stamp == 0 ? NAN : 1e3 * to_seconds(board_.clock.now() - stamp);
}

void Executive::save(const std::filesystem::path& out) {
  if (ended({"mapping", "planning"})) {
    const objects::ObjectMap map = mapping_.map_with_covariance(planning_.active().targets());
    objects::write_map(out / "map.json", map, config_.autonomy.objects);
    objects::write_map(out / "map.smap", map, config_.autonomy.objects);
  } else if (const auto newest = board_.map.latest()) {
    spdlog::error("mapping or planning hangs: the map is that of the last cycle that ended");
    objects::write_map(out / "map.json", newest->map, config_.autonomy.objects);
    objects::write_map(out / "map.smap", newest->map, config_.autonomy.objects);
  }
  save_flown(out);
  core::write_file(out / "timings.csv", timings_.csv());
  save_loops(out / "loops.json");
  if (ended({"mapping"})) {
    core::write_file(out / "history.bin",
                     exchange::packed(history(), config_.autonomy.objects.size(),
                                      autonomy::takeoff_pose(config_.team.takeoff)));
  }
}

/// The rows of trajectories, as far as who made them ended.
void Executive::save_flown(const std::filesystem::path& out) const {
  const auto row = [](Time stamp, const SE3& T) {
    const Eigen::Vector3d t = T.translation();
    const Eigen::Quaterniond q(T.linear());
    return fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.8f} {:.8f} {:.8f} {:.8f}\n",
                       to_seconds(stamp), t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  };
  std::string world, odom, viewpoints;
  if (ended({"ingestion", "mapping"})) {
    for (const ScanRow& scan : rows_)
      world += row(scan.stamp, mapping_.slam().corrected(scan.stamp, scan.T_odom_lidar));
    core::write_file(out / "trajectory.txt", world);
  }
  if (ended({"ingestion"})) {
    for (const ScanRow& scan : rows_) odom += row(scan.stamp, scan.T_odom_lidar);
    core::write_file(out / "odometry.txt", odom);
  }
  if (ended({"planning"})) {
    for (const auto& [stamp, viewpoint] : viewpoints_) viewpoints += row(stamp, viewpoint.pose());
    core::write_file(out / "viewpoints.txt", viewpoints);
  }
}

slam::History Executive::history() const {
  slam::History history = mapping_.slam().history();
  history.robot = bus_.robot();
  history.flight = exchange_ != nullptr ? exchange_->flight() : 1;
  return history;
}

}  // namespace saker::flight
