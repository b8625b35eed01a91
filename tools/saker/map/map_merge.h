#pragma once

#include <CLI/CLI.hpp>

#include "tools/saker/command.h"

namespace saker::tools {

/// `saker map merge`: several object maps into one.
void add_map_merge(Commands& commands, CLI::App& group);

}  // namespace saker::tools
