#pragma once

#include <filesystem>
#include <functional>

#include "saker/simulation/mission/flight_path.h"
#include "saker/simulation/mission/mission_config.h"
#include "saker/simulation/world/world_builder.h"

namespace saker::simulation {

/// A vehicle that drives along the street: mover `index` of the world.
struct Driver {
  std::size_t index = 0;
  double start_s = 0;    ///< m along the street at the start of the flight
  double d = 0;          ///< m to the left of its middle
  double speed_mps = 0;  ///< along the street; < 0: the other way
};

struct FlightWorld {
  BuiltWorld built;
  std::vector<Driver> drivers;
  Palette palette;
  Flora flora;
};

/// A street with a car park beside it, for a flight: all five kinds of cars, trees and lamps along
/// it.
[[nodiscard]] FlightWorld build_flight_world(const FlightConfig& config, std::uint64_t seed,
                                             const SiteStyle& style = {});

/// One flight into the folder: flight.pcap and flight.json (the capture), truth.json (objects in
/// the `world` frame: the levelled lidar frame at the first scan's stamp), trajectory_truth.txt
/// (TUM rows, T_world_lidar at each scan's stamp); as configured the labelled scans (not corrected
/// for motion) and the ranges as sent. A function of config and seed.
void write_flight(const FlightConfig& config, std::uint64_t seed,
                  const std::filesystem::path& folder,
                  const std::function<void(int done, int total)>& progress);

}  // namespace saker::simulation
