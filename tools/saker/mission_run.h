#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "autonomy/config.h"
#include "simulation/mission_config.h"

namespace saker::tools {

using Json = nlohmann::ordered_json;

/// One mission, world and vehicle simulated, in lockstep.
struct MissionRun {
  std::string scenario;  ///< its name, for results.json
  simulation::MissionConfig site;
  autonomy::Config config;
  std::uint64_t seed = 1;
  int threads = 1;
};

/// Flies it and leaves in `out` what docs/contract.md lists, results.json last.
/// \return what results.json holds. Throws Error on a configuration or a site that cannot be.
Json fly(const MissionRun& run, const std::filesystem::path& out);

/// Errors of length and width of those true objects of `targets` (ids) that were found:
/// {"targets", "found", "bias_m", "sd_m", "mae_m", "errors": [{"id", "length_m", "width_m",
/// "distance_m"}]}; error = mapped − true; null where there are too few.
[[nodiscard]] Json target_figures(const objects::ObjectMap& mapped, const objects::ObjectMap& truth,
                                  const std::vector<int>& targets,
                                  const objects::ClassTable& table);

}  // namespace saker::tools
