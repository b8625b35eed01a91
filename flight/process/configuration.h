#pragma once

#include "autonomy/config.h"
#include "base_station/config.h"
#include "bus/bus.h"
#include "exchange/peer.h"

namespace saker::flight {

/// What robots and base station tell each other.
struct ExchangeConfig {
  std::string key_file = "team.key";
  exchange::PeerConfig link;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("key_file", key_file, "",
            "the team's key, the same on every robot, the base and the ground: saker base key");
    v.group("link", link, "between a robot and the base station");
  }
};

/// The whole configuration file: the autonomy's, the networks and the base station's.
struct ProcessConfig {
  autonomy::Config autonomy;
  BusConfig bus;
  ExchangeConfig exchange;
  BaseConfig base;

  template <class Visitor>
  void visit(Visitor& v) {
    autonomy.visit(v);
    v.group("bus", bus, "LCM networks");
    v.group("exchange", exchange, "what robots and base station tell each other");
    v.group("base", base, "the base station, saker-base");
  }
};

}  // namespace saker::flight
