#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "saker/core/se3.h"
#include "saker/core/time.h"
#include "saker/objects/measurement.h"

namespace saker::slam {

/// A keyframe of a robot and what was measured from there.
struct HistoryEntry {
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
  /// Of the motion since the previous entry: [rotation, translation], right tangent at this pose.
  Matrix6d motion_covariance = Matrix6d::Constant(NAN);
  /// In the lidar frame at `stamp`, one an object at most, as the graph weighs them: nothing is to
  /// be added to their covariances. Each may gather several windows' of the last keyframes, whose
  /// class probabilities are fused and whose front log-odds and points are summed. With `moving`
  /// set what was told of the object is void.
  std::vector<objects::Measurement> measurements;
};

/// What one flight of one robot saw: all that another robot needs to build the same graph. Entries
/// are only ever appended, and never change once they are there.
struct History {
  std::string robot;
  std::uint32_t flight = 0;  ///< of this robot, counted from 1
  std::vector<HistoryEntry> entries;
};

}  // namespace saker::slam
