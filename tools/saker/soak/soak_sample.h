#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace saker::tools {

/// What a process holds at one moment of a soak.
struct SoakSample {
  std::string process;
  double t_h = 0;          ///< h: of flight, or of a clock
  double memory_mb = NAN;  ///< resident
  int handles = 0;         ///< open descriptors
  int threads = 0;
  double waiting = NAN;  ///< the most that waited in its queues since the last sample
  double work = NAN;     ///< processor seconds a second since then
};

/// Of this process; `waiting` and `work` are the caller's to know. What the heap keeps free goes
/// back to the system first, so that only what is in use counts.
[[nodiscard]] SoakSample sample_of_this_process(double t_h);

/// A line of JSON, a key a member; NaN is null.
[[nodiscard]] std::string to_line(const SoakSample& sample);

/// Lines of to_line, in their order; `work` and `waiting` may be absent. Throws Error that names
/// file and line on one that is none, or where there is none.
[[nodiscard]] std::vector<SoakSample> read_samples(const std::filesystem::path& file);

}  // namespace saker::tools
