#pragma once

#include <filesystem>
#include <functional>

#include "simulation/scenario.h"

namespace saker::simulation {

/// Called after every scan with how many of how many are done.
using Progress = std::function<void(int done, int total)>;

/// Builds worlds and scans them into the folder, labelled, in SemanticKITTI's layout. The result is
/// a function of the config and the seed.
void write_training_scans(const TrainingConfig& config, std::uint64_t seed,
                          const std::filesystem::path& folder, const Progress& progress);

}  // namespace saker::simulation
