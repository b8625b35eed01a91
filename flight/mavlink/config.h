#pragma once

#include <string>
#include <vector>

namespace saker::flight::mavlink {

enum class Autopilot { px4, ardupilot };

[[nodiscard]] inline const char* to_string(Autopilot autopilot) {
  return autopilot == Autopilot::px4 ? "px4" : "ardupilot";
}
[[nodiscard]] inline std::vector<std::string> enum_names(Autopilot) { return {"px4", "ardupilot"}; }

struct BridgeConfig {
  Autopilot autopilot = Autopilot::ardupilot;
  int system = 255;
  int component = 191;  // an onboard computer
  int autopilot_system = 0;
  double latitude_deg = 47.0, longitude_deg = 8.0, altitude_m = 400;
  double battery_low = 0.2;
  std::vector<double> place_m = {0, 0, 0};
  std::vector<double> rotation_deg = {0, 0, 0};
  // An autopilot that does not follow a reset of the heading would fly with a wrong one.
  double most_reset_yaw = 0.05;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("autopilot", autopilot, "", "Px4 or ardupilot; another one on the line is refused.");
    v.setting("system", system, {1, 255}, "",
              "Our MAVLink system: the one that the autopilot's failsafe listens to "
              "(SYSID_MYGCS).");
    v.field("component", component, {1, 255}, "", "our MAVLink component");
    v.field("autopilot_system", autopilot_system, {0, 255}, "",
            "the autopilot's MAVLink system; 0: the first that is heard");
    v.field("latitude_deg", latitude_deg, {-90, 90}, "deg",
            "of the place that the autopilot takes for its origin: it needs one, any will do");
    v.field("longitude_deg", longitude_deg, {-180, 180}, "deg", "of that place");
    v.field("altitude_m", altitude_m, {-500, 9000}, "m", "of that place");
    v.field("battery_low", battery_low, {0, 1}, "",
            "share of the emptiest pack below which the executive is told");
    v.setting("place_m", place_m, {-5, 5}, "m",
              "Place of the autopilot in body: x forward, y left, z up.");
    v.setting("rotation_deg", rotation_deg, {-180, 180}, "°",
              "Roll, pitch and yaw of the autopilot in body that its own board rotation does not "
              "take away.");
    v.field("most_reset_yaw", most_reset_yaw, {0, 3.2}, "rad",
            "of a reset of odometry; more, and an autopilot that does not follow it lands");
  }
};

struct MavlinkConfig {
  BridgeConfig bridge;
  std::string line = "udp:listen:14550";
  std::string signing_key;
  std::string table;

  template <class Visitor>
  void visit(Visitor& v) {
    bridge.visit(v);
    v.setting("line", line, "",
              "To the autopilot: serial:DEVICE:BAUD, udp:IP:PORT, udp:listen:PORT or tcp:IP:PORT.");
    v.setting("signing_key", signing_key, "",
              "File of 64 hexadecimal digits, the autopilot's key (SETUP_SIGNING); empty: not "
              "signed.");
    v.setting("table", table, "",
              "What its parameters have to be, a file of configs/autopilots; empty: its kind's.");
  }
};

}  // namespace saker::flight::mavlink
