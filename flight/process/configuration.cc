#include "flight/process/configuration.h"

#include <spdlog/spdlog.h>

#include "flight/process/old_keys.h"
#include "flight/process/presets.h"
#include "saker/core/config_io.h"

namespace saker::flight {

ProcessConfig read_configuration(const ConfigurationSource& source, OldKeys old_keys) {
  core::ConfigHistory history{.moved = kOldKeys};
  if (old_keys == OldKeys::said) {
    history.say = [](const std::string& line) { spdlog::warn(line); };
  }
  return core::load_config(source.file, source.settings, with_preset(source.preset), history);
}

}  // namespace saker::flight
