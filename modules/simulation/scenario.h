#pragma once

#include "core/config.h"
#include "simulation/layout.h"

namespace saker::simulation {

enum class ScenarioKind { training, flight };

[[nodiscard]] inline std::vector<std::string> enum_names(ScenarioKind) {
  return {"training", "flight"};
}

/// Many small worlds, a few scans of each from random places: what the network learns from.
struct TrainingConfig {
  WorldKind world = WorldKind::mixed;
  int worlds = 400;
  int scans_per_world = 5;
  double hdl64_share = 0.6;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("world", world, "",
            "kind of world: mixed, street, car_park, country, highway or campus");
    v.field("worlds", worlds, {1, 100000}, "", "worlds, each built anew");
    v.field("scans_per_world", scans_per_world, {1, 1000}, "",
            "scans of each world, from other places and heights");
    v.field(
        "hdl64_share", hdl64_share, {0, 1}, "",
        "share of scans of an HDL-64E on a car; the others are an OS1-64's at 0.8 to 12 m, tilted");
  }
};

/// What a scenario file says.
struct Scenario {
  ScenarioKind kind = ScenarioKind::training;
  TrainingConfig training;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("kind", kind, "",
            "training: labelled scans of many worlds; flight: one flight through one world");
    v.group("training", training, "many worlds");
  }
};

}  // namespace saker::simulation
