#pragma once

#include <memory>
#include <optional>

#include "saker/autonomy/config.h"
#include "saker/autonomy/local_checker.h"
#include "tools/saker/faults/faulty_line.h"

namespace saker::tools {

/// The collision checker behind channels that fail, that hangs, and that begins again with nothing.
class FaultyChecker : public autonomy::SteppedChecker {
 public:
  /// \param begin  of the mission; `config` and `schedule` have to outlive this
  FaultyChecker(const autonomy::Config& config, const FaultSchedule& schedule, Time begin);

  void step_to(Time time) override;
  void send(const autonomy::RegisteredScan& scan) override;
  void send(const motion::Trajectory& trajectory) override;
  [[nodiscard]] std::optional<motion::Verdict> take_verdict() override;
  [[nodiscard]] std::shared_ptr<const occupancy::OccupancyGrid> take_grid() override;

 private:
  void deliver();

  const autonomy::Config& config_;
  const FaultSchedule& schedule_;
  Time begin_;
  double now_s_ = 0;
  std::optional<autonomy::LocalChecker> checker_;
  FaultyLine<autonomy::RegisteredScan> scans_;
  FaultyLine<motion::Trajectory> trajectories_;
  FaultyLine<motion::Verdict> verdicts_;
  FaultyLine<std::shared_ptr<const occupancy::OccupancyGrid>> grids_;
};

}  // namespace saker::tools
