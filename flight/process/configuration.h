#pragma once

#include "autonomy/config.h"
#include "base_station/config.h"
#include "bus/bus.h"
#include "exchange/peer.h"
#include "uncertainty/fit.h"

namespace saker::flight {

/// What robots and base station tell each other.
struct ExchangeConfig {
  std::string key_file = "team.key";
  std::string folder;
  double landed_s = 60;
  exchange::PeerConfig link;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("key_file", key_file, "",
            "the team's key, the same on every robot, the base and the ground: saker base key");
    v.field(
        "folder", folder, "",
        "where a robot keeps what it tells and hears, and the seal's counters; made where there "
        "is none. Empty: it tells nobody. The base has base.folder");
    v.field("landed_s", landed_s, {0, 3600}, "s",
            "for which a robot that has landed stays, at most, while a base in reach lacks some of "
            "what it has to tell");
    v.group("link", link, "between a robot and the base station");
  }
};

/// The whole configuration file: the autonomy's, the networks, the base station's and that of the
/// fit of uncertainty models.
struct ProcessConfig {
  autonomy::Config autonomy;
  BusConfig bus;
  ExchangeConfig exchange;
  BaseConfig base;
  uncertainty::FitConfig fit;

  template <class Visitor>
  void visit(Visitor& v) {
    autonomy.visit(v);
    v.group("bus", bus, "LCM networks");
    v.group("exchange", exchange, "what robots and base station tell each other");
    v.group("base", base, "the base station, saker-base");
    v.group("fit", fit, "of uncertainty models to samples, saker characterise fit");
  }
};

}  // namespace saker::flight
