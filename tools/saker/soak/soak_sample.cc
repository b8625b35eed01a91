#include "tools/saker/soak/soak_sample.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "tools/saker/experiment/target_figures.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

int entries_of(const fs::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++count;
  return count;
}

double resident_mb() {
  long all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return static_cast<double>(resident * ::sysconf(_SC_PAGESIZE)) * 1e-6;
}

double number_or_nan(const Json& row, const char* key) {
  return row.contains(key) && row[key].is_number() ? row[key].get<double>() : NAN;
}

SoakSample sample_of(const std::string& line) {
  const Json row = Json::parse(line);
  return {.process = row.at("process"),
          .t_h = row.at("t_h"),
          .memory_mb = row.at("memory_mb"),
          .handles = row.at("handles"),
          .threads = row.at("threads"),
          .waiting = number_or_nan(row, "waiting"),
          .work = number_or_nan(row, "work")};
}

}  // namespace

SoakSample sample_of_this_process(double t_h) {
  ::malloc_trim(0);
  // Less the one that lists them.
  return {.process = "saker",
          .t_h = t_h,
          .memory_mb = resident_mb(),
          .handles = entries_of("/proc/self/fd") - 1,
          .threads = entries_of("/proc/self/task")};
}

std::string to_line(const SoakSample& sample) {
  const Json row = {{"process", sample.process},     {"t_h", sample.t_h},
                    {"memory_mb", sample.memory_mb}, {"handles", sample.handles},
                    {"threads", sample.threads},     {"waiting", number(sample.waiting)},
                    {"work", number(sample.work)}};
  return row.dump() + "\n";
}

std::vector<SoakSample> read_samples(const fs::path& file) {
  std::istringstream lines(core::read_file(file));
  std::vector<SoakSample> samples;
  for (std::string line; std::getline(lines, line);) {
    try {
      samples.push_back(sample_of(line));
    } catch (const Json::exception& error) {
      throw Error(fmt::format("{}:{}: no sample of a soak: {}", file.string(), samples.size() + 1,
                              error.what()));
    }
  }
  if (samples.empty()) throw Error(file.string() + ": no samples of a soak");
  return samples;
}

}  // namespace saker::tools
