#pragma once

#include "tools/saker/command.h"

namespace saker::tools {

// The commands of the group `saker characterise`, a file each.
void add_characterise_fly(Commands& commands, CLI::App& group);
void add_characterise_collect(Commands& commands, CLI::App& group);
void add_characterise_fit(Commands& commands, CLI::App& group);

}  // namespace saker::tools
