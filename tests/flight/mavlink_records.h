#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "paths.h"

/// The records of an autopilot's side of MAVLink, ../shared/data/mavlink.
namespace saker::flight::mavlink {

inline constexpr const char* kNoRecords = "../shared/data/mavlink is not there";

inline std::filesystem::path records() {
  return std::filesystem::path(source_dir()).parent_path() / "shared" / "data" / "mavlink";
}

/// The bytes of one of its files; nothing where they are absent.
inline std::optional<std::vector<std::uint8_t>> recorded(const std::string& name) {
  std::ifstream file(records() / name, std::ios::binary);
  if (!file) return std::nullopt;
  return std::vector<std::uint8_t>(std::istreambuf_iterator<char>(file), {});
}

}  // namespace saker::flight::mavlink
