#pragma once

#include <filesystem>

#include "core/files.h"
#include "simulation/simulated_vehicle.h"

namespace saker::tools {

/// What a simulated flight leaves behind.
///
/// From the start, for the executive: metadata.json (the sensor), prior.json (the targets, roughly)
/// and site.yaml (configuration: geofence and mount). At the end: truth.json, trajectory_truth.txt
/// (TUM rows, T_world_lidar at each scan's stamp) and sim.json.
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

  /// To be called once a second at least.
  void record(simulation::SimulatedVehicle& vehicle);
  void finish(const simulation::SimulatedVehicle& vehicle, const Run& run);

 private:
  std::filesystem::path out_;
  core::OutputFile trajectory_;
};

}  // namespace saker::tools
