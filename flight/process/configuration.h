#pragma once

#include <string>

#include "flight/base_station/config.h"
#include "flight/bus/bus.h"
#include "flight/command_line/configuration_source.h"
#include "flight/ground/config.h"
#include "flight/mavlink/config.h"
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
    v.setting("key_file", key_file, "",
              "File of the team's key, the same on robots, base and ground (saker base key); "
              "without it a robot tells nobody.");
    v.setting("folder", folder, "",
              "A robot keeps what it tells and hears in this folder, made if need be; empty: it "
              "tells nobody.");
    v.setting("call_s", call_s, {0, 3600}, "s",
              "Before take-off a base has so long to answer, else it is out of reach.");
    v.setting("hear_s", hear_s, {0, 3600}, "s",
              "Before take-off a base in reach has so long to tell what it has.");
    v.setting("landed_s", landed_s, {0, 3600}, "s",
              "After landing a robot stays so long at most until a base in reach has all it has to "
              "tell.");
    v.group("link", link, "between a robot and the base station");
  }
};

/// The whole configuration file: the autonomy's, the networks, the team's, the base station's, the
/// bridge's to an autopilot, the ground's and that of the fit of uncertainty models.
struct ProcessConfig {
  autonomy::Config autonomy;
  BusConfig bus;
  ExchangeConfig exchange;
  autonomy::TeamConfig team;
  BaseConfig base;
  mavlink::MavlinkConfig mavlink;
  ground::GroundConfig ground;
  ground::SiteConfig site;
  uncertainty::FitConfig fit;

  template <class Visitor>
  void visit(Visitor& v) {
    autonomy.visit(v);
    v.group("bus", bus, "LCM networks");
    v.group("exchange", exchange, "what robots and base station tell each other");
    v.group("team", team, "what a robot makes of what others mapped");
    v.group("base", base, "the base station, saker-base");
    v.group("mavlink", mavlink, "the bridge to the autopilot, saker-mavlink");
    v.group("ground", ground, "what people on the ground see, saker-ground");
    v.group("site", site, "where on the Earth it flies");
    v.group("fit", fit, "of uncertainty models to samples, saker characterise fit");
  }
};

enum class OldKeys { said, unsaid };

/// Keys of earlier versions are taken to their new places (old_keys.h), with a warning in the log
/// for each where they are said. Throws Error on an unknown preset or key, a wrong type or a value
/// out of range.
[[nodiscard]] ProcessConfig read_configuration(const ConfigurationSource& source,
                                               OldKeys old_keys = OldKeys::said);

}  // namespace saker::flight
