#pragma once

#include <string>
#include <vector>

#include "saker/active/config.h"
#include "saker/active/views/view_chooser.h"
#include "saker/active/views/viewpoint_sampler.h"

namespace saker::active {

/// The paper's baseline ("Results", heuristic-based mapping): each target of the prior map from the
/// nearest viewpoint that has all of it in view.
///
/// Reads target, occupancy and the sides seen so far, makes the viewpoint with the least flight,
/// less what an oblique view and a place known to be free are worth. A target is done when it was
/// in view for long enough from several sides (opposite ones, where the vehicle can get there).
/// Where the map has it but nobody saw how long it is, views from between those sides may follow.
/// Frames: `world`. Cost: that of the lattice (viewpoint_sampler.h).
class VisitChooser : public ViewChooser {
 public:
  VisitChooser(const VisitConfig& config, ViewpointSampler sampler);

  [[nodiscard]] ViewRecord unseen() const override;
  [[nodiscard]] ViewOutcome observe(const ViewScene& scene, int target,
                                    ViewRecord& record) const override;
  [[nodiscard]] bool reopens(const ViewScene& scene, int target) const override;
  [[nodiscard]] ViewChoice choose(const ViewScene& scene, int target) const override;
  [[nodiscard]] std::string why_none(const ViewScene& scene, int target,
                                     const ViewChoice& choice) const override;
  [[nodiscard]] std::string seen_from(const ViewScene& scene, int target) const override;
  [[nodiscard]] bool decides_from_start() const override { return false; }

 private:
  [[nodiscard]] bool end_is_missing(const Target& target) const;
  [[nodiscard]] ViewChoice choose_side(const ViewScene& scene, int target,
                                       const Sides& sides) const;
  [[nodiscard]] bool keeps_goal(const ViewScene& scene, int target, const Sides& sides,
                                const ViewpointCandidate* best) const;
  void judge(const ViewScene& scene, int target, const Sides& sides,
             ViewpointCandidate& candidate) const;
  [[nodiscard]] double score(const ViewpointCandidate& candidate) const;

  VisitConfig config_;
  ViewpointSampler sampler_;
};

}  // namespace saker::active
