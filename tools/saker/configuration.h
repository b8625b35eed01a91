#pragma once

#include "flight/process/configuration.h"
#include "tools/saker/command.h"

namespace saker::tools {

/// Defaults, then --config, then each --set. Throws Error on an unknown key, a wrong type or a
/// value out of range.
[[nodiscard]] flight::ProcessConfig read_configuration(const CommonOptions& common);

/// The configuration as a file: every key with its unit, valid values and meaning.
[[nodiscard]] std::string configuration_text(const flight::ProcessConfig& config);

}  // namespace saker::tools
