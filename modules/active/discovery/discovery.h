#pragma once

#include <map>
#include <string>
#include <vector>

#include "saker/active/config.h"
#include "saker/active/tour/targets.h"
#include "saker/active/tour/vehicle_track.h"
#include "saker/active/views/occupancy_view.h"
#include "saker/motion/geofence.h"
#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"

namespace saker::active {

/// Where the prior map is wrong or incomplete (the paper, "PAMS": the prior map only guides).
///
/// Reads the map, the occupancy block and the pose at each decision, adds to the targets and
/// dismisses some. Frames: objects and targets are in `world`. Cost: objects × targets.
///
/// A mapped object of a target class that is no target's, has been in its place for a while and
/// lies in the geofence becomes a target; so does one of which nobody saw how long it is, where
/// there is no prior map, or a target of it took another one and none is nearer to its prior place.
/// A target that has no object, while nothing but what is mapped stands at its place and no
/// incomplete object near it, is dismissed: it is not there, or the same as another. All of that is
/// finite: targets have a ceiling and are dismissed once.
class Discovery {
 public:
  Discovery(const ActiveConfig& config, const objects::ClassTable& table,
            const motion::Geofence& fence);

  /// \param map  null: none yet
  void update(const VehicleTrack& vehicle, const objects::ObjectMap* map,
              const OccupancyView& block, TargetList& targets);

 private:
  /// Of an object that is no target's.
  struct Sighting {
    Time since;
    Eigen::Vector3d place;  ///< m, world
  };
  /// What this decision sees.
  struct Now {
    const VehicleTrack& vehicle;
    const objects::ObjectMap* map;
    const OccupancyView& block;
  };

  void find_newcomers(const Now& now, TargetList& targets);
  void watch(const objects::MapObject& object, bool complete, const Now& now, TargetList& targets,
             std::map<int, Sighting>& sightings);
  [[nodiscard]] bool stray(const objects::MapObject& object, const TargetList& targets) const;
  [[nodiscard]] bool fits_the_prior_better(const objects::MapObject& object,
                                           const TargetList& targets) const;
  [[nodiscard]] bool in_reach(const objects::MapObject& object) const;
  void dismiss_absent(const Now& now, TargetList& targets);
  [[nodiscard]] bool may_be_incomplete(const Target& target, const Now& now) const;
  [[nodiscard]] bool nothing_else_at(const Eigen::Vector3d& place, const Now& now) const;
  [[nodiscard]] std::string why_absent(const Target& target, const TargetList& targets) const;

  ActiveConfig config_;
  objects::ClassTable table_;
  motion::Geofence fence_;
  std::map<int, Sighting> sightings_;  ///< by object id; of the present map only
  int discovered_ = 0;
  std::vector<double> absent_s_;  ///< one a target: nothing was seen at its place for so long
};

}  // namespace saker::active
