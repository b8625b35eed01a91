#include "saker/characterise.h"

namespace saker::tools {

void add_characterise(Commands& commands) {
  CLI::App& group = commands.add_group(
      "characterise", "uncertainty models: what measurements are worth, from data");
  add_characterise_fit(commands, group);
}

}  // namespace saker::tools
