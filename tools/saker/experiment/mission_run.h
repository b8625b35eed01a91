#pragma once

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/autonomy/config.h"
#include "saker/simulation/mission/mission_world.h"
#include "saker/slam/trajectory.h"
#include "tools/saker/experiment/target_figures.h"

namespace saker::tools {

/// What a robot of a team has that a vehicle alone has not.
struct TeamRole {
  simulation::TakeoffPlace takeoff;
  std::uint64_t own_seed = 1;   ///< of its instruments
  std::vector<int> targets;     ///< ids, in the truth, of what it is to map
  objects::ObjectMap prior;     ///< `world`: what it is told
  std::vector<double> fence_m;  ///< `world`: corners of where it may fly
  slam::PosePrior surveyed;     ///< where it takes off in the team's `base`, as it is told
};

/// One mission, world and vehicle simulated, in lockstep.
struct MissionRun {
  std::string scenario;     ///< its name, for results.json
  std::string policy = "";  ///< the same; empty: the one that the configuration names
  std::string robot = "R1";
  std::optional<TeamRole> team = std::nullopt;
  simulation::MissionConfig site;
  autonomy::Config config;
  std::uint64_t seed = 1;
  int threads = 1;
  std::shared_ptr<spdlog::logger> log;
  bool shows_progress = true;
  std::optional<std::filesystem::path> record = std::nullopt;  ///< an MCAP file beside `out`
  std::vector<double> origin = {};                             ///< of it, as site.origin has it
};

/// What a vehicle is told of its site: the fence (`world`), heights that fit under it, and how its
/// lidar is mounted.
[[nodiscard]] autonomy::Config at_site(autonomy::Config config,
                                       const simulation::MissionConfig& site,
                                       const simulation::MissionFence& fence);

/// Flies it and leaves in `out` what docs/contract.md lists, results.json last.
/// \return what results.json holds. Throws Error on a configuration or a site that cannot be.
Json fly(const MissionRun& run, const std::filesystem::path& out);

/// What results.json of a run holds; nothing where it is not finished, for it is the last file.
[[nodiscard]] std::optional<Json> finished(const std::filesystem::path& folder);

}  // namespace saker::tools
