#pragma once

#include <filesystem>
#include <fstream>

#include "saker/core/files.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"

namespace saker::tools {

/// What a simulated flight leaves behind.
///
/// From the start, for the executive: metadata.json (the sensor), prior.json (the targets, roughly)
/// and site.yaml (configuration: geofence and mount). On the way: flight_truth.csv (20 Hz, place
/// and velocity in `world`, a line at a time, so that it can be read at once). At the end:
/// truth.json, trajectory_truth.txt (TUM rows, T_world_lidar at each scan's stamp) and sim.json.
class SimRecorder {
 public:
  /// Figures that only the process knows.
  struct Run {
    std::uint64_t seed = 0;
    double factor = 1;
    double wall_s = 0;
    double cpu_s = 0;
    double behind_s = 0;  ///< by which simulated time was late and is so for good
    long packets = 0;
    long packets_refused = 0;
    bool landed = false;  ///< flown, landed and disarmed
  };

  /// `sensor`: with the ports that are used. Throws Error where a file cannot be written.
  SimRecorder(const std::filesystem::path& out, const simulation::MissionConfig& config,
              const simulation::SimulatedVehicle& vehicle, const lidar::SensorInfo& sensor);

  /// To be called 20 times a second at least. \param state  the newest one
  void record(simulation::SimulatedVehicle& vehicle, const VehicleState& state);
  void finish(const simulation::SimulatedVehicle& vehicle, const Run& run);

 private:
  void record_flight(const simulation::VehicleTruth& truth, const VehicleState& state);

  std::filesystem::path out_;
  core::OutputFile trajectory_;
  std::ofstream flight_;
  Time next_row_ = 0;
};

}  // namespace saker::tools
