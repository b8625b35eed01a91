#include "flight/process/loop_report.h"

#include <ctime>
#include <nlohmann/json.hpp>

#include "saker/core/files.h"

namespace saker::flight {

double process_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void write_loops(const std::filesystem::path& file, double wall_s, double cpu_s,
                 const std::vector<LoopRow>& loops) {
  nlohmann::ordered_json document = {{"wall_s", wall_s}, {"cpu_s", cpu_s}};
  for (const LoopRow& loop : loops) {
    document["loops"].push_back({{"name", loop.name},
                                 {"runs", loop.totals.runs},
                                 {"late", loop.totals.misses},
                                 {"worst_late_ms", loop.totals.worst_lateness_ms},
                                 {"cpu_s", loop.totals.cpu_s}});
  }
  core::write_file(file, document.dump(1) + "\n");
}

}  // namespace saker::flight
