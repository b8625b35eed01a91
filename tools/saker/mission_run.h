#pragma once

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>

#include "autonomy/config.h"
#include "saker/target_figures.h"
#include "simulation/mission_config.h"

namespace saker::tools {

/// One mission, world and vehicle simulated, in lockstep.
struct MissionRun {
  std::string scenario;  ///< its name, for results.json
  simulation::MissionConfig site;
  autonomy::Config config;
  std::uint64_t seed = 1;
  int threads = 1;
  std::shared_ptr<spdlog::logger> log;
  bool shows_progress = true;
};

/// Flies it and leaves in `out` what docs/contract.md lists, results.json last.
/// \return what results.json holds. Throws Error on a configuration or a site that cannot be.
Json fly(const MissionRun& run, const std::filesystem::path& out);

}  // namespace saker::tools
