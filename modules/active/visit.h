#pragma once

#include <vector>

#include "active/active.h"
#include "active/sides.h"

namespace saker::active {

/// The paper's baseline ("Results", heuristic-based mapping): visits each target of the prior map
/// in the order of the tour.
///
/// A target is visited when it was in view for long enough from several sides (opposite ones, where
/// the vehicle can get there). What comes into view under way counts. Nothing is waited for without
/// end: a viewpoint that motion planning refuses, or to which the vehicle comes no nearer, is given
/// up; after a few of them the target is, and is tried once more when all others are closed.
class VisitPolicy : public TargetPolicy {
 public:
  VisitPolicy(const ActiveConfig& config, TargetList targets, InGeofence in_geofence);

  [[nodiscard]] ActivePlan plan(const ActiveInput& input, const core::Budget& budget) override;
  void refuse(int viewpoint_id, const std::string& reason) override;
  [[nodiscard]] const std::vector<Target>& targets() const override { return targets_.all(); }
  [[nodiscard]] TargetList& target_list() override { return targets_; }

 private:
  /// What was done about a target so far.
  struct Record {
    Sides sides;
    std::vector<Eigen::Vector3d> given_up;  ///< viewpoints, in this attempt
    int goals = 0;                          ///< in this attempt, since the last side
    int attempts = 0;                       ///< that failed
  };
  struct Goal {
    int target;  ///< index
    Viewpoint viewpoint;
    double closest_m;       ///< that the vehicle came
    double idle_s = 0;      ///< since it came nearer or saw a side
    double standing_s = 0;  ///< since it moved or saw a side
  };

  [[nodiscard]] bool accept(const ActiveInput& input);
  void follow_list();
  void observe();
  [[nodiscard]] bool sees(const Target& target) const;
  void watch_progress();

  void order_tour(const core::Budget& budget);
  [[nodiscard]] std::vector<int> due() const;

  [[nodiscard]] bool choose(int index);
  [[nodiscard]] bool keeps_goal(int index, const Candidate* best) const;
  void judge(Candidate& candidate, int index) const;
  [[nodiscard]] double score(const Candidate& candidate) const;

  void give_up_viewpoint(const std::string& reason);
  void give_up_target(int index, const std::string& reason);
  void close(int index, TargetStatus status, const std::string& reason);
  [[nodiscard]] TargetStatus seen_status(int index) const;
  [[nodiscard]] ActivePlan report() const;

  ActiveConfig config_;
  TargetList targets_;
  InGeofence in_geofence_;
  int revision_ = -1;            ///< of the list, as far as it was followed
  std::vector<Record> records_;  ///< one a target

  std::optional<Time> last_stamp_;
  double elapsed_s_ = 0;                                   ///< since the last decision
  Eigen::Vector3d body_ = Eigen::Vector3d::Constant(NAN);  ///< world, m
  bool stands_ = false;                                    ///< since the last decision
  std::shared_ptr<const occupancy::OccupancyGrid> grid_;
  Surroundings surroundings_;

  std::vector<int> tour_;  ///< indices of targets, the current one first
  double tour_length_m_ = 0;
  bool reorder_ = true;  ///< a target was closed: the tour is made again from here
  std::optional<Goal> goal_;
  std::vector<Candidate> candidates_;  ///< of the current target
};

}  // namespace saker::active
