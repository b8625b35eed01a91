#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "flight/bus/messages.h"
#include "flight/executive/executive.h"
#include "flight/executive/plan_report.h"
#include "flight/process/loop_report.h"

/// What the executive says of itself: MISSION, PLAN, HEALTH, and lines.
namespace saker::flight {
void Executive::publish_mission(const autonomy::MissionEvent* event) {
  if (event != nullptr) last_event_ = *event;
  mission_t message{};
  message.utime = to_utime(board_.clock.now());
  message.phase = to_string(last_event_.to);
  const autonomy::PlanningReport& report = tour_report();
  message.targets = report.targets;
  message.target = std::min(report.visited + report.unreachable + 1, report.targets);
  message.elapsed_s =
      took_off_ == 0 ? NAN : static_cast<float>(to_seconds(board_.clock.now() - took_off_));
  message.cause_code = static_cast<std::int32_t>(last_event_.cause);
  message.cause = shortened(fmt::format("{}: {}", to_string(last_event_.cause), last_event_.text),
                            mission_t::MAX_CAUSE);
  if (const auto reply = board_.order_reply.latest()) write_reply(*reply, message);
  bus_.publish(message);
}

void Executive::publish_plan(const autonomy::Planning::Output& output) {
  plan_t message{};
  message.utime = to_utime(output.report.stamp);
  const auto committed = board_.committed.latest();
  message.trajectory_id = committed ? committed->id : 0;
  for (const int id : output.plan.tour) {
    if (static_cast<int>(message.tour.size()) < plan_t::MAX_TOUR) message.tour.push_back(id);
  }
  message.num_tour = static_cast<std::int32_t>(message.tour.size());
  write_candidates(output.plan, message);
  message.reason = shortened(output.report.text, plan_t::MAX_REASON);
  bus_.publish(message);
}

void Executive::say_events(const FlightMark& mark) {
  for (const autonomy::MissionEvent& event : board_.events.take_all()) {
    if (event.cause == autonomy::Cause::ready && !board_.marked) {
      board_.marked = mark.set();
      if (!board_.marked)
        spdlog::error("the flight cannot be marked: a restart would not know of it, so it stays");
    }
    if (event.cause == autonomy::Cause::armed) took_off_ = event.stamp;
    spdlog::info("{} → {}: {}: {}", to_string(event.from), to_string(event.to),
                 to_string(event.cause), event.text);
    publish_mission(&event);
  }
  if (board_.order_reply.take() != nullptr) publish_mission(nullptr);
}

/// Of the tour, also when it is over.
const autonomy::PlanningReport& Executive::tour_report() {
  const auto plan = board_.plan.latest();
  if (plan && plan->report.targets > 0) tour_report_ = plan->report;
  return tour_report_;
}

/// Who is believed, and what was not.
void Executive::say_sensor() {
  const auto figures = sensor_line_.figures();
  if (figures == nullptr) return;
  for (const std::string& line : sensor_news_.lines(*figures, std::chrono::steady_clock::now()))
    spdlog::warn(line);
}

HealthFigures Executive::health_figures() const {
  HealthFigures figures;
  figures.faults = LoopFaultLog::counters(loops_, Loop::Steady::now());
  if (safety_.lands_alone()) figures.faults.emplace_back("safety_lands_alone", 1);
  if (main_threw_ > 0) figures.faults.emplace_back("main_threw", main_threw_);
  const auto vehicle = board_.vehicle.latest();
  if (!vehicle || !autonomy::BatteryWatch::is_known(vehicle->battery_share))
    figures.faults.emplace_back("battery_unknown", 1);
  figures.orders = {{"orders_refused", order_receiver_.refused()}};
  if (const auto sensor = sensor_line_.figures())
    figures.sensor = health_of(*sensor, HealthFigures::kMostSensor);
  figures.drops = {{"stamps_ahead", listener_.ahead()},
                   {"packets_dropped", board_.packets.dropped()},
                   {"imu_dropped", board_.imu.dropped()},
                   {"labelled_dropped", board_.labelled.dropped()},
                   {"events_dropped", board_.events.dropped()}};
  if (exchange_ != nullptr) figures.exchange = exchange_->figures();
  figures.team = figures_;
  return figures;
}

void Executive::say_health() {
  for (const std::string& line : order_receiver_.take_lines()) spdlog::warn(line);
  publish_mission(nullptr);
  say_sensor();
  health_t message{};
  message.utime = to_utime(board_.clock.now());
  message.process = "saker-flight";
  for (const auto& loop : loops_) {
    if (const auto health = loop->health()) message.loops.push_back(*health);
  }
  message.num_loops = static_cast<std::int32_t>(message.loops.size());
  message.counters = health_counters(health_figures());
  message.num_counters = static_cast<std::int32_t>(message.counters.size());
  bus_.publish(message);
}

void Executive::say_progress(const Service& service) {
  std::string loops;
  double cpu = 0;
  for (const auto& loop : loops_) {
    const auto health = loop->health();
    if (health == nullptr) continue;
    if (!std::isnan(health->cpu)) cpu += health->cpu;
    loops += fmt::format(" {} {:.1f}/{:.1f} ms", loop->name(), health->median_ms, health->p95_ms);
    if (health->misses > 0) loops += fmt::format(" ({} late)", health->misses);
  }
  const autonomy::PlanningReport& report = tour_report();
  const std::string status = fmt::format(
      "{}, target {} of {}, {:.2f} CPU", to_string(last_event_.to),
      std::min(report.visited + report.unreachable + 1, report.targets), report.targets, cpu);
  service.say(status);
  spdlog::info(status);
  spdlog::debug("loops:{}", loops);
}

FlightStatus Executive::status() {
  const autonomy::PlanningReport& report = tour_report();
  FlightStatus status{.phase = to_string(last_event_.to),
                      .target = std::min(report.visited + report.unreachable + 1, report.targets),
                      .targets = report.targets,
                      .worst_loop = {}};
  if (const auto vehicle = board_.vehicle.latest()) {
    status.height_m = vehicle->height_m;
    status.battery_share = vehicle->battery_share;
  }
  if (const auto verdict = board_.verdict.latest()) status.clearance_m = verdict->clearance_m;
  for (const auto& loop : loops_) {
    const auto health = loop->health();
    if (health == nullptr || !(health->worst_lateness_ms > 0)) continue;
    if (health->worst_lateness_ms <= status.lateness_ms) continue;
    status.worst_loop = loop->name();
    status.lateness_ms = health->worst_lateness_ms;
  }
  return status;
}

void Executive::say_totals() const {
  for (const auto& loop : loops_) {
    if (loop->running()) continue;  // it hangs, and was named
    const LoopMeter::Totals& totals = loop->totals();
    spdlog::info("{}: {} of {} runs late, at most {:.1f} ms; {:.3f} CPU seconds a second",
                 loop->name(), totals.misses, totals.runs, totals.worst_lateness_ms,
                 totals.cpu_s / ran_s_);
  }
  spdlog::info("all threads: {:.2f} CPU seconds a second", ran_cpu_s_ / ran_s_);
}

void Executive::save_loops(const std::filesystem::path& file) const {
  std::vector<LoopRow> rows;
  for (const auto& loop : loops_) {
    if (!loop->running()) rows.push_back({loop->name(), loop->totals()});
  }
  write_loops(file, ran_s_, ran_cpu_s_, rows);
}

}  // namespace saker::flight
