#pragma once

#include "flight/process/configuration.h"
#include "tools/saker/command.h"

namespace saker::tools {

/// Refuses what is wrong before a command runs, and says in the log which keys are of an earlier
/// version: once, however often the command reads the configuration.
void check_configuration(const CommonOptions& common);

/// The defaults, --preset, --config and each --set over one another. Throws Error on an unknown
/// preset or key, a wrong type or a value out of range.
[[nodiscard]] flight::ProcessConfig read_configuration(const CommonOptions& common);

/// The configuration as a file, every key with its unit, valid values and meaning: its settings,
/// what the person who flies, mounts or buys sets.
[[nodiscard]] std::string settings_text(const flight::ProcessConfig& config);

/// The same of all keys, those that are no settings marked.
[[nodiscard]] std::string configuration_text(const flight::ProcessConfig& config);

}  // namespace saker::tools
