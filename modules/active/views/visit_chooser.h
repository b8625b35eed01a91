#pragma once

#include <string>
#include <vector>

#include "saker/active/sides.h"
#include "saker/active/touring.h"

namespace saker::active {

/// The paper's baseline ("Results", heuristic-based mapping): visits each target of the prior map
/// in the order of the tour.
///
/// A target is visited when it was in view for long enough from several sides (opposite ones, where
/// the vehicle can get there). What comes into view under way counts. Where the map has it but
/// nobody saw how long it is, views from between those sides may follow.
class VisitPolicy : public TouringPolicy {
 public:
  VisitPolicy(const ActiveConfig& config, TargetList targets, InGeofence in_geofence);

 protected:
  void make_room(std::size_t targets) override;
  void look(int index) override;
  [[nodiscard]] bool choose(int index) override;
  [[nodiscard]] std::string seen_from(int index) const override;

 private:
  [[nodiscard]] bool end_is_missing(int index) const;
  [[nodiscard]] bool choose_side(int index);
  [[nodiscard]] bool keeps_goal(int index, const Candidate* best) const;
  void judge(Candidate& candidate, int index) const;
  [[nodiscard]] double score(const Candidate& candidate) const;

  std::vector<Sides> sides_;  ///< one a target
};

}  // namespace saker::active
