#include "flight/command_line/configuration_source.h"

namespace saker::flight {

void add_configuration_options(CLI::App& app, ConfigurationSource& source) {
  app.add_option("--preset", source.preset, "variant of the defaults: paper or visit")
      ->type_name("NAME");
  app.add_option("--config", source.file, "configuration file (YAML), over the defaults")
      ->type_name("FILE");
  app.add_option("--set", source.settings, "overrides one key of the configuration; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);  // what follows the one value is the command's
}

}  // namespace saker::flight
