#pragma once

#include <string>
#include <vector>

#include "saker/lidar/mount.h"
#include "saker/simulation/sensor/scanner.h"
#include "saker/simulation/sensor/sensor_config.h"
#include "saker/simulation/vehicle/flight_controller.h"
#include "saker/simulation/vehicle/instruments.h"
#include "saker/simulation/vehicle/wind.h"
#include "saker/simulation/world/material.h"

namespace saker::simulation {

/// What happens on the way, for tests.
enum class ScenarioEventKind {
  obstacle,         ///< a wall stands in the way from one moment to the next
  lidar_stop,       ///< nothing comes from the sensor any more, its inertial unit included
  odometry_stop,    ///< none reaches the flight controller any more
  odometry_freeze,  ///< it gets the last pose again and again, with new stamps
  gust,
  mover,  ///< a person or a vehicle that comes straight to where the vehicle was, and goes on
};

[[nodiscard]] inline std::vector<std::string> enum_names(ScenarioEventKind) {
  return {"obstacle", "lidar_stop", "odometry_stop", "odometry_freeze", "gust", "mover"};
}

struct ScenarioEvent {
  ScenarioEventKind kind = ScenarioEventKind::obstacle;
  double at_s = 10;
  double from_speed_mps = 0;
  double ahead_m = 4;
  double x_m = 0;
  double y_m = 0;
  double width_m = 3;
  double height_m = 6;
  double gust_mps = 5;
  double towards_deg = 0;
  double gust_s = 2;
  double mover_mps = 1;
  bool since_begin = false;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("kind", kind, "",
            "obstacle, lidar_stop, odometry_stop, odometry_freeze, gust or mover");
    v.field("at_s", at_s, {0, 7200}, "s", "after take-off");
    v.field("since_begin", since_begin, "", "at_s counts from the begin, on the ground, instead");
    v.field("from_speed_mps", from_speed_mps, {0, 20}, "m/s",
            "not before it flies so fast over ground: what goes wrong matters most on the way");
    v.field("ahead_m", ahead_m, {0, 100}, "m",
            "obstacle: so far in the direction of flight, across it; 0: at x_m, y_m; mover: it "
            "comes from so far");
    v.field("x_m", x_m, {-1000, 1000}, "m", "obstacle: its place in `world`");
    v.field("y_m", y_m, {-1000, 1000}, "m", "obstacle: its place in `world`");
    v.field("width_m", width_m, {0.1, 50}, "m",
            "obstacle: across the direction of flight; mover: of its sides");
    v.field("height_m", height_m, {0.1, 50}, "m", "obstacle, mover: above the take-off point");
    v.field("gust_mps", gust_mps, {0, 30}, "m/s", "gust: on top of the wind");
    v.field("towards_deg", towards_deg, {-360, 360}, "°",
            "gust, mover: where it blows or goes to, in `world`");
    v.field("gust_s", gust_s, {0, 600}, "s", "gust: how long");
    v.field("mover_mps", mover_mps, {0.1, 30}, "m/s", "mover: its speed");
  }
};

/// What is wrong with the prior map, besides its places.
struct PriorErrorsConfig {
  double missing_share = 0;
  int invented = 0;
  int duplicates = 0;
  int mistaken = 0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("missing_share", missing_share, {0, 1}, "", "of the targets that are not in it");
    v.field("invented", invented, {0, 100}, "", "vehicles of it that are not there");
    v.field("duplicates", duplicates, {0, 100}, "", "targets that are in it twice");
    v.field("mistaken", mistaken, {0, 100}, "", "vehicles of it that are trees or poles");
  }
};

enum class SiteKind {
  street,     ///< with parked vehicles, lamps and trees on one side, a car park on the other
  garage,     ///< a level of it: two aisles, bays on both sides, pillars, walls and a ceiling
  dirt_road,  ///< between ditches, through rough meadows with bushes: no trunk, pole or building
};

[[nodiscard]] inline std::vector<std::string> enum_names(SiteKind) {
  return {"street", "garage", "dirt_road"};
}

/// How a site differs from others of its kind.
struct SiteStyle {
  Paint paint = Paint::any;
  double lamps = 1;
  double trees = 1;
  double clutter = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("paint", paint, "", "of all vehicles: any, or black, which returns little");
    v.field("lamps", lamps, {0.1, 10}, "", "of a street: factor on their number");
    v.field("trees", trees, {0.1, 3}, "", "of a street: factor on the number of those in rows");
    v.field("clutter", clutter, {0, 10}, "",
            "of a street: factor on signs, bins, people, bicycles");
  }
};

/// Where it is flown, and what is there.
struct MissionSiteConfig {
  SiteKind kind = SiteKind::street;
  SiteStyle style;
  double street_m = 80;
  double parked_share = 0.35;
  int targets = 8;
  int obstacles = 0;
  int moving_vehicles = 0;
  double prior_sd_m = 1.0;
  bool no_prior = false;
  PriorErrorsConfig prior_errors;
  double fence_margin_m = 2;
  double fence_height_m = 12;
  double ceiling_m = 3.6;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("kind", kind, "", "street, garage or dirt_road");
    v.group("style", style, "how it differs from others of its kind");
    v.field("street_m", street_m, {80, 600}, "m", "length of the world");
    v.field("parked_share", parked_share, {0, 1}, "", "of the parking places that are taken");
    v.field("targets", targets, {1, 100}, "",
            "vehicles that are to be mapped: those nearest to take-off");
    v.field("obstacles", obstacles, {0, 40}, "",
            "posts, walls and hedges, each between two targets; higher than one flies; none in a "
            "garage");
    v.field("moving_vehicles", moving_vehicles, {0, 20}, "", "that drive up and down a street");
    v.field("prior_sd_m", prior_sd_m, {0, 20}, "m",
            "error of the prior map's places, along x and y each");
    v.field("no_prior", no_prior, "", "nothing is said of the targets beforehand but the fence");
    v.group("prior_errors", prior_errors, "what else is wrong with the prior map");
    v.field("fence_margin_m", fence_margin_m, {0, 100}, "m",
            "of the geofence about targets and take-off");
    v.field("fence_height_m", fence_height_m, {1, 200}, "m",
            "of the geofence over the take-off; in a garage a metre below the ceiling at most");
    v.field("ceiling_m", ceiling_m, {3, 10}, "m", "of a garage, over its floor");
  }
};

/// A vehicle in a world, to be flown by somebody else.
struct MissionConfig {
  MissionSiteConfig site;
  WindConfig wind;
  CaptureConfig capture;
  double latency_s = 0.002;
  lidar::MountConfig mount;
  ImuConfig imu;
  ReceiverConfig receiver;
  AirframeConfig airframe;
  ImuConfig controller_imu{.rate_hz = 500};
  BarometerConfig barometer;
  BatteryConfig battery;
  FlightControllerConfig controller;
  std::vector<ScenarioEvent> events;

  template <class Visitor>
  void visit(Visitor& v) {
    v.group("site", site, "the world");
    v.group("wind", wind, "over all of it");
    v.group("capture", capture, "the lidar and its packets");
    v.field("latency_s", latency_s, {0, 1}, "s", "from a packet's last column to its arrival");
    v.group("mount", mount, "where the lidar is on the body: T_body_lidar");
    v.group("imu", imu, "the lidar's inertial unit");
    v.group("receiver", receiver, "how the lidar answers");
    v.group("airframe", airframe, "the vehicle");
    v.group("controller_imu", controller_imu, "the flight controller's inertial unit");
    v.group("barometer", barometer, "the flight controller's");
    v.group("battery", battery, "of the vehicle");
    v.group("controller", controller, "the flight controller");
    v.list("events", events, "what happens on the way");
  }
};

}  // namespace saker::simulation
