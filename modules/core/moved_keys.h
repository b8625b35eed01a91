#pragma once

#include <yaml-cpp/yaml.h>

#include <span>
#include <string>
#include <vector>

/// Keys of earlier versions, so that an old configuration is still read.
namespace saker::core {

/// A key or group of an earlier version, `slam.merge`.
struct MovedKey {
  const char* old_key;
  const char* new_key;  ///< where it is now; nullptr: it is gone
  const char* why;      ///< of one that is gone: what holds in its stead
};

/// Moves what `root` has at an old key to its new place and takes out what is gone. A new key that
/// is there as well wins. \return a line for each value that was found: "slam.merge.gate: is now
/// multirobot.gate".
[[nodiscard]] std::vector<std::string> move_keys(YAML::Node& root, std::span<const MovedKey> moved);

}  // namespace saker::core
