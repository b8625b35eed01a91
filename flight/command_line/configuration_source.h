#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace saker::flight {

/// Where a configuration comes from: the defaults, a preset (flight/process/presets.h) over them, a
/// file over both, single keys over all.
struct ConfigurationSource {
  std::string preset;                 ///< --preset; empty: none
  std::string file;                   ///< --config; empty: none
  std::vector<std::string> settings;  ///< --set key=value, in order
};

/// The same options on every command and program.
void add_configuration_options(CLI::App& app, ConfigurationSource& source);

}  // namespace saker::flight
