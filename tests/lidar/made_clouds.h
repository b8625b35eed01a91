#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "made_messages.h"

/// Files of one cloud each, written apart from the readers by their specifications: x, y, z,
/// intensity, t and ring of each point.
namespace saker::lidar::testing {

template <class T>
void put(std::vector<std::uint8_t>& bytes, T value, bool big_endian = false) {
  std::uint8_t raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian) std::reverse(raw, raw + sizeof(T));
  for (const std::uint8_t byte : raw) bytes.push_back(byte);
}

/// \param data  "ascii", "binary" or "binary_compressed"
[[nodiscard]] std::vector<std::uint8_t> made_pcd(const std::string& data,
                                                 const std::vector<MadePoint>& points);

/// \param format  "ascii", "binary_little_endian" or "binary_big_endian"
[[nodiscard]] std::vector<std::uint8_t> made_ply(const std::string& format,
                                                 const std::vector<MadePoint>& points);

/// Records with names.
[[nodiscard]] std::vector<std::uint8_t> made_npy(const std::vector<MadePoint>& points);

/// Of any `descr` and `shape`.
[[nodiscard]] std::vector<std::uint8_t> npy_of(const std::string& descr, const std::string& shape,
                                               const std::vector<std::uint8_t>& data);

/// Floats without a head: x, y, z, intensity, ring, time in seconds.
[[nodiscard]] std::vector<std::uint8_t> made_floats(const std::vector<MadePoint>& points);

}  // namespace saker::lidar::testing
