#pragma once

#include "flight/base_station/config.h"
#include "flight/bus/bus.h"
#include "saker/autonomy/config.h"
#include "saker/autonomy/team_config.h"
#include "saker/exchange/peer.h"
#include "saker/uncertainty/fit.h"

namespace saker::flight {

/// What robots and base station tell each other.
struct ExchangeConfig {
  std::string key_file = "team.key";
  std::string folder;
  double call_s = 3;
  double hear_s = 20;
  double landed_s = 60;
  exchange::PeerConfig link;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("key_file", key_file, "",
            "the team's key, the same on every robot, the base and the ground: saker base key. A "
            "robot without that file tells nobody, and says so");
    v.field(
        "folder", folder, "",
        "where a robot keeps what it tells and hears, and the seal's counters; made where there "
        "is none. Empty: it tells nobody. The base has base.folder");
    v.field("call_s", call_s, {0, 3600}, "s",
            "before take-off, for a base to answer; then it is taken to be out of reach");
    v.field("hear_s", hear_s, {0, 3600}, "s",
            "before take-off, at most, for a base in reach to tell what it has: 2 MB");
    v.field("landed_s", landed_s, {0, 3600}, "s",
            "for which a robot that has landed stays, at most, while a base in reach lacks some of "
            "what it has to tell");
    v.group("link", link, "between a robot and the base station");
  }
};

/// The whole configuration file: the autonomy's, the networks, the team's, the base station's and
/// that of the fit of uncertainty models.
struct ProcessConfig {
  autonomy::Config autonomy;
  BusConfig bus;
  ExchangeConfig exchange;
  autonomy::TeamConfig team;
  BaseConfig base;
  uncertainty::FitConfig fit;

  template <class Visitor>
  void visit(Visitor& v) {
    autonomy.visit(v);
    v.group("bus", bus, "LCM networks");
    v.group("exchange", exchange, "what robots and base station tell each other");
    v.group("team", team, "what a robot makes of what others mapped");
    v.group("base", base, "the base station, saker-base");
    v.group("fit", fit, "of uncertainty models to samples, saker characterise fit");
  }
};

}  // namespace saker::flight
