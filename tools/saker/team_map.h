#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/rng.h"
#include "motion/geofence.h"
#include "objects/class_table.h"
#include "objects/object_map.h"
#include "saker/team_mission.h"
#include "slam/trajectory.h"

namespace saker::tools {

/// A map seen from another frame.
[[nodiscard]] objects::ObjectMap in_frame(const std::string& frame, const SE3& T_frame_map,
                                          const objects::ObjectMap& map);

/// What a lot is made of; an empty one is everything.
class Lot {
 public:
  explicit Lot(const std::vector<double>& corners_m);
  [[nodiscard]] bool contains(const Eigen::Vector3d& place) const;

 private:
  std::optional<motion::Geofence> outline_;
};

/// Where a robot took off, in base, as surveyed: wrong as far as the configuration says.
/// \param T_base_world as it is
[[nodiscard]] slam::PosePrior surveyed(const SE3& T_base_world, const TakeoffSurveyConfig& config,
                                       core::Rng rng);

/// What the next robot is told of its lot, in base: what was said beforehand, and in its place what
/// robots mapped, with its covariance. Ids of what was said beforehand stay, and so does its lot.
/// \param mapped  by all robots so far, with covariances
[[nodiscard]] objects::ObjectMap next_prior(const objects::ObjectMap& said,
                                            const objects::ObjectMap& mapped, const Lot& lot,
                                            double gate_m, const objects::ClassTable& table);

}  // namespace saker::tools
