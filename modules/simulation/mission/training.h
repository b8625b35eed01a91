#pragma once

#include <filesystem>
#include <functional>

#include "saker/simulation/mission/scenario.h"

namespace saker::simulation {

/// Called after every scan with how many of how many are done.
using Progress = std::function<void(int done, int total)>;

/// Builds worlds and scans them into the folder, labelled, in SemanticKITTI's layout with rings
/// (scan_files.h) and sensors.csv: a line for each scan with what it was made by. The result is a
/// function of the config and the seed, for any number of threads; worlds and places do not depend
/// on the sensor.
void write_training_scans(const TrainingConfig& config, std::uint64_t seed,
                          const std::filesystem::path& folder, const Progress& progress,
                          int threads = 1);

}  // namespace saker::simulation
