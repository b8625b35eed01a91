#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "made_messages.h"

/// Bags and MCAP files, written apart from the readers by their specifications.
namespace saker::lidar::testing {

struct BagOptions {
  std::string compression = "none";  ///< of ROS 1: none, lz4, bz2; of MCAP: "", lz4, zstd
  std::size_t messages_a_chunk = 7;
  bool index = true;  ///< or summary
  bool chunks = true;
};

[[nodiscard]] std::vector<std::uint8_t> made_ros1_bag(const std::vector<MadeMessage>& messages,
                                                      const BagOptions& options = {});
[[nodiscard]] std::vector<std::uint8_t> made_mcap(const std::vector<MadeMessage>& messages,
                                                  Encoding encoding,
                                                  const BagOptions& options = {});
void write_ros2_database(const std::vector<MadeMessage>& messages,
                         const std::filesystem::path& file);

[[nodiscard]] std::vector<std::uint8_t> compressed(const std::string& name,
                                                   const std::vector<std::uint8_t>& bytes);
void write_bytes(const std::filesystem::path& file, const std::vector<std::uint8_t>& bytes);

}  // namespace saker::lidar::testing
