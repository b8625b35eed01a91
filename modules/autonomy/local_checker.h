#pragma once

#include <memory>
#include <optional>

#include "saker/autonomy/delayed.h"
#include "saker/autonomy/schedule.h"
#include "saker/autonomy/stepped.h"
#include "saker/motion/collision_checker.h"

namespace saker::autonomy {

struct LocalCheckerConfig {
  double latency_s = 0.06;
  double verdict_hz = 10;
  double block_hz = 2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("latency_s", latency_s, {0, 1}, "s", "from a scan to the verdict that knows it");
    v.field("verdict_hz", verdict_hz, {1, 100}, "Hz", "verdicts");
    v.field("block_hz", block_hz, {0.2, 20}, "Hz", "occupancy blocks");
  }
};

/// The collision checker in the mission's own process, on the mission's time: what the process
/// `saker-collision-checker` does, as late as it would be there.
class LocalChecker : public SteppedChecker {
 public:
  /// Throws Error on an invalid value.
  LocalChecker(const LocalCheckerConfig& config, const motion::CollisionCheckerConfig& checker,
               const motion::ClearanceConfig& clearance);

  void step_to(Time time) override;

  void send(const RegisteredScan& scan) override;
  void send(const motion::Trajectory& trajectory) override;
  [[nodiscard]] std::optional<motion::Verdict> take_verdict() override;
  [[nodiscard]] std::shared_ptr<const occupancy::OccupancyGrid> take_grid() override;

  [[nodiscard]] const motion::CollisionChecker& checker() const { return checker_; }

 private:
  LocalCheckerConfig config_;
  motion::CollisionChecker checker_;
  Schedule verdict_schedule_;
  Schedule block_schedule_;
  Time now_ = 0;
  Delayed<RegisteredScan> scans_;
  std::optional<motion::Verdict> verdict_;
  std::shared_ptr<const occupancy::OccupancyGrid> grid_;
};

}  // namespace saker::autonomy
