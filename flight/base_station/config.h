#pragma once

#include <string>
#include <vector>

#include "saker/core/config.h"

namespace saker::flight {

/// One channel that passes the relay, of every robot.
struct RelayedChannel {
  std::string channel = "_STATE";
  double rate_hz = 2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("channel", channel, "", "what its name ends in, as in docs/channels.md");
    v.field("rate_hz", rate_hz, {0.01, 100}, "Hz",
            "at most, for each robot; of what comes faster the newest passes");
  }
};

struct RelayConfig {
  std::string ground_url;
  std::vector<RelayedChannel> up = {{"_STATE", 2},       {"_ODOMETRY", 2}, {"_MISSION", 2},
                                    {"_HEALTH", 10},     {"_PLAN", 1},     {"_TRAJECTORY", 1},
                                    {"_OBJECTS", 2},     {"_VERDICT", 2},  {"_DETECTIONS", 2},
                                    {"_COMMAND_ACK", 10}};
  std::vector<RelayedChannel> down = {{"_COMMAND", 10}};
  double most_age_s = 2;
  int most_channels = 256;
  int most_message_kb = 256;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting(
        "ground_url", ground_url, "",
        "LCM network of the ground, another group and port than bus.control_url; empty: no relay.");
    v.list("up", up, "what the ground hears of the robots");
    v.list("down", down, "what the robots hear of the ground, when the team's key sealed it");
    v.field("most_age_s", most_age_s, {0.1, 3600}, "s",
            "of what the ground sealed, by the system clocks of both: an order that somebody held "
            "back is not obeyed later");
    v.field("most_channels", most_channels, {1, 100000}, "",
            "that are relayed; those of further robots are dropped and counted");
    v.field("most_message_kb", most_message_kb, {1, 4096}, "kB",
            "of a message; larger ones are dropped and counted: a trajectory has up to 180 kB");
  }
};

struct BaseConfig {
  std::string folder = "saker-base";
  int most_store_mb = 4096;
  int most_robots = 32;
  RelayConfig relay;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting(
        "folder", folder, "",
        "The base station keeps what the robots said in this folder (base.db), made if need be.");
    v.setting("most_store_mb", most_store_mb, {1, 1 << 20}, "MB",
              "The store grows to this size; what is more is refused.");
    v.setting("most_robots", most_robots, {1, 1000}, "",
              "The base station exchanges with at most so many robots.");
    v.group("relay", relay, "between the robots' network and the ground's");
  }
};

/// The file of the store.
[[nodiscard]] inline std::string store_file(const BaseConfig& config) {
  return config.folder + "/base.db";
}

}  // namespace saker::flight
