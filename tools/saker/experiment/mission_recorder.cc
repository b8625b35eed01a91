#include "tools/saker/experiment/mission_recorder.h"

#include <fmt/format.h>

namespace saker::tools {
namespace {

constexpr std::size_t kMostEvents = 10'000;  // a mission has some tens
constexpr std::size_t kMostCauses = 100;

/// "no path: closed in by …" and all others of its kind.
std::string cause_of(const autonomy::PlanningReport& report) {
  const std::string text = report.text;
  const std::string what = text.substr(0, text.find(':'));
  return fmt::format("{}: {}", to_string(report.status), what);
}

}  // namespace

MissionRecorder::MissionRecorder(simulation::SimulatedVehicle& vehicle,
                                 const std::filesystem::path& out, const objects::ClassTable& table,
                                 std::shared_ptr<spdlog::logger> log, core::Progress* progress,
                                 std::size_t most_scans)
    : vehicle_(vehicle),
      start_(vehicle.now()),
      truth_(vehicle.true_map()),
      detections_(out, table),
      log_(std::move(log)),
      progress_(progress) {
  cloud_.reserve(most_scans);
  true_poses_.reserve(most_scans);
}

void MissionRecorder::on_scan(const autonomy::IngestedScan& scan) {
  for (const simulation::ScanTruth& truth : vehicle_.take_scan_truth()) {
    true_poses_.push_back({to_seconds(truth.stamp), truth.T_world_lidar});
  }
  cloud_.add(scan.registered.points ? std::span(*scan.registered.points)
                                    : std::span<const Eigen::Vector3f>());
  if (recording_ != nullptr && scan.scan) recording_->add(*scan.scan);
}

void MissionRecorder::on_map(const autonomy::MapSnapshot& map) {
  detections_.add(map.detections);
  viewpoints_.take(map.stamp, map.map, truth_);
}

void MissionRecorder::on_plan(const autonomy::PlanningReport& report,
                              const active::ActivePlan& plan) {
  for (const active::Expectation& flown : plan.flown) {
    if (flown.covariance.rows() < 4) continue;  // a cylinder's: its sizes are not predicted
    const Eigen::Vector2d sd = flown.covariance.diagonal().tail<2>().cwiseSqrt();
    viewpoints_.add(flown.seen_until, flown.target_id, flown.viewpoint_id, sd);
  }
  if (progress_ != nullptr && report.targets > 0) {
    progress_->update(report.visited + report.unreachable, report.targets);
  }
  if (plan.goal && (flown_to_.empty() || flown_to_.back().second.id != plan.goal->id)) {
    flown_to_.emplace_back(report.stamp, *plan.goal);
    const Eigen::Vector3d& p = plan.goal->position;
    log_->debug("{:7.2f} s  target {}, {} pending: to viewpoint {} at ({:.1f}, {:.1f}, {:.1f})",
                to_seconds(report.stamp - start_), plan.goal->target_id, plan.pending,
                plan.goal->id, p.x(), p.y(), p.z());
  }
  using enum autonomy::PlanningStatus;
  if (report.status != refused && report.status != gave_up && report.status != home_unreachable) {
    return;
  }
  log_->debug("{:7.2f} s  {}: {}", to_seconds(report.stamp - start_), to_string(report.status),
              report.text);
  const std::string cause = cause_of(report);
  if (refusals_.contains(cause) || refusals_.size() < kMostCauses) ++refusals_[cause];
}

void MissionRecorder::on_event(const autonomy::MissionEvent& event) {
  const double t = to_seconds(event.stamp - start_);
  log_->info("{:7.2f} s  {} -> {}: {}  {}", t, to_string(event.from), to_string(event.to),
             to_string(event.cause), event.text);
  if (events_.size() >= kMostEvents) {
    ++events_left_out_;
    return;
  }
  events_.push_back({{"t_s", t},
                     {"from", to_string(event.from)},
                     {"to", to_string(event.to)},
                     {"cause", to_string(event.cause)},
                     {"text", std::string(event.text)}});
}

nlohmann::ordered_json MissionRecorder::record() const {
  return {{"refusals", refusals_}, {"events", events_}, {"events_left_out", events_left_out_}};
}

}  // namespace saker::tools
