#include <iostream>

#include "saker/core/error.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

int print_configuration(bool all, const CommonOptions& common) {
  const flight::ProcessConfig config = read_configuration(common);
  std::cout << (all ? configuration_text(config) : settings_text(config)) << std::flush;
  if (!std::cout) throw Error("cannot write to the standard output");
  return 0;
}

}  // namespace

void add_config(Commands& commands) {
  auto all = std::make_shared<bool>(false);
  commands
      .add({.name = "config",
            .does = "prints the effective settings, each with unit, range and meaning",
            .example = "saker config --set motion.limits.max_speed=2 > my.yaml"},
           [all](const CommonOptions& common) { return print_configuration(*all, common); })
      .add_flag("--all", *all, "constants of algorithms and of fits, too");
}

}  // namespace saker::tools
