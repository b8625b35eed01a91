#include "saker/autonomy/local_checker.h"

#include <utility>

namespace saker::autonomy {

LocalChecker::LocalChecker(const LocalCheckerConfig& config,
                           const motion::CollisionCheckerConfig& checker,
                           const motion::ClearanceConfig& clearance)
    : config_(core::checked(config, "local_checker")),
      checker_(checker, clearance),
      verdict_schedule_(config.verdict_hz),
      block_schedule_(config.block_hz) {}

void LocalChecker::step_to(Time time) {
  now_ = time;
  while (const auto scan = scans_.take(time)) {
    (void)checker_.integrate(scan->stamp, scan->T_odom_lidar, *scan->points);
  }
  if (verdict_schedule_.due(time)) verdict_ = checker_.verdict(time);
  if (checker_.map().stamp() == 0 || !block_schedule_.due(time)) return;
  grid_ = std::make_shared<const occupancy::OccupancyGrid>(checker_.grid());
}

void LocalChecker::send(const RegisteredScan& scan) {
  scans_.push(now_ + from_seconds(config_.latency_s), scan);
}

/// One that it refuses gets no verdict, and guidance stops.
void LocalChecker::send(const motion::Trajectory& trajectory) {
  (void)checker_.set_trajectory(trajectory);
}

std::optional<motion::Verdict> LocalChecker::take_verdict() {
  return std::exchange(verdict_, std::nullopt);
}

std::shared_ptr<const occupancy::OccupancyGrid> LocalChecker::take_grid() {
  return std::exchange(grid_, nullptr);
}

}  // namespace saker::autonomy
