#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saker/active/knowledge.h"
#include "saker/active/looks.h"
#include "saker/active/path_search.h"
#include "saker/active/reachability.h"
#include "saker/active/view_model.h"
#include "saker/active/visit.h"
#include "saker/motion/limits.h"

namespace saker::active {

/// Planning for active metric-semantic mapping (paper, "PAMS"): policies `paper` and `saker`.
///
/// Until a target is in the map it is looked for as policy `visit` does: nobody knows its heading.
/// From then on: samples of the region of high confidence and low geometric uncertainty about its
/// present estimate; of these, what can be reached and has it in view; the path through up to T of
/// them that takes most off its entropy; its first viewpoint is flown to, until the target was in
/// view from that cell of the model for a dwell. What is seen under way counts as well. A target
/// ends at the entropy threshold (and a class that is sure), when its samples are used up, or when
/// no path through them brings enough.
///
/// `saker` beyond the paper: a second of flight has its price, so that a path is flown when it
/// brings more nat a second than that, with the way on to the next target taken into account; a
/// viewpoint is weighed for the neighbours that it sees, too; the drift of the pose lessens what
/// later views are worth; what all views have in common sets an end to what is worth flying; a
/// better viewpoint replaces the one that is flown to; where the map knows less of a target than
/// its views should have told, for they disagree, the map is believed; a length or width that it
/// does not know keeps a target open, or opens it again, and is worth all of the lattice where the
/// region's samples are used up; what was known well enough and left the map is looked for again.
/// It decides from where the decision begins to be flown, by what the map, which is late, knows and
/// what was seen since.
/// Cost: some 20 ms a decision.
class PamsPolicy : public VisitPolicy {
 public:
  PamsPolicy(const ActiveConfig& config, const PamsConfig& pams, TargetList targets,
             InGeofence in_geofence, ViewModel model, const motion::LimitsConfig& limits);

  [[nodiscard]] ActivePlan plan(const ActiveInput& input, const core::Budget& budget) override;

 protected:
  void make_room(std::size_t targets) override;
  void look(int index) override;
  void reconsider() override;
  [[nodiscard]] bool choose(int index) override;
  [[nodiscard]] std::string why_none(int index) const override;
  [[nodiscard]] std::string seen_from(int index) const override;

 private:
  /// The viewpoints that are weighed, as a problem of the search; the goal, if among them, is last.
  struct Choice {
    std::vector<int> together;  ///< targets, the current one first
    std::vector<Knowledge> known;
    std::vector<Candidate> samples;
    PathProblem problem;
  };

  [[nodiscard]] bool stays_closed(int index) const;
  [[nodiscard]] bool choose_among(int index, const std::vector<bool>& region, Sampling sampling);
  [[nodiscard]] std::vector<bool> region_of(int index) const;
  void judge(Candidate& candidate, int index) const;
  [[nodiscard]] bool flies_to(int index) const;
  [[nodiscard]] bool has_flown_to(int index, const Knowledge& known) const;
  [[nodiscard]] int cell_from(const Eigen::Vector3d& eye, int index) const;
  [[nodiscard]] Choice choice_among(int index, const std::vector<int>& samples);
  [[nodiscard]] std::vector<int> seen_together(int index) const;
  [[nodiscard]] std::vector<Sight> sights(const Viewpoint& from, const Choice& choice) const;
  void add_ways(Choice& choice) const;
  [[nodiscard]] double price_of(int index) const;
  [[nodiscard]] std::optional<Path> best_path(const Choice& choice) const;
  void expect(const Choice& choice, const Path& path);
  [[nodiscard]] Looks looks_until(const Viewpoint& viewpoint, int index) const;
  [[nodiscard]] Knowledge known_of(int index) const;
  [[nodiscard]] Belief belief_of(int index, const Knowledge& known) const;
  [[nodiscard]] Belief belief_in_map(int index) const;
  [[nodiscard]] bool enough(int index, const Knowledge& known) const;
  [[nodiscard]] bool size_is_known(int index, const Knowledge& known, double share) const;
  [[nodiscard]] double class_probability(const Target& target) const;

  PamsConfig pams_;
  ViewModel model_;
  motion::LimitsConfig limits_;
  std::vector<LooksAndMap> looks_;            ///< one a target, as the next three
  std::vector<int> cells_;                    ///< the most that ever counted
  std::vector<int> views_;                    ///< viewpoints flown
  std::vector<bool> sure_;                    ///< known well enough when last asked
  std::optional<Reachability> reachability_;  ///< of this decision
  std::optional<Expectation> expected_;       ///< of the goal
  std::vector<Expectation> flown_;            ///< in this decision
};

}  // namespace saker::active
