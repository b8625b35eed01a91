#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

/// One function a subcommand; the list is made from tools/saker/CMakeLists.txt.
namespace saker::tools {
#define SAKER_COMMAND(name) void add_##name(Commands& commands);
#include "commands.inc"
#undef SAKER_COMMAND

}  // namespace saker::tools

int main(int argc, char** argv) {
  return saker::tools::run_command_line(
      {
#define SAKER_COMMAND(name) saker::tools::add_##name,
#include "commands.inc"
#undef SAKER_COMMAND
      },
      saker::tools::check_configuration, argc, argv);
}
