#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saker/active/belief/target_belief.h"
#include "saker/active/config.h"
#include "saker/active/views/path_search.h"
#include "saker/active/views/view_chooser.h"
#include "saker/active/views/viewpoint_sampler.h"
#include "saker/active/views/visit_chooser.h"
#include "saker/motion/limits.h"

namespace saker::active {

/// Planning for active metric-semantic mapping (paper, "PAMS"): policies `paper` and `saker`.
///
/// Reads the map's belief of a target, the views so far, occupancy and reachability, makes the
/// first viewpoint of the path that is worth most. Frames: `world`. Cost: some 20 ms a decision.
///
/// Until a target is in the map it is searched by a `VisitChooser`: nobody knows its heading.
/// From then on: samples of the region of high confidence and low geometric uncertainty about its
/// present estimate; of these, what can be reached and has it in view; the path through up to T of
/// them that takes most off its entropy ("Uncertainty minimization"); its first viewpoint is flown
/// to, until the target was in view from that cell of the model for a dwell. Views under way count
/// as well. A target ends at the entropy threshold (and a class that is sure), when its samples are
/// used up, or when no path through them brings enough.
///
/// `saker` beyond the paper: a second of flight has its price, so that a path is flown when it
/// brings more nat a second than that, with the way to the next target taken into account; a
/// viewpoint is weighed for the neighbours that it sees, too; the drift of the pose lessens what
/// later views are worth; what all views have in common sets an end to what is worth flying; a
/// better viewpoint replaces the goal; where the map knows less of a target than its views should
/// have measured, for they disagree, the map is believed; a length or width that it does not know
/// keeps a target open, or opens it again, and is worth all of the lattice where the region's
/// samples are used up; a target that was known well enough and left the map is searched again. It
/// decides from where the decision begins to be flown, by the map, which is late, and by what was
/// seen since.
class PamsChooser : public ViewChooser {
 public:
  /// \param visit  settings of the search, but for those that `pams.search` has
  PamsChooser(const PamsConfig& pams, const VisitConfig& visit, ViewpointSampler sampler,
              ViewModel model, const motion::LimitsConfig& limits);

  [[nodiscard]] ViewRecord unseen() const override { return search_.unseen(); }
  [[nodiscard]] ViewOutcome observe(const ViewScene& scene, int target,
                                    ViewRecord& record) const override;
  [[nodiscard]] bool reopens(const ViewScene& scene, int target) const override;
  [[nodiscard]] ViewChoice choose(const ViewScene& scene, int target) const override;
  [[nodiscard]] std::string why_none(const ViewScene& scene, int target,
                                     const ViewChoice& choice) const override;
  [[nodiscard]] std::string seen_from(const ViewScene& scene, int target) const override;
  [[nodiscard]] bool decides_from_start() const override { return config_.looked_from.from_start; }

 private:
  /// The viewpoints that are weighed, as a problem of the search; the goal, if among them, is last.
  struct Weighed {
    std::vector<int> targets;  ///< the current one first
    std::vector<Knowledge> known;
    std::vector<ViewpointCandidate> samples;
    PathProblem problem;
  };

  [[nodiscard]] TargetBelief belief_of(const ViewScene& scene, int target) const;
  [[nodiscard]] std::vector<bool> region_of(const ViewScene& scene, int target,
                                            const ViewChoice& choice) const;
  void judge(const ViewScene& scene, int target, ViewpointCandidate& candidate) const;
  [[nodiscard]] const Viewpoint* expected_goal(const ViewScene& scene, int target) const;
  [[nodiscard]] bool goal_was_seen(const ViewScene& scene, int target,
                                   const Knowledge& known) const;
  [[nodiscard]] int cell_from(const Eigen::Vector3d& eye, const Target& target) const;
  void choose_among(const ViewScene& scene, int target, const std::vector<bool>& region,
                    Sampling sampling, ViewChoice& choice) const;
  [[nodiscard]] Weighed weigh(const ViewScene& scene, int target, const std::vector<int>& samples,
                              ViewChoice& choice) const;
  void weigh(const ViewScene& scene, ViewpointCandidate& candidate, Weighed& weighed) const;
  [[nodiscard]] std::vector<int> seen_together(const ViewScene& scene, int target) const;
  [[nodiscard]] std::vector<CellMeasurement> measurements(const ViewScene& scene,
                                                          const Viewpoint& from,
                                                          const Weighed& weighed) const;
  void add_ways(const ViewScene& scene, Weighed& weighed) const;
  [[nodiscard]] double price_of(const ViewScene& scene, int target) const;
  [[nodiscard]] std::optional<Path> best_path(const ViewScene& scene, const Weighed& weighed) const;
  [[nodiscard]] Expectation expect(const ViewScene& scene, const Weighed& weighed,
                                   const Path& path) const;
  [[nodiscard]] ViewHistory views_until(const ViewScene& scene, const Viewpoint& viewpoint,
                                        int target) const;

  PamsConfig config_;
  VisitChooser search_;
  ViewpointSampler sampler_;
  ViewModel model_;
  motion::LimitsConfig limits_;
};

}  // namespace saker::active
