#pragma once

#include "flight/link/link_end.h"
#include "flight/link/udp_socket.h"

namespace saker::flight {

/// An end of the link with its socket.
class Radio {
 public:
  /// \param port  0: any. Throws Error where it is taken, and as LinkEnd.
  Radio(const LinkConfig& config, LinkEnd::End end, std::uint16_t port, const exchange::Key& key,
        Bus& bus, int most_robots)
      : socket_(port),
        end_(config, end, key, bus, most_robots,
             [this](const Address& to, std::string_view datagram) {
               return socket_.send(to, datagram);
             }) {}

  /// Takes what came, at most kMostAtOnce datagrams, and sends what is due.
  void step(LinkEnd::Steady::time_point now) {
    for (int taken = 0; taken < kMostAtOnce; ++taken) {
      const auto datagram = socket_.receive();
      if (!datagram) break;
      end_.receive(now, datagram->from, datagram->bytes);
    }
    end_.step(now);
  }

  [[nodiscard]] LinkEnd& end() { return end_; }
  [[nodiscard]] int descriptor() const { return socket_.descriptor(); }

 private:
  static constexpr int kMostAtOnce = 256;  // a flood costs no other work its turn

  UdpSocket socket_;
  LinkEnd end_;
};

}  // namespace saker::flight
