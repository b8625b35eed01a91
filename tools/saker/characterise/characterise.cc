#include "tools/saker/characterise/characterise.h"

namespace saker::tools {

void add_characterise(Commands& commands) {
  CLI::App& group = commands.add_group(
      "characterise", "uncertainty models: what measurements are worth, from data");
  add_characterise_fly(commands, group);
  add_characterise_collect(commands, group);
  add_characterise_fit(commands, group);
}

}  // namespace saker::tools
