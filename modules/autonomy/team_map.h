#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saker/active/tour/targets.h"
#include "saker/motion/geofence.h"
#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"

/// What a robot of a team is told before it flies.
namespace saker::autonomy {

/// A map seen from another frame.
[[nodiscard]] objects::ObjectMap in_frame(const std::string& frame, const SE3& T_frame_map,
                                          const objects::ObjectMap& map);

/// The same of corners x1, y1, x2, y2, ….
[[nodiscard]] std::vector<double> in_frame(const SE3& T_frame_map,
                                           const std::vector<double>& corners_m);

/// What a lot is made of; an empty one is everything.
class Lot {
 public:
  explicit Lot(const std::vector<double>& corners_m);
  [[nodiscard]] bool contains(const Eigen::Vector3d& place) const;

 private:
  std::optional<motion::Geofence> outline_;
};

/// What the next robot is told of its lot, in base: what was said beforehand, and in its place what
/// robots mapped, with its covariance. Ids of what was said beforehand stay, and so does its lot.
/// \param mapped  by all robots so far, with covariances
[[nodiscard]] objects::ObjectMap next_prior(const objects::ObjectMap& said,
                                            const objects::ObjectMap& mapped, const Lot& lot,
                                            double gate_m, const objects::ClassTable& table);

/// The same, and what of it others know already.
struct TeamPrior {
  objects::ObjectMap prior;  ///< in base
  int known = 0;             ///< targets that need no visit (`active.targets.known_sd_m`)
  int weak = 0;              ///< that robots mapped, but not well enough
  int mapped = 0;            ///< objects of all classes that robots mapped
};
/// Throws Error on more targets than `config` allows.
[[nodiscard]] TeamPrior team_prior(const objects::ObjectMap& said, const objects::ObjectMap& mapped,
                                   const Lot& lot, double gate_m,
                                   const active::TargetsConfig& config,
                                   const objects::ClassTable& table);

}  // namespace saker::autonomy
