#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/active/config.h"
#include "saker/active/plan.h"
#include "saker/active/tour/target_state.h"
#include "saker/active/tour/targets.h"
#include "saker/active/tour/vehicle_track.h"
#include "saker/active/views/view_chooser.h"
#include "saker/active/views/viewpoint_sampler.h"

namespace saker::active {

/// The tour of the targets: in which order, what is in view under way, when a target is closed.
///
/// Reads the map, the occupancy block and the vehicle's pose at each decision, makes the viewpoint
/// to fly to. Which view of a target is next is the chooser's; patience, refusals and progress are
/// the target state's. A viewpoint that motion planning refuses, or to which the vehicle comes no
/// nearer, is given up and not offered again, nor one beside it; after a few of them the target is,
/// and is tried once more when all others are closed.
/// Frames: targets, viewpoints and poses are in `world`, the block is in `odom`. Method: the paper,
/// "PAMS" (tour over the prior map). Cost: that of tour (tour.h) and chooser.
class TargetTour {
 public:
  TargetTour(const ActiveConfig& config, TargetList targets, const ViewpointSampler& sampler,
             std::unique_ptr<const ViewChooser> chooser);

  /// At 1 Hz throughout the tour, also under way: what comes into view counts. A pose that is not
  /// finite or a stamp that is not newer changes nothing.
  [[nodiscard]] ActivePlan plan(const ActiveInput& input, const core::Budget& budget);

  /// Motion planning found no way to this viewpoint: it is not offered again.
  void refuse(int viewpoint_id, const std::string& reason);

  [[nodiscard]] const std::vector<Target>& targets() const { return targets_.all(); }

  /// Targets may be added and dismissed between two decisions.
  [[nodiscard]] TargetList& target_list() { return targets_; }

 private:
  [[nodiscard]] bool accept(const ActiveInput& input);
  [[nodiscard]] ViewScene scene() const;
  void follow_list();
  void observe();
  void observe(int index);
  void reopen();
  void watch_progress();
  void order_tour(const core::Budget& budget);
  [[nodiscard]] std::vector<int> due() const;
  [[nodiscard]] bool fly_on(int index);
  void fly_to(int index, const ViewChoice& choice);
  void end_attempt(int index, const std::string& reason);
  void close(int index, TargetStatus status, const std::string& reason);
  [[nodiscard]] bool sees(const Target& target) const;
  [[nodiscard]] TargetStatus seen_status(int index) const;
  [[nodiscard]] ActivePlan report() const;

  ActiveConfig config_;
  GoalLimits limits_;
  TargetList targets_;
  ViewpointSampler sampler_;
  std::unique_ptr<const ViewChooser> chooser_;

  std::vector<TargetState> states_;  ///< one a target, as `records_`
  std::vector<ViewRecord> records_;
  int revision_ = -1;      ///< of the list, as far as it was followed
  std::vector<int> tour_;  ///< indices of targets, the current one first
  double tour_length_m_ = 0;
  bool reorder_ = true;         ///< a target was closed: the tour is made again from here
  std::optional<int> current_;  ///< target whose viewpoint is flown to

  std::optional<Expectation> expected_;         ///< of the goal, if its id is the same
  std::vector<Expectation> flown_;              ///< in this decision
  std::vector<ViewpointCandidate> candidates_;  ///< of the target that was chosen for last

  VehicleTrack vehicle_;
  std::shared_ptr<const objects::ObjectMap> map_;
  std::shared_ptr<const occupancy::OccupancyGrid> grid_;
  OccupancyView block_;
  Reachability reachability_;
};

}  // namespace saker::active
