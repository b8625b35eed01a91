#include "tools/saker/faults/faulty_checker.h"

namespace saker::tools {

FaultyChecker::FaultyChecker(const autonomy::Config& config, const FaultSchedule& schedule,
                             Time begin)
    : config_(config),
      schedule_(schedule),
      begin_(begin),
      scans_(schedule, FaultPlace::scans),
      trajectories_(schedule, FaultPlace::trajectory),
      verdicts_(schedule, FaultPlace::verdict),
      grids_(schedule, FaultPlace::occupancy) {}

void FaultyChecker::step_to(Time time) {
  now_s_ = to_seconds(time - begin_);
  const bool gone = acting(schedule_, FaultKind::restart, FaultPlace::checker, now_s_) != nullptr;
  const bool hangs = acting(schedule_, FaultKind::stall, FaultPlace::checker, now_s_) != nullptr;
  if (gone) checker_.reset();
  if (gone || hangs) {
    (void)scans_.take(now_s_);  // its socket holds next to nothing of them
    return;
  }
  if (!checker_) {
    checker_.emplace(config_.local_checker, config_.collision_checker, config_.motion.clearance);
  }
  deliver();
  checker_->step_to(time);
  if (const auto verdict = checker_->take_verdict()) verdicts_.put(now_s_, *verdict);
  if (auto grid = checker_->take_grid()) grids_.put(now_s_, std::move(grid));
}

void FaultyChecker::deliver() {
  for (const autonomy::RegisteredScan& scan : scans_.take(now_s_)) checker_->send(scan);
  for (const motion::Trajectory& trajectory : trajectories_.take(now_s_))
    checker_->send(trajectory);
}

void FaultyChecker::send(const autonomy::RegisteredScan& scan) { scans_.put(now_s_, scan); }

void FaultyChecker::send(const motion::Trajectory& trajectory) {
  trajectories_.put(now_s_, trajectory);
}

std::optional<motion::Verdict> FaultyChecker::take_verdict() {
  const auto verdicts = verdicts_.take(now_s_);
  return verdicts.empty() ? std::nullopt : std::optional(verdicts.back());
}

std::shared_ptr<const occupancy::OccupancyGrid> FaultyChecker::take_grid() {
  auto grids = grids_.take(now_s_);
  return grids.empty() ? nullptr : std::move(grids.back());
}

}  // namespace saker::tools
