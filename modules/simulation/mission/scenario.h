#pragma once

#include "saker/simulation/mission/mission_config.h"
#include "saker/simulation/sensor/scanner.h"
#include "saker/simulation/sensor/sensor_config.h"
#include "saker/simulation/sensor/sensor_model.h"
#include "saker/simulation/world/layout.h"

namespace saker::simulation {

enum class ScenarioKind { training, flight, mission, spiral };

[[nodiscard]] inline std::vector<std::string> enum_names(ScenarioKind) {
  return {"training", "flight", "mission", "spiral"};
}

/// Many small worlds, a few scans of each from random places: what the network learns from.
struct TrainingConfig {
  WorldKind world = WorldKind::mixed;
  int worlds = 400;
  int scans_per_world = 5;
  SensorChoice sensor = SensorChoice::mixed;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("world", world, "", "mixed, street, car_park, country, highway or campus");
    v.field("worlds", worlds, {1, 100000}, "", "worlds, each built anew");
    v.field("scans_per_world", scans_per_world, {1, 1000}, "",
            "scans of each world, from other places and heights");
    v.field("sensor", sensor, "",
            "mixed: another in each scan; or one for all: the same worlds from the same places");
  }
};

/// One flight along a street with a car park beside it.
struct FlightConfig {
  double duration_s = 40;
  double speed_mps = 2.0;
  double height_m = 3.4;
  double height_swing_m = 0.8;
  double sway_m = 1.2;
  double look_around_deg = 15;
  double vibration_deg = 0.15;
  double parked_share = 0.4;
  int moving_vehicles = 0;
  bool labels = false;
  bool cast = false;
  CaptureConfig capture;
  ImuConfig imu;
  ReceiverConfig receiver;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("duration_s", duration_s, {0.2, 600}, "s", "from hovering to hovering");
    v.field("speed_mps", speed_mps, {0.1, 15}, "m/s", "cruise along the street");
    v.field("height_m", height_m, {0.5, 60}, "m", "mean height over the street");
    v.field("height_swing_m", height_swing_m, {0, 20}, "m", "amplitude of the changes of height");
    v.field("sway_m", sway_m, {0, 10}, "m", "amplitude of the sideways changes");
    v.field("look_around_deg", look_around_deg, {0, 180}, "°", "amplitude of the turns about z");
    v.field("vibration_deg", vibration_deg, {0, 5}, "°", "amplitude of the rotors' shaking");
    v.field("parked_share", parked_share, {0, 1}, "", "of the parking places that are taken");
    v.field("moving_vehicles", moving_vehicles, {0, 20}, "", "that drive along; in no map");
    v.field("labels", labels, "", "whether the scans are written labelled, too");
    v.field("cast", cast, "", "whether the ranges as sent are written: OUT/cast/NNNNNN.npy");
    v.group("capture", capture, "the sensor and its packets");
    v.group("imu", imu, "the inertial unit");
    v.group("receiver", receiver, "how the sensor answers");
  }
};

/// A flight about one object, as the paper's manual spirals ("Uncertainty modeling").
struct SpiralConfig {
  double duration_s = 24;
  double slowest_mps = 0.8;
  double fastest_mps = 2.5;
  double nearest_m = 0.9;
  double start_spread_m = 4;
  double farthest_m = 18;
  double lowest_m = 1.5;
  double highest_m = 6;
  double rise_m = 8;
  double look_around_deg = 40;
  double vibration_deg = 0.15;
  double clearance_m = 0.65;
  double neighbour_share = 0.5;
  int clutter = 16;
  CaptureConfig capture = {.columns = 512, .lost_share = 0.002};
  ImuConfig imu;
  ReceiverConfig receiver;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("duration_s", duration_s, {10, 600}, "s", "from hovering to hovering");
    v.field("slowest_mps", slowest_mps, {0.1, 10}, "m/s", "about the object, the slowest flight");
    v.field("fastest_mps", fastest_mps, {0.1, 10}, "m/s", "the fastest: as missions fly");
    v.field("nearest_m", nearest_m, {0.3, 20}, "m", "gap to the object's outline, in x-y");
    v.field("start_spread_m", start_spread_m, {0, 20}, "m",
            "more than that where something is in the way");
    v.field("farthest_m", farthest_m, {3, 60}, "m", "range, in x-y, at the other end");
    v.field("lowest_m", lowest_m, {0.5, 20}, "m", "over the object's ground");
    v.field("highest_m", highest_m, {1, 60}, "m", "the same far away");
    v.field("rise_m", rise_m, {0.5, 60}, "m",
            "range in which the highest rises to 63 %: the object stays in the field of view");
    v.field("look_around_deg", look_around_deg, {0, 180}, "°", "amplitude of the turns about z");
    v.field("vibration_deg", vibration_deg, {0, 5}, "°", "amplitude of the rotors' shaking");
    v.field("clearance_m", clearance_m, {0, 5}, "m", "kept from everything: as missions do");
    v.field("neighbour_share", neighbour_share, {0, 1}, "",
            "of the flights in which cars are parked beside the object");
    v.field("clutter", clutter, {0, 200}, "", "things that are put about, where there is room");
    v.group("capture", capture, "the sensor and its packets");
    v.group("imu", imu, "the inertial unit");
    v.group("receiver", receiver, "how the sensor answers");
  }
};

/// What a scenario file says.
struct Scenario {
  ScenarioKind kind = ScenarioKind::training;
  TrainingConfig training;
  FlightConfig flight;
  MissionConfig mission;
  SpiralConfig spiral;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field(
        "kind", kind, "",
        "training: scans of many worlds; flight: one through one world; mission: a vehicle to be "
        "flown; spiral: about single objects");
    v.group("training", training, "many worlds");
    v.group("flight", flight, "one flight");
    v.group("mission", mission, "a vehicle in a world");
    v.group("spiral", spiral, "about single objects");
  }
};

}  // namespace saker::simulation
