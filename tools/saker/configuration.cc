#include "tools/saker/configuration.h"

#include "saker/core/config_io.h"

namespace saker::tools {

void check_configuration(const CommonOptions& common) {
  (void)flight::read_configuration(common.configuration, flight::OldKeys::said);
}

flight::ProcessConfig read_configuration(const CommonOptions& common) {
  return flight::read_configuration(common.configuration, flight::OldKeys::unsaid);
}

std::string settings_text(const flight::ProcessConfig& config) {
  return "# Saker's settings. A file needs only the keys that differ from these. Constants of "
         "algorithms and of fits: saker config --all.\n" +
         core::config_to_yaml(config, core::Written::settings);
}

std::string configuration_text(const flight::ProcessConfig& config) {
  return "# Saker's configuration. Keys and groups marked ~ are constants of an algorithm or of a "
         "fit, not meant to be set.\n" +
         core::config_to_yaml(config, core::Written::all_marked);
}

}  // namespace saker::tools
