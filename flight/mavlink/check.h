#pragma once

#include <cmath>
#include <string>

#include "flight/mavlink/config.h"
#include "saker/core/config.h"

namespace saker::flight::mavlink {

struct CheckOptions {
  std::string table;  ///< a file of configs/autopilots; empty: the autopilot's own
  double latency_ms = NAN;
  bool write = false;
  std::string confirm;  ///< "write": the second word
};

/// `saker-mavlink check`: reads the parameters of the autopilot on the line that matter, prints
/// each with what it has to be and why where it differs, and writes these where it was asked to.
/// \return 0: all fit; 1: some do not, or no autopilot is there
/// Throws Error on an invalid table or line, and where another autopilot is on it.
[[nodiscard]] int check_parameters(const MavlinkConfig& config, const CheckOptions& options);

}  // namespace saker::flight::mavlink
