#pragma once

#include "autonomy/config.h"
#include "saker/subcommand.h"

namespace saker::tools {

/// Defaults, then --config, then each --set. Throws Error on an unknown key, a wrong type or a
/// value out of range.
[[nodiscard]] autonomy::Config read_configuration(const CommonOptions& common);

/// The configuration as a file: every key with its unit, valid values and meaning.
[[nodiscard]] std::string configuration_text(const autonomy::Config& config);

}  // namespace saker::tools
