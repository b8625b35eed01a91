#pragma once

#include <cstdint>
#include <memory>

#include "flight/bus/bus.h"
#include "flight/executive/blackboard.h"
#include "flight/executive/loop.h"
#include "saker/autonomy/guidance.h"

namespace saker::flight {

/// The loop of guidance, 50 Hz — reads orders, proposals and verdicts from the blackboard, makes
/// the setpoint (for the flight controller) and the committed trajectory. It waits for nobody but
/// for who copies a small value, and allocates and frees nothing.
///
/// It distrusts who does not run: orders older than half a second are a hold, since nobody watches
/// the flight then; after a pause of its own that was longer than setpoints live (the vehicle held
/// its place meanwhile, the trajectory ran on) it begins anew where the vehicle is.
class GuidanceLoop {
 public:
  /// What is given has to outlive this. Throws Error on an invalid value.
  GuidanceLoop(const autonomy::GuidanceConfig& config, Blackboard& board, Bus& bus);

  LoopStatus run();

 private:
  void begin_anew(const Orders& orders, Time now);
  void take_proposal(Time now);
  void publish(const std::optional<Setpoint>& setpoint);

  const Time setpoints_live_;
  Blackboard& board_;
  Bus& bus_;
  autonomy::Guidance guidance_;
  int anchors_seen_ = 0;
  Time sent_ = 0;  // the last setpoint; 0: it is silent
  std::shared_ptr<const autonomy::Planning::Output> last_plan_;
  std::shared_ptr<const motion::Trajectory> shown_;  // on the blackboard
};

}  // namespace saker::flight
