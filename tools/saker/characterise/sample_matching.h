#pragma once

#include <string>
#include <vector>

#include "saker/objects/measurement.h"
#include "saker/uncertainty/sample.h"

namespace saker::tools {

/// An object whose place and size are known.
struct KnownObject {
  int id = -1;
  std::string kind;  ///< "sedan", "oak", where known
  objects::ClassId class_id = 0;
  objects::Model model;  ///< in a frame with z up
};

/// Which known object each measurement is of: its index, or −1. One-to-one within a shape, by
/// place in x-y (Hungarian); what was seen to move is of none, as for the map.
/// \param T_world_lidar  of the measurements, to the frame of the objects
[[nodiscard]] std::vector<int> matched(const std::vector<objects::Measurement>& measurements,
                                       const SE3& T_world_lidar,
                                       const std::vector<KnownObject>& objects);

/// The sample of a measurement of `object`, whatever class was measured: its class is the true one,
/// and its confidence is the probability of that.
[[nodiscard]] uncertainty::Sample sample_of_known(const objects::Measurement& measurement,
                                                  const SE3& T_world_lidar,
                                                  const KnownObject& object,
                                                  const std::string& recording, double time_s);

}  // namespace saker::tools
