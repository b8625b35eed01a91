#pragma once

#include "saker/core/rng.h"
#include "saker/exchange/peer.h"

namespace saker::tools {

/// A link in memory that behaves as a radio does.
struct LinkConfig {
  double loss = 0.1;
  double duplication = 0.02;
  double shortest_delay_s = 0.005;
  double longest_delay_s = 0.04;
  double longest_contact_s = 300;
  exchange::PeerConfig peer{};

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("loss", loss, {0, 0.9}, "", "of the datagrams, in either direction");
    v.field("duplication", duplication, {0, 0.9}, "", "of those that arrive: twice");
    v.field("shortest_delay_s", shortest_delay_s, {0, 10}, "s", "of a datagram");
    v.field("longest_delay_s", longest_delay_s, {0, 10}, "s", "of a datagram: later ones overtake");
    v.field("longest_contact_s", longest_contact_s, {1, 3600}, "s",
            "then the robot leaves the base");
    v.group("peer", peer, "both ends of it");
  }
};

/// What a contact took.
struct ContactFigures {
  bool complete = false;  ///< both ends hold the same
  double seconds = 0;
  long bytes = 0;  ///< sent by both, sealed, acknowledgements included
  long datagrams = 0;
  long lost = 0;
};

/// A robot at the base, until both hold all that either has, or for `longest_contact_s`. A function
/// of its arguments: no clock, no socket.
[[nodiscard]] ContactFigures exchange_at_base(const LinkConfig& config, exchange::Store& robot,
                                              exchange::Store& base, core::Rng rng);

}  // namespace saker::tools
