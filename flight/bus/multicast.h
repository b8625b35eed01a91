#pragma once

#include <cstdint>
#include <string>
#include <vector>

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

/// Whether what is sent to this URL stays on the machine: ttl=0, or none, which is LCM's default.
[[nodiscard]] bool stays_on_machine(const std::string& url);

/// Throws Error where it does not. \param key  the setting, for the message
void require_on_machine(const std::string& key, const std::string& url);

/// From here on no UDP socket of this process on `port` hears what another machine sent. LCM binds
/// to all interfaces: without this a datagram to the port of any of them is a message, whatever the
/// ttl and the multicast route. A filter in the kernel lets in what came over lo, and multicast
/// that this machine hears of itself (socket(7), SO_ATTACH_FILTER). Throws Error where there is no
/// such socket, or the kernel refuses.
void hear_this_machine_alone(std::uint16_t port);

/// The same, and of LCM's messages these channels alone: every other datagram of a busy network
/// would wake its receiver to be thrown away. Messages of several datagrams come in whatever their
/// channel. It holds for all that this process has on `port`. Throws Error as above, and
/// on a pattern of names: a filter compares letters.
void hear_channels_alone(std::uint16_t port, std::vector<std::string> channels);

/// The command that mends a missing route on this machine alone.
[[nodiscard]] std::string multicast_remedy(const MulticastGroup& group);

/// Bytes of receive buffer that the kernel grants an unprivileged socket which asks for `bytes`.
[[nodiscard]] int granted_receive_buffer(int bytes);

}  // namespace saker::flight
