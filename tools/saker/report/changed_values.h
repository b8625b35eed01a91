#pragma once

#include <string>
#include <vector>

#include "flight/process/configuration.h"

namespace saker::tools {

/// A value of a configuration that is not the default one.
struct ChangedValue {
  std::string key;     ///< "slam.noise.x_m", "objects.classes[2].name"
  std::string value;   ///< as the configuration file has it
  std::string normal;  ///< the default; empty where a list has no such entry
};

/// In the order of the configuration file; values that were left out are in it, too.
[[nodiscard]] std::vector<ChangedValue> changed_values(const flight::ProcessConfig& config);

}  // namespace saker::tools
