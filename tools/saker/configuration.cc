#include "tools/saker/configuration.h"

#include "saker/core/config_io.h"

namespace saker::tools {

flight::ProcessConfig read_configuration(const CommonOptions& common) {
  return core::load_config<flight::ProcessConfig>(common.config_file, common.settings);
}

std::string configuration_text(const flight::ProcessConfig& config) {
  return "# Saker's configuration. A file needs only the keys that differ from these.\n" +
         core::config_to_yaml(config);
}

}  // namespace saker::tools
