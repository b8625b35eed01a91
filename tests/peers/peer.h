#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "made_messages.h"

/// Programs of others, run on files of messages (messages.py).
namespace saker::lidar::testing {

/// Why `script` cannot run here, or empty: tests are skipped with it.
[[nodiscard]] std::string missing_for(const std::string& script);

/// Runs a script of this folder by Python or node. \return its status and what it said; 0 and empty
/// where all was well
[[nodiscard]] std::string run_peer(const std::string& script,
                                   const std::vector<std::string>& arguments);

void write_messages(const std::vector<MadeMessage>& messages, const std::filesystem::path& file);
[[nodiscard]] std::vector<MadeMessage> read_messages(const std::filesystem::path& file);

/// The float64 that a message's bytes are.
[[nodiscard]] std::vector<double> numbers_of(const MadeMessage& message);

/// Where the npm packages lie.
[[nodiscard]] std::filesystem::path node_modules();

}  // namespace saker::lidar::testing

#define SKIP_WITHOUT(script) \
  if (const std::string why = testing::missing_for(script); !why.empty()) GTEST_SKIP() << why
