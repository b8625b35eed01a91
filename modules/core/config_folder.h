#pragma once

#include <filesystem>
#include <string>

namespace saker::core {

/// A file that the configuration names: the path as given, else below the configuration folder
/// (SAKER_CONFIG_DIR in the environment, the repository's configs/ beside the build's programs,
/// share/saker/ beside installed ones, or that of the build). Throws Error("KEY: no such file:
/// looked for …").
[[nodiscard]] std::filesystem::path find_in_configs(const std::string& file,
                                                    const std::string& key);

}  // namespace saker::core
