#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "saker/active/active.h"

namespace saker::active {

/// What all policies share: the order of the tour, what is in view, and that nothing is waited for
/// without end.
///
/// A viewpoint that motion planning refuses, or to which the vehicle comes no nearer, is given up
/// and not offered again, nor one beside it; after a few of them the target is, and is tried once
/// more when all others are closed. A policy says what a look is worth and where to look from next.
class TouringPolicy : public TargetPolicy {
 public:
  TouringPolicy(const ActiveConfig& config, TargetList targets, InGeofence in_geofence);

  [[nodiscard]] ActivePlan plan(const ActiveInput& input, const core::Budget& budget) override;
  void refuse(int viewpoint_id, const std::string& reason) override;
  [[nodiscard]] const std::vector<Target>& targets() const override { return targets_.all(); }
  [[nodiscard]] TargetList& target_list() override { return targets_; }

 protected:
  /// What was done about a target so far.
  struct Record {
    std::vector<Eigen::Vector3d> given_up;  ///< viewpoints, in this attempt
    int goals = 0;                          ///< in this attempt, since something new was seen
    int attempts = 0;                       ///< that failed
  };
  struct Goal {
    int target;  ///< index
    Viewpoint viewpoint;
    double closest_m;       ///< that the vehicle came
    double idle_s = 0;      ///< since it came nearer or saw something new
    double standing_s = 0;  ///< since it moved or saw something new
  };

  /// Room for what is kept of each target: the list may have grown.
  virtual void make_room(std::size_t targets) { records_.resize(targets); }
  /// The target was in view since the last decision.
  virtual void look(int index) = 0;
  /// Closed targets that are to be looked at further are opened again here.
  virtual void reconsider() {}
  /// Whether there is a viewpoint of this target to fly to; it is the goal then.
  [[nodiscard]] virtual bool choose(int index) = 0;
  /// Why `choose` found none.
  [[nodiscard]] virtual std::string why_none(int index) const;
  /// From where the target was seen so far; empty: from nowhere.
  [[nodiscard]] virtual std::string seen_from(int index) const = 0;

  [[nodiscard]] bool sees(const Eigen::Vector3d& eye, double yaw, const Target& target,
                          double margin_deg) const;
  void saw_something_new(int index);
  [[nodiscard]] bool fly_to(int index, const Viewpoint& viewpoint);
  [[nodiscard]] std::vector<Candidate> viewpoints_of(int index) const;
  [[nodiscard]] Candidate goal_as_candidate() const;
  [[nodiscard]] bool was_given_up(int index, const Viewpoint& viewpoint) const;
  void close(int index, TargetStatus status, const std::string& reason);
  void reopen(int index);
  [[nodiscard]] TargetStatus seen_status(int index) const;
  [[nodiscard]] std::optional<Eigen::Vector3d> next_place() const;

  ActiveConfig config_;
  TargetList targets_;
  InGeofence in_geofence_;
  std::vector<Record> records_;  ///< one a target

  std::optional<Time> last_stamp_;                         ///< of the newest input, this decision's
  double elapsed_s_ = 0;                                   ///< since the last decision
  double flown_m_ = 0;                                     ///< since the first one
  Eigen::Vector3d body_ = Eigen::Vector3d::Constant(NAN);  ///< world, m
  double yaw_ = NAN;                                       ///< world, rad
  std::shared_ptr<const objects::ObjectMap> map_;
  Surroundings surroundings_;

  std::vector<int> tour_;  ///< indices of targets, the current one first
  std::optional<Goal> goal_;
  std::vector<Candidate> candidates_;  ///< of the current target

 private:
  [[nodiscard]] bool accept(const ActiveInput& input);
  void follow_list();
  void observe();
  void watch_progress();
  void order_tour(const core::Budget& budget);
  [[nodiscard]] std::vector<int> due() const;
  void give_up_viewpoint(const std::string& reason);
  void give_up_target(int index, const std::string& reason);
  [[nodiscard]] ActivePlan report() const;

  int revision_ = -1;    ///< of the list, as far as it was followed
  bool stands_ = false;  ///< since the last decision
  std::shared_ptr<const occupancy::OccupancyGrid> grid_;
  double tour_length_m_ = 0;
  bool reorder_ = true;  ///< a target was closed: the tour is made again from here
};

}  // namespace saker::active
