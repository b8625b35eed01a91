#pragma once

#include "saker/subcommand.h"

namespace saker::tools {

// The commands of the group `saker characterise`, a file each.
void add_characterise_fit(Commands& commands, CLI::App& group);

}  // namespace saker::tools
