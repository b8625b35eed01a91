#pragma once

#include <string>
#include <vector>

#include "tools/saker/experiment/target_figures.h"
#include "tools/saker/replay/trajectory_truth.h"

/// Figures of a mission that was flown in real time: what the executive left, against what the
/// simulator knows.
namespace saker::tools {

struct FlownMission {
  objects::ObjectMap map;
  std::vector<StampedPose> trajectory;  ///< after SLAM
  std::vector<StampedPose> viewpoints;  ///< flown to
  Json loops;                           ///< loops.json of saker-flight
  Truth truth;
  objects::ObjectMap prior;  ///< its ids are the truth's
  Json simulator;            ///< sim.json of saker-sim
  Json checker = {};         ///< loops.json of saker-collision-checker; null: it left none
};

/// Above them a flight falls short.
struct FlightLimits {
  double size_mae_m = 0.25;         ///< of length and width of the targets
  double trajectory_error_m = 0.3;  ///< RMS of position
};

/// What results.json holds, as docs/contract.md says. Throws Error where a key is missing.
[[nodiscard]] Json flight_figures(const FlownMission& flight, const objects::ClassTable& table);

/// A line each; none: the flight is what it should be.
[[nodiscard]] std::vector<std::string> shortfalls_of(const Json& figures,
                                                     const FlightLimits& limits);

/// The tables that a user reads.
[[nodiscard]] std::string flight_text(const Json& figures,
                                      const std::vector<std::string>& shortfalls);

}  // namespace saker::tools
