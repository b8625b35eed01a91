#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// A few good inputs of each target.
namespace saker::lidar::fuzz {

using SeedBytes = std::vector<std::uint8_t>;

/// FOLDER/TARGET/seed-N.
class Seeds {
 public:
  explicit Seeds(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The name of a new one.
  [[nodiscard]] std::filesystem::path file(const std::string& target);
  void add(const std::string& target, const SeedBytes& bytes);

 private:
  std::filesystem::path folder_;
  int next_ = 0;
};

[[nodiscard]] SeedBytes behind(std::uint8_t first, std::string_view text);
[[nodiscard]] SeedBytes behind(std::uint8_t first, const SeedBytes& bytes);

/// Of what flies: messages, exchange, maps, configurations, MAVLink.
void add_flight(Seeds& seeds);

}  // namespace saker::lidar::fuzz
