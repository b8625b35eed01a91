#pragma once

#include <memory>
#include <vector>

#include "saker/autonomy/planning.h"
#include "saker/autonomy/supervisor.h"

namespace saker::autonomy {

/// A mission without sensors: the vehicle is where its setpoints say, the occupancy block and the
/// map are given, everything is heard all the time. For what the state machine, planning and
/// guidance make of a world together.
class KinematicFlight {
 public:
  KinematicFlight(const std::vector<Eigen::Vector3d>& targets,
                  std::shared_ptr<const occupancy::OccupancyGrid> grid);

  /// Until it is done, or so many seconds; what it takes.
  double run(double limit_s);

  /// The same until it is in this phase.
  bool run_to(MissionPhase phase, double limit_s);
  /// What is seen from now on.
  void see(std::shared_ptr<const occupancy::OccupancyGrid> grid) { grid_ = std::move(grid); }
  [[nodiscard]] Eigen::Vector3d place() const { return odometry_.T_odom_body.translation(); }

  [[nodiscard]] const Mission& mission() const { return supervisor_.mission(); }
  [[nodiscard]] const std::vector<active::Target>& targets() const {
    return planning_.active().targets();
  }

  /// What the collision checker is to say of the committed trajectory; clear by default.
  std::function<void(motion::Verdict&)> judge = [](motion::Verdict&) {};
  std::vector<MissionEvent> events;
  std::vector<PlanningReport> reports;
  std::vector<Setpoint> setpoints;
  double largest_step_m = 0;  ///< between two setpoints

 private:
  void step();
  void supervise();
  void plan();
  void move();

  std::shared_ptr<const occupancy::OccupancyGrid> grid_;
  Planning planning_;
  Guidance guidance_;
  Supervisor supervisor_;
  Time now_ = kNanosecondsPerSecond;
  VehicleState vehicle_;
  VehicleOdometry odometry_;
  std::optional<motion::Verdict> verdict_;
  std::optional<Setpoint> setpoint_;
  std::vector<CommandAck> acks_;
  PlanningReport report_;
  MissionOrders orders_;
  bool climbs_ = false, descends_ = false;
};

/// Known free from the ground up to 8 m within `half_m` of the origin, 0.25 m cells; the ground is
/// occupied.
[[nodiscard]] occupancy::OccupancyGrid free_block(double half_m);

/// Cells whose centres lie between the corners.
void fill(occupancy::OccupancyGrid& grid, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
          occupancy::Cell cell);

}  // namespace saker::autonomy
