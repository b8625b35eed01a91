#include <iostream>

#include "saker/core/error.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"

namespace saker::tools {
namespace {

int print_configuration(const CommonOptions& common) {
  std::cout << configuration_text(read_configuration(common)) << std::flush;
  if (!std::cout) throw Error("cannot write to the standard output");
  return 0;
}

}  // namespace

void add_config(Commands& commands) {
  commands.add({.name = "config",
                .does = "prints the whole effective configuration, every key with unit and meaning",
                .example = "saker config --set odometry.map.voxel_m=0.5 > my.yaml"},
               print_configuration);
}

}  // namespace saker::tools
