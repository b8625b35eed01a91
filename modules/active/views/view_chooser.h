#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saker/active/belief/view_history.h"
#include "saker/active/tour/target_state.h"
#include "saker/active/tour/targets.h"
#include "saker/active/tour/vehicle_track.h"
#include "saker/active/views/expectation.h"
#include "saker/active/views/reachability.h"
#include "saker/active/views/sides.h"
#include "saker/objects/object_map.h"

/// Which view of a target comes next: one interface, two implementations (`VisitChooser`,
/// `PamsChooser`), named by `active.policy`.
namespace saker::active {

/// The views of one target so far, and what they came to. The tour keeps one for each target.
struct ViewRecord {
  Sides sides;                ///< those of a target that is searched
  MappedViewHistory history;  ///< all views
  int cells = 0;              ///< of the uncertainty model: the most that ever counted
  int goals = 0;              ///< viewpoints that were flown to since the map has it
  bool well_known = false;    ///< when last asked
};

/// What a view is chosen from. All of it belongs to the tour; poses and places are in `world`.
struct ViewScene {
  const VehicleTrack& vehicle;
  const objects::ObjectMap* map;  ///< null: none yet
  OccupancyView block;
  const Reachability& reachability;  ///< from the vehicle
  std::span<const Target> targets;
  std::span<const TargetState> states;  ///< one a target, as `records`
  std::span<const ViewRecord> records;
  std::span<const int> tour;                   ///< indices of targets, the current one first
  std::optional<Eigen::Vector3d> end;          ///< of the tour; none where it may end anywhere
  const std::optional<Expectation>& expected;  ///< of the goal, if its id is the same

  /// The viewpoint of this target that is flown to; null: none.
  [[nodiscard]] const Viewpoint* goal(int target) const {
    const std::optional<Viewpoint>& goal = states[static_cast<std::size_t>(target)].goal();
    return goal ? &*goal : nullptr;
  }
  /// Where the tour goes after the current target.
  [[nodiscard]] std::optional<Eigen::Vector3d> next_place() const {
    if (tour.size() < 2) return end;
    return targets[static_cast<std::size_t>(tour[1])].place();
  }
};

/// What a view of a target, just now, came to.
struct ViewOutcome {
  bool is_new = false;       ///< from a side or a cell that did not count before
  bool goal_seen = false;    ///< the goal's cell counts: its expectation can be compared
  bool target_done = false;  ///< nothing more is to be seen of it
  std::string reason;        ///< why
};

struct ViewChoice {
  enum class Verdict { none, keep_goal, fly };
  Verdict verdict = Verdict::none;
  Viewpoint viewpoint;                         ///< to fly to
  std::optional<Expectation> expected;         ///< of it, where the policy has a model
  std::vector<ViewpointCandidate> candidates;  ///< with what speaks against each
  bool between_sides = false;  ///< sides half as far apart count from now on (`Sides`)
  bool well_known = false;     ///< the target is known well enough
};

/// Chooses views. Has settings, no state: the same scene gives the same choice.
class ViewChooser {
 public:
  virtual ~ViewChooser() = default;

  /// The record of a target without a view.
  [[nodiscard]] virtual ViewRecord unseen() const = 0;

  /// The target was in view since the last decision.
  /// \param record  the target's own; its history holds this view already
  [[nodiscard]] virtual ViewOutcome observe(const ViewScene& scene, int target,
                                            ViewRecord& record) const = 0;

  /// Whether a target that was closed as well known is pending again.
  [[nodiscard]] virtual bool reopens(const ViewScene& scene, int target) const = 0;

  /// The next view of the target.
  [[nodiscard]] virtual ViewChoice choose(const ViewScene& scene, int target) const = 0;

  /// Why `choose` found none that could be flown to.
  [[nodiscard]] virtual std::string why_none(const ViewScene& scene, int target,
                                             const ViewChoice& choice) const = 0;

  /// From where the target was seen so far; empty: from nowhere.
  [[nodiscard]] virtual std::string seen_from(const ViewScene& scene, int target) const = 0;

  /// Whether decisions are made from where they begin to be flown (`ActiveInput::start`).
  [[nodiscard]] virtual bool decides_from_start() const = 0;
};

}  // namespace saker::active
