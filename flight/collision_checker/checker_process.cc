#include "flight/collision_checker/checker_process.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "flight/bus/counter.h"
#include "flight/bus/messages.h"
#include "flight/bus/occupancy_messages.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kVerdictPeriod{100};
constexpr milliseconds kOccupancyPeriod{500};
constexpr milliseconds kHealthPeriod{1000};

}  // namespace

bool CheckerProcess::Timer::due(Steady::time_point now, LoopMeter* meter) {
  if (now < next) return false;
  const bool first = next == Steady::time_point{};
  if (meter && !first) meter->began_late(now - next);
  next = first || now - next > period ? now + period : next + period;
  return true;
}

CheckerProcess::CheckerProcess(const ProcessConfig& config, Bus& bus)
    : config_(config.autonomy.collision_checker),
      clearance_(config.autonomy.motion.clearance),
      bus_(bus),
      checker_(std::in_place, config_, clearance_),
      verdict_timer_{kVerdictPeriod},
      occupancy_timer_{kOccupancyPeriod},
      health_timer_{kHealthPeriod} {
  subscribe();
}

void CheckerProcess::subscribe() {
  bus_.subscribe<scan_t>([this](const scan_t& chunk) { return hear(chunk); });
  bus_.subscribe<trajectory_t>([this](const trajectory_t& message) { return hear(message); });
  bus_.subscribe<odometry_t>([this](const odometry_t& message) {
    clock_.hear(from_utime(message.utime), Steady::now());
    return true;
  });
}

bool CheckerProcess::hear(const scan_t& chunk) {
  const bool anew = newest_chunk_ && chunk.sequence < newest_chunk_->sequence &&
                    chunk.utime > newest_chunk_->utime;
  const bool clock_anew =
      newest_chunk_ && from_utime(newest_chunk_->utime - chunk.utime) > kNanosecondsPerSecond;
  if (anew || clock_anew) begin_anew();
  if (!newest_chunk_ || chunk.utime > newest_chunk_->utime) {
    newest_chunk_.emplace();
    newest_chunk_->utime = chunk.utime;
    newest_chunk_->sequence = chunk.sequence;
  }
  if (auto scan = joiner_.add(chunk)) {
    clock_.hear(scan->stamp, Steady::now());
    counters_.scans_replaced += scan_.has_value();
    scan_ = std::move(scan);
  }
  return joiner_.accepted();
}

bool CheckerProcess::hear(const trajectory_t& message) {
  auto trajectory = from_lcm(message);
  if (!trajectory) return false;
  clock_.hear(from_utime(message.utime), Steady::now());
  heard_trajectory_ = std::move(trajectory);
  return true;
}

/// Throws nothing: the configuration was good once.
void CheckerProcess::begin_anew() {
  spdlog::warn("scans begin anew: so do map and trajectory");
  checker_.emplace(config_, clearance_);
  joiner_ = ScanJoiner();
  newest_chunk_.reset();
  said_stamp_ = 0;
  scan_.reset();
  heard_trajectory_.reset();
  ++counters_.restarts;
}

void CheckerProcess::step(Steady::time_point now) {
  if (scan_) integrate();
  if (heard_trajectory_) {
    const motion::TrajectoryStatus status =
        checker_->set_trajectory(*std::exchange(heard_trajectory_, std::nullopt));
    if (status != motion::TrajectoryStatus::ok) {
      ++counters_.trajectories_refused;
      spdlog::warn("trajectory refused: {}", to_string(status));
    }
    urgent_ = true;
  }
  const bool periodic = verdict_timer_.due(now, &verdict_meter_);
  const std::optional<Time> sensor_now = clock_.at(now);
  if (sensor_now && (periodic || std::exchange(urgent_, false))) say_verdict(*sensor_now);
  if (occupancy_timer_.due(now, &occupancy_meter_)) say_occupancy();
  if (health_timer_.due(now)) say_health(now);
}

CheckerProcess::Steady::time_point CheckerProcess::next_due() const {
  return std::min({verdict_timer_.next, occupancy_timer_.next, health_timer_.next});
}

std::vector<LoopRow> CheckerProcess::loops() const {
  return {{"scan", scan_meter_.totals()},
          {"verdict", verdict_meter_.totals()},
          {"occupancy", occupancy_meter_.totals()}};
}

void CheckerProcess::integrate() {
  const LoopMeter::Run run(scan_meter_);
  const autonomy::RegisteredScan scan = *std::exchange(scan_, std::nullopt);
  const auto report = checker_->integrate(scan.stamp, scan.T_odom_lidar, *scan.points);
  ++counters_.scans;
  counters_.nodes_dropped += static_cast<long>(report.dropped);
  if (report.status != occupancy::InsertStatus::ok) {
    ++counters_.scans_refused;
    spdlog::debug("scan refused: {}", to_string(report.status));
    return;
  }
  urgent_ = true;
}

void CheckerProcess::say_verdict(Time now) {
  const LoopMeter::Run run(verdict_meter_);
  publish(to_lcm(checker_->verdict(now)));
}

void CheckerProcess::say_occupancy() {
  if (checker_->map().stamp() == said_stamp_) return;
  const LoopMeter::Run run(occupancy_meter_);
  said_stamp_ = checker_->map().stamp();
  for (const occupancy_t& chunk : to_lcm(checker_->grid(), sequence_++)) publish(chunk);
}

void CheckerProcess::say_health(Steady::time_point now) {
  const std::optional<Time> sensor_now = clock_.at(now);
  const Time newest = checker_->map().stamp();
  const double age_ms =
      sensor_now && newest != 0 ? to_seconds(*sensor_now - newest) * 1e3 : std::nan("");
  health_t health{};
  health.utime = to_utime(sensor_now.value_or(0));
  health.process = "saker-collision-checker";
  health.loops = {scan_meter_.take_period(kHealthPeriod, age_ms, counters_.scans_replaced),
                  verdict_meter_.take_period(kHealthPeriod, age_ms, 0),
                  occupancy_meter_.take_period(kHealthPeriod, age_ms, 0)};
  health.num_loops = static_cast<std::int32_t>(health.loops.size());
  health.counters = {counter("scans", counters_.scans),
                     counter("scans_refused", counters_.scans_refused),
                     counter("scans_incomplete", joiner_.counters().incomplete),
                     counter("trajectories_refused", counters_.trajectories_refused),
                     counter("nodes", static_cast<long>(checker_->map().tree().size())),
                     counter("nodes_dropped", counters_.nodes_dropped),
                     counter("restarts", counters_.restarts),
                     counter("not_sent", counters_.not_sent)};
  health.num_counters = static_cast<std::int32_t>(health.counters.size());
  publish(health);
}

}  // namespace saker::flight
