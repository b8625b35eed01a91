#pragma once

#include <string>
#include <vector>

#include "flight/bus/bus.h"

/// Whether this machine can fly a mission: what is wrong, and the command that mends it. The
/// executive looks before it starts, `saker doctor` prints the same.
namespace saker::flight {

struct MachineNeeds {
  BusConfig bus;
  std::vector<int> lidar_ports = {7502, 7503};  ///< UDP: lidar and inertial packets
};

enum class Weight {
  fine,
  drawback,   ///< it flies, but worse: late deadlines, stamps that do not compare
  grounding,  ///< a mission must not start
};

struct Finding {
  std::string subject;  ///< "multicast route"
  Weight weight = Weight::fine;
  std::string found;   ///< what is there and what is needed, in one line
  std::string remedy;  ///< the command that mends it; empty when fine
};

/// Takes half a second: it listens for a datagram to come back and for late wake-ups. Throws Error
/// on an invalid configuration.
[[nodiscard]] std::vector<Finding> check_machine(const MachineNeeds& needs);

/// Throws Error with the first grounding one and its remedy, in one line.
void require_fit(const std::vector<Finding>& findings);

/// The parts, each usable alone.
[[nodiscard]] Finding check_multicast(const std::string& subject, const std::string& url);
[[nodiscard]] Finding check_receive_buffer(int needed_bytes);
[[nodiscard]] Finding check_port(int port);

}  // namespace saker::flight
