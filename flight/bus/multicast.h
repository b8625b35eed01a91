#pragma once

#include <cstdint>
#include <string>

/// The multicast network under LCM, looked at with plain sockets: LCM itself says what is wrong in
/// many lines on stderr, and some of it only after ten seconds.
namespace saker::flight {

struct MulticastGroup {
  std::string address;  ///< dotted IPv4, 224.0.0.0 … 239.255.255.255
  std::uint16_t port = 0;
};

/// Of "udpm://ADDRESS:PORT?…"; throws Error on anything else.
[[nodiscard]] MulticastGroup multicast_group(const std::string& url);

/// Why a datagram to the group does not come back to this machine, in one clause; empty when it
/// does. Takes up to 0.2 s. Sends one datagram with ttl 0 to a free port: listeners of the group
/// hear nothing.
[[nodiscard]] std::string multicast_fault(const MulticastGroup& group);

/// The command that mends a missing route on this machine alone.
[[nodiscard]] std::string multicast_remedy(const MulticastGroup& group);

/// Bytes of receive buffer that the kernel grants an unprivileged socket which asks for `bytes`.
[[nodiscard]] int granted_receive_buffer(int bytes);

}  // namespace saker::flight
