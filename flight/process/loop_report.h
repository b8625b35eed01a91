#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "flight/process/loop_meter.h"

namespace saker::flight {

struct LoopRow {
  std::string name;
  LoopMeter::Totals totals;
};

/// s, processor time of all threads of this process so far.
[[nodiscard]] double process_seconds();

/// loops.json, for `saker flight-report`: seconds by the wall and of processor time of a process,
/// and of each of its loops. Throws Error where it cannot be written.
void write_loops(const std::filesystem::path& file, double wall_s, double cpu_s,
                 const std::vector<LoopRow>& loops);

}  // namespace saker::flight
