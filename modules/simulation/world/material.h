#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saker/core/rng.h"

namespace saker::simulation {

/// How a surface answers a beam.
struct Material {
  std::uint16_t label = 0;    ///< SemanticKITTI id
  float reflectivity = 0.3F;  ///< 0 … 1, of a white diffuse target
  float spread = 0.05F;       ///< sd of the reflectivity from point to point
  float gloss = 0;            ///< 0 … 1, share that is mirrored: lost unless it is hit squarely
  float transmission = 0;     ///< probability that the beam goes on behind it (glass, wire, leaves)
  float depth = 0;            ///< m, blades or leaves that stand up from it and answer first
};

/// What the vehicles of a world are painted.
enum class Paint {
  any,    ///< from black to white, as the fleet is
  black,  ///< all of them: few returns
};

[[nodiscard]] inline std::vector<std::string> enum_names(Paint) { return {"any", "black"}; }

/// SemanticKITTI's ids.
enum Label : std::uint16_t {
  kUnlabelled = 0,
  kCar = 10,
  kBicycle = 11,
  kBus = 13,
  kMotorcycle = 15,
  kTruck = 18,
  kOtherVehicle = 20,
  kVan = 21,  ///< our own: SemanticKITTI counts vans as cars; only training worlds use it
  kPerson = 30,
  kBicyclist = 31,
  kMotorcyclist = 32,
  kRoad = 40,
  kParking = 44,
  kSidewalk = 48,
  kOtherGround = 49,
  kBuilding = 50,
  kFence = 51,
  kOtherStructure = 52,
  kLaneMarking = 60,
  kVegetation = 70,
  kTrunk = 71,
  kTerrain = 72,
  kPole = 80,
  kTrafficSign = 81,
  kOtherObject = 99,
};

}  // namespace saker::simulation
