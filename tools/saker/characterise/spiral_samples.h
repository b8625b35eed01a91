#pragma once

#include "saker/autonomy/config.h"
#include "saker/simulation/mission/spiral_flight.h"
#include "tools/saker/characterise/sample_matching.h"

namespace saker::tools {

/// An object that a window could have shown: it was within range, its middle in the sensor's
/// vertical field of view.
struct Glance {
  std::string recording;
  int object_id = -1;
  std::string kind;
  objects::ClassId class_id = 0;
  double time_s = NAN;
  uncertainty::View view;
  int returns = 0;  ///< from it in the window's newest scan; 0: something was in the way
  bool detected = false;
};

/// What a flight teaches.
struct SpiralSamples {
  std::vector<uncertainty::Sample> samples;
  std::vector<Glance> glances;
};

/// Flies a spiral and runs the stages of a flight over what its sensor sends: odometry,
/// segmentation and detection at their rates in flight. Each measurement of a true object within
/// range becomes a sample, seen from the true pose at its scan's stamp: the error is the
/// measurement's own, not that of odometry.
[[nodiscard]] SpiralSamples fly_spiral(const simulation::SpiralConfig& spiral,
                                       const simulation::SpiralSubject& subject, std::uint64_t seed,
                                       const autonomy::Config& config,
                                       const std::string& recording);

/// CSV with a header line, one line a glance.
[[nodiscard]] std::string glances_text(const std::vector<Glance>& glances,
                                       const objects::ClassTable& table);

}  // namespace saker::tools
