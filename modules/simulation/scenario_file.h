#pragma once

#include <string>

#include "simulation/scenario.h"

namespace saker::simulation {

/// Reads a scenario (YAML) over the defaults. Throws Error that names file, line and key.
[[nodiscard]] Scenario load_scenario(const std::string& file);

}  // namespace saker::simulation
