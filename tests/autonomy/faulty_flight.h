#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "saker/autonomy/local_checker.h"
#include "saker/autonomy/mission_lockstep.h"
#include "tools/plant/simulated_plant.h"

namespace saker::autonomy {

/// The simulated vehicle, of which the flight is recorded, and that can be cut off.
class RecordedPlant : public SteppedPlant {
 public:
  enum class Link {
    up,
    deaf,     ///< nothing reaches the vehicle: the executive has died
    blind,    ///< no scans come from it, all else does
    covered,  ///< its scans have no returns
    gone      ///< nothing comes from it either: the plant has died
  };
  struct Row {
    simulation::VehicleTruth truth;
    VehicleState state;
    [[nodiscard]] double speed() const { return truth.velocity.norm(); }
  };

  explicit RecordedPlant(simulation::SimulatedVehicle& vehicle)
      : vehicle_(vehicle), plant_(vehicle) {}

  [[nodiscard]] Time now() const override { return plant_.now(); }
  void step_to(Time time) override;
  [[nodiscard]] std::vector<SensorPacket> take_packets() override;
  [[nodiscard]] std::optional<VehicleState> take_state() override;
  [[nodiscard]] std::vector<CommandAck> take_acks() override;
  void send(const VehicleOdometry& odometry) override;
  void send(const Setpoint& setpoint) override;
  void send(const Command& command) override;

  Link link = Link::up;
  Eigen::Vector3d blow_mps2 = Eigen::Vector3d::Zero();  ///< lidar: added to what its IMU feels
  std::vector<Row> rows;
  std::function<void(const simulation::VehicleTruth&)> watch;  ///< at every step

 private:
  void cover(SensorPacket& packet) const;
  void add_blow(SensorPacket& packet) const;
  [[nodiscard]] bool hears() const { return link != Link::deaf && link != Link::gone; }

  simulation::SimulatedVehicle& vehicle_;
  tools::SimulatedPlant plant_;
};

/// The collision checker, that can die, and begin again with nothing.
class MortalChecker : public SteppedChecker {
 public:
  explicit MortalChecker(const Config& config) : config_(config) { begin(); }

  void begin();
  void die() { checker_.reset(); }

  void step_to(Time time) override;
  void send(const RegisteredScan& scan) override;
  void send(const motion::Trajectory& trajectory) override;
  [[nodiscard]] std::optional<motion::Verdict> take_verdict() override;
  [[nodiscard]] std::shared_ptr<const occupancy::OccupancyGrid> take_grid() override;

 private:
  const Config& config_;
  std::optional<LocalChecker> checker_;
};

/// A small mission in lockstep that something goes wrong with while it flies.
class FaultyFlight {
 public:
  explicit FaultyFlight(std::vector<simulation::ScenarioEvent> events = {});

  /// The fault comes when it flies faster than `kFast`; false when it never does.
  bool fly_fast_into(const std::function<void()>& fault);
  /// The same with a fault that is over after so many seconds.
  bool fly_fast_into(const std::function<void()>& fault, double lasts_s,
                     const std::function<void()>& over);
  /// No scans for so long, as soon as it flies so fast, from 20 ms into a revolution on: the scan
  /// before the gap is a few milliseconds long, which is the hardest to make a velocity of.
  bool fly_into_gap_of_scans(double speed_mps, double lasts_s);
  /// The fault is the scenario's event; false when it never begins.
  bool fly_into_event();
  /// The fault comes so long after it left the ground.
  bool fly_into_moment(double flown_s, const std::function<void()>& fault);
  /// An operator's order, at once.
  void order(OrderKind kind) { mission_->give({++last_order_, kind}); }
  /// To the last one.
  [[nodiscard]] const OrderReply& reply() const { return reply_; }
  /// Goes on for so long after the fault, or until the mission is done.
  void go_on(double seconds);

  /// Seconds from the fault until the vehicle was at rest or landing.
  [[nodiscard]] double settled_after() const;
  /// The same, and not moving any more until the end.
  [[nodiscard]] double settled_for_good_after() const;
  /// Seconds from the fault until the cause was said; NaN: never.
  [[nodiscard]] double said_after(Cause cause) const;
  /// Goes on until it flies fast again, for so long at most. \return whether it did
  bool flies_fast_again(double most_s);
  /// Of the vehicle, since the fault: all bits that were ever set.
  [[nodiscard]] std::uint32_t faults() const;
  [[nodiscard]] int collisions() const { return vehicle_.truth().collisions; }
  [[nodiscard]] const MissionResult& result() const { return result_; }

  static constexpr double kFast = 0.7;  // m/s over ground

 private:
  bool fly_into(const std::function<bool(const simulation::VehicleTruth&)>& when,
                const std::function<void()>& fault, double lasts_s = INFINITY,
                const std::function<void()>& over = {});

  Config config_;
  core::Timings timings_;
  simulation::SimulatedVehicle vehicle_;

 public:
  RecordedPlant plant;
  MortalChecker checker;

 private:
  std::unique_ptr<MissionLockstep> mission_;
  MissionResult result_;
  std::vector<MissionEvent> events_;
  OrderReply reply_;
  std::int64_t last_order_ = 0;
  Time fault_ = 0;
};

}  // namespace saker::autonomy
