#pragma once

#include <string>
#include <vector>

#include "saker/core/config.h"

namespace saker::flight {

/// One channel that crosses the radio, of every robot.
struct LinkedChannel {
  std::string channel = "_STATE";
  double rate_hz = 2;
  int keep = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("channel", channel, "", "what its name ends in, as in docs/channels.md");
    v.field("rate_hz", rate_hz, {0.01, 1000}, "Hz", "at most, for each robot");
    v.field(
        "keep", keep, {1, 1024}, "",
        "of what comes faster: 1: the newest passes; more: so many wait, the oldest is dropped");
  }
};

struct LinkConfig {
  std::string ground;
  int port = 7670;
  std::vector<LinkedChannel> up = {
      {"_STATE", 2},           {"_ODOMETRY", 5},   {"_SETPOINT", 5},   {"_MISSION", 5, 8},
      {"_HEALTH", 20, 16},     {"_PLAN", 1},       {"_TRAJECTORY", 1}, {"_OBJECTS", 2},
      {"_VERDICT", 2},         {"_DETECTIONS", 2}, {"_COMMAND", 5, 8}, {"_COMMAND_ACK", 10, 8},
      {"_EXCHANGE", 1000, 256}};
  std::vector<LinkedChannel> down = {{"_ORDER", 10, 8}, {"_EXCHANGE", 1000, 256}};
  double rate_kb_s = 500;
  double hello_s = 1;
  double lost_s = 3;
  int most_message_kb = 256;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("ground", ground, "",
              "A robot tells the base station at ADDRESS:PORT; empty: it tells nobody.");
    v.setting("port", port, {0, 65535}, "",
              "The base station listens on this UDP port to robots; 0: to none over the radio.");
    v.list("up", up, "what the ground hears of a robot");
    v.list("down", down, "what a robot hears of the ground: orders and exchange, nothing else");
    v.field("rate_kb_s", rate_kb_s, {1, 1e5}, "kB/s",
            "of all channels together, for each robot: half of a slow Wi-Fi link");
    v.field("hello_s", hello_s, {0.1, 1}, "s",
            "between datagrams of an end that has nothing to say");
    v.field("lost_s", lost_s, {1, 60}, "s",
            "of silence after which the counterpart is gone: three of its hellos");
    v.field("most_message_kb", most_message_kb, {1, 4096}, "kB",
            "of a message; larger ones are dropped and counted: a trajectory has up to 180 kB");
  }
};

}  // namespace saker::flight
