#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "flight/mavlink/config.h"
#include "flight/mavlink/state_in.h"
#include "saker/core/config.h"

namespace saker::flight::mavlink {

struct CheckOptions {
  std::string table;  ///< a file of configs/autopilots; empty: that of the configuration
  double latency_ms = NAN;
  bool write = false;
  std::string confirm;  ///< "write": the second word
};

/// `saker-mavlink check`: reads the parameters of the autopilot on the line that matter, prints
/// each with what it has to be and why where it differs, and writes these where it was asked to.
/// \return 0: all fit; 1: some do not, or no autopilot is there
/// Throws Error on an invalid table or line, and where another autopilot is on it.
[[nodiscard]] int check_parameters(const MavlinkConfig& config, const CheckOptions& options);

/// What `saker doctor` finds on the line, in one line.
struct AutopilotLook {
  enum class Outcome : std::uint8_t {
    fits,
    silent,   ///< no heartbeat, or somebody else has the line
    another,  ///< of another kind than configured
    differs,  ///< in parameters that matter
  };
  Outcome outcome = Outcome::silent;
  std::string line;
};

/// Waits for a heartbeat, then reads the parameters of the table; writes none. It listens as the
/// bridge does: where that runs, its line is not touched. Throws Error on an invalid table or line.
/// \param patience  for the heartbeat; an autopilot says one a second
[[nodiscard]] AutopilotLook look_at_autopilot(const MavlinkConfig& config,
                                              Time patience = from_seconds(kSilence));

}  // namespace saker::flight::mavlink
