#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/saker/soak/soak_sample.h"
#include "tools/saker/soak/trend.h"

namespace saker::tools {

/// What a soak says of one process. Trends are those after the first fifth of the time.
struct SoakFigures {
  std::string process;
  int samples = 0;
  double hours = 0;
  Trend memory;  ///< MB, per hour
  Trend work;    ///< processor seconds a second, per hour
  int handles_first = 0, handles_last = 0, handles_most = 0;
  int threads_most = 0;
  double waiting_most = NAN;
  bool handles_grow = false;

  static constexpr double kMostPercent = 0.5;  ///< of its memory in an hour

  /// Why it falls short, in words; empty: it does not.
  [[nodiscard]] std::string shortfall() const;
};

/// A process an entry, in the order in which they are met.
[[nodiscard]] std::vector<SoakFigures> figures_of(const std::vector<SoakSample>& samples);

[[nodiscard]] std::string soak_table(const std::vector<SoakFigures>& figures);

/// Memory over time, a curve a process, as SVG. Throws Error where it cannot be written.
void write_soak_picture(const std::filesystem::path& file, const std::vector<SoakSample>& samples);

}  // namespace saker::tools
