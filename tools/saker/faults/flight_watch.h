#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "saker/autonomy/mission_lockstep.h"
#include "saker/motion/geofence.h"
#include "saker/motion/limits.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"
#include "tools/saker/faults/fault.h"

namespace saker::tools {

/// What must hold in every flight, whatever goes wrong.
enum class Invariant {
  no_collision,     ///< none that the faults did not make unavoidable
  at_rest,          ///< 2 s after the ladder said hold or land: at rest, or coming down
  in_fence,         ///< never outside by more than it takes to brake
  honest_odometry,  ///< status ok means: off by no more than it states
  cause_said,       ///< nothing is ended, held or refused without a cause in words
  bounded_memory,
  whole_files,  ///< what is on the disk is whole: the newest that could be written
};

[[nodiscard]] const char* to_string(Invariant invariant);

/// An invariant that did not hold: the first time.
struct Breach {
  Invariant invariant = Invariant::no_collision;
  double at_s = 0;
  std::string text;
};

/// Looks on at a flight at every step of 10 ms — reads truth, what was said and what was ordered,
/// makes the list of invariants that did not hold.
///
/// Odometry is held against the truth by its motion over the last two seconds: `odom` may drift. A
/// motion's sd is that of both ends together. Off by more than 5 sd at once, or by more than 3 sd
/// for a second, is a breach while the status is ok.
///
/// A collision is unavoidable where a person or a lorry came to a vehicle that a second before flew
/// towards it by less than 0.5 m/s (stood, or was overtaken), while that passes: what it hits after
/// that counts no more, for the simulator lets it fly on inside a lorry; where a thing appeared
/// within the distance that it takes to see it, think and brake; where the vehicle came down
/// without a pose, which the flight controller does where it is, at less than 0.8 m/s over ground,
/// or by an order to abort, which looks for no place; and where a gust of more than 5 m/s blew
/// within the last second.
class FlightWatch : public autonomy::MissionObserver {
 public:
  /// `schedule` has to outlive this. \param begin of the mission
  FlightWatch(const FaultSchedule& schedule, const motion::GeofenceConfig& fence,
              const motion::LimitsConfig& limits, Time begin);

  void on_step(const simulation::VehicleTruth& truth, const VehicleState& state);
  void on_odometry(const VehicleOdometry& odometry);
  void on_event(const autonomy::MissionEvent& event) override;
  void on_scan(const autonomy::IngestedScan& scan) override;
  void on_plan(const autonomy::PlanningReport& report, const active::ActivePlan& plan) override;
  void on_reply(const autonomy::OrderReply& reply) override;
  void on_ack(const CommandAck& ack);
  /// The executive is gone from now on: what flies holds, then comes down by itself.
  void on_executive_gone(Time now);
  void on_torn_file(const std::string& what);

  [[nodiscard]] std::vector<Breach> breaches() const;
  [[nodiscard]] const std::vector<autonomy::MissionEvent>& events() const { return events_; }
  /// Of all true poses: two flights with the same digest were the same.
  [[nodiscard]] std::string digest() const;

 private:
  struct Pose {
    double t_s = 0;
    Eigen::Vector3d truth = Eigen::Vector3d::Zero();
    Eigen::Vector3d said = Eigen::Vector3d::Zero();
    double variance = 0;  // m², of a coordinate, the largest
    int resets = 0;
    bool good = false;
  };
  struct Motion {  // over ground
    double t_s = 0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  };

  void watch_collisions(const simulation::VehicleTruth& truth, const VehicleState& state);
  void watch_rest(const simulation::VehicleTruth& truth, const VehicleState& state);
  void watch_fence(const simulation::VehicleTruth& truth, const VehicleState& state);
  void watch_memory();
  [[nodiscard]] bool unavoidable(const simulation::VehicleTruth& truth,
                                 const VehicleState& state) const;
  void watch_movers();
  [[nodiscard]] bool struck() const;
  [[nodiscard]] Eigen::Vector2d place_of_mover(std::size_t fault, double t_s) const;
  [[nodiscard]] bool came_into_the_way() const;
  [[nodiscard]] bool blown() const;
  void broken(Invariant invariant, std::string text);
  void refused(bool cause_known, const char* what);

  const FaultSchedule& schedule_;
  motion::Geofence fence_;
  motion::LimitsConfig limits_;
  Time begin_;
  double now_s_ = 0;
  simulation::VehicleTruth truth_;
  int collisions_ = 0;
  bool struck_ = false;
  bool aborted_ = false;                          // by an order that was accepted
  std::deque<Motion> motions_;                    // of the last second
  std::map<std::size_t, Eigen::Vector2d> goals_;  // of movers that set off: where the vehicle was
  double must_rest_s_ = NAN;                      // when it was said
  double without_pose_s_ = NAN;                   // since when it comes down by itself
  std::vector<Pose> poses_;                       // of the last seconds, the oldest first
  double off_since_s_ = NAN;                      // by more than 3 sd
  double memory_mb_ = NAN;                        // as the flight began
  std::map<Invariant, Breach> breaches_;
  std::vector<autonomy::MissionEvent> events_;
  std::string path_;  // bytes of all true poses
};

}  // namespace saker::tools
