#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saker/autonomy/config.h"
#include "saker/simulation/mission/mission_config.h"
#include "tools/saker/faults/flight_watch.h"

namespace saker::tools {

/// One mission in lockstep with faults.
struct FaultFlight {
  std::string scenario;  ///< its name
  simulation::MissionConfig site;
  autonomy::Config config;
  std::uint64_t seed = 1;  ///< of world and vehicle
  double most_s = 0;       ///< it is looked at for so long
  FaultSchedule schedule;
  std::filesystem::path
      files;  ///< folder for what it writes meanwhile; made, and removed at its end
};

/// What came of it.
struct FaultOutcome {
  std::vector<Breach> breaches;
  nlohmann::ordered_json record;  ///< scenario, seed, schedule, breaches, events, figures, digest
  std::string digest;             ///< of the true path
};

/// On the calling thread. A function of its argument, to the byte. Throws Error on a configuration
/// or a site that cannot be.
[[nodiscard]] FaultOutcome fly_with_faults(const FaultFlight& flight);

}  // namespace saker::tools
