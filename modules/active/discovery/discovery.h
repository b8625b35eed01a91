#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/active/active.h"
#include "saker/active/coverage.h"
#include "saker/motion/geofence.h"

namespace saker::active {

/// Around any policy over targets: what to do where the prior map is wrong, incomplete or absent
/// (the paper, "PAMS": the prior map only guides).
///
/// A mapped object of a target class that is no target's, has been in its place for a while and
/// lies in the geofence becomes a target; so does one of which nobody saw how long it is, where
/// there is no prior map, or a target of it took another one and none is nearer to its prior place.
/// A target that has no object, while nothing but what is mapped stands at its place and no
/// incomplete object near it, is dismissed: it is not there, or the same as another. When the
/// policy has nothing left, the geofence is swept, if so configured, and the policy goes on
/// whenever the sweep finds a target. All of that is finite: targets have a ceiling and are
/// dismissed once, a stop of the sweep is closed once, and each has a deadline.
class Discovery : public Policy {
 public:
  /// Throws Error where the geofence is to be swept and is too large.
  Discovery(const ActiveConfig& config, const objects::ClassTable& table,
            std::unique_ptr<TargetPolicy> policy, const motion::Geofence& fence);

  [[nodiscard]] ActivePlan plan(const ActiveInput& input, const core::Budget& budget) override;
  void refuse(int viewpoint_id, const std::string& reason) override;
  [[nodiscard]] const std::vector<Target>& targets() const override { return policy_->targets(); }
  [[nodiscard]] bool idle() const override { return policy_->idle() && !coverage_; }

 private:
  /// Of an object that is no target's.
  struct Sighting {
    Time since;
    Eigen::Vector3d place;  ///< m, world
  };
  struct Stop {
    std::size_t number;
    Viewpoint viewpoint;
    double closest_m;  ///< that the vehicle came
    double idle_s = 0, standing_s = 0, there_s = 0;
  };

  [[nodiscard]] bool accept(const ActiveInput& input);
  void find_newcomers();
  void watch(const objects::MapObject& object, bool complete, std::map<int, Sighting>& sightings);
  [[nodiscard]] bool stray(const objects::MapObject& object) const;
  [[nodiscard]] bool fits_the_prior_better(const objects::MapObject& object) const;
  [[nodiscard]] bool in_reach(const objects::MapObject& object) const;
  [[nodiscard]] Eigen::Vector3d in_fence(const Eigen::Vector3d& place) const;
  void dismiss_absent();
  [[nodiscard]] bool may_be_incomplete(const Target& target) const;
  [[nodiscard]] bool nothing_else_at(const Eigen::Vector3d& place) const;
  [[nodiscard]] std::string why_absent(const Target& target) const;

  void sweep(ActivePlan& plan);
  void watch_stop();
  void close_stop();
  [[nodiscard]] Viewpoint viewpoint_at(std::size_t number) const;
  [[nodiscard]] bool flyable(const Viewpoint& viewpoint) const;

  ActiveConfig config_;
  objects::ClassTable table_;
  motion::Geofence fence_;
  std::unique_ptr<TargetPolicy> policy_;
  std::optional<Coverage> coverage_;
  std::optional<Stop> stop_;  ///< that is flown to

  std::optional<Time> last_stamp_;
  double elapsed_s_ = 0;                                   ///< since the last decision
  Eigen::Vector3d body_ = Eigen::Vector3d::Constant(NAN);  ///< world, m
  double yaw_ = NAN;                                       ///< rad, world
  bool stands_ = false;                                    ///< since the last decision
  std::shared_ptr<const objects::ObjectMap> map_;
  std::shared_ptr<const occupancy::OccupancyGrid> grid_;
  Surroundings surroundings_;

  std::map<int, Sighting> sightings_;  ///< by object id; of the present map only
  int discovered_ = 0;
  std::vector<double> absent_s_;  ///< one a target: nothing was seen at its place for so long
};

}  // namespace saker::active
