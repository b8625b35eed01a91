#pragma once

#include <span>
#include <string>

#include "flight/process/configuration.h"

/// Variants of the system by name: `--preset paper`. Each is what it changes of the defaults, here
/// and nowhere else; a file and --set go over it.
namespace saker::flight {

struct Preset {
  const char* name;
  void (*apply)(ProcessConfig&);
};

[[nodiscard]] std::span<const Preset> presets();

/// The defaults with a preset over them; of an empty name the defaults. Throws Error on one that is
/// not known.
[[nodiscard]] ProcessConfig with_preset(const std::string& name);

}  // namespace saker::flight
