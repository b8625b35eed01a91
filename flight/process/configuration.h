#pragma once

#include <string>

#include "flight/base_station/config.h"
#include "flight/bus/bus.h"
#include "flight/command_line/configuration_source.h"
#include "flight/ground/config.h"
#include "flight/link/config.h"
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
  double order_age_s = 2;
  exchange::PeerConfig link;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting(
        "key_file", key_file, "",
        "File of a key: the team's at the base, a robot's own on it (saker base key); without "
        "it a robot tells nobody.");
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
    v.field(
        "order_age_s", order_age_s, {0.1, 3600}, "s",
        "of an operator's order when a robot hears it, by the system clocks of both: what somebody "
        "held back is not obeyed later");
    v.group("link", link, "between a robot and the base station");
  }
};

/// The sensor as this machine hears it: ports, serial number and mode are its metadata's.
struct SensorLineConfig {
  std::string address;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("address", address, "",
              "IPv4 address of the sensor: nothing else is heard on its ports; empty: of the first "
              "one that fits its metadata.");
  }
};

/// The whole configuration file: the autonomy's, the networks, the team's, the base station's, the
/// bridge's to an autopilot, the ground's and that of the fit of uncertainty models.
struct ProcessConfig {
  autonomy::Config autonomy;
  BusConfig bus;
  SensorLineConfig sensor;
  ExchangeConfig exchange;
  autonomy::TeamConfig team;
  BaseConfig base;
  LinkConfig link;
  mavlink::MavlinkConfig mavlink;
  ground::GroundConfig ground;
  ground::SiteConfig site;
  uncertainty::FitConfig fit;

  template <class Visitor>
  void visit(Visitor& v) {
    autonomy.visit(v);
    v.group("bus", bus, "LCM networks");
    v.group("sensor", sensor, "the sensor's packets");
    v.group("exchange", exchange, "what robots and base station tell each other");
    v.group("team", team, "what a robot makes of what others mapped");
    v.group("base", base, "the base station, saker-base");
    v.group("link", link, "over the radio, between saker-link on a robot and saker-base");
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
