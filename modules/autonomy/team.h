#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saker/autonomy/team_config.h"
#include "saker/autonomy/team_map.h"
#include "saker/core/budget.h"
#include "saker/exchange/packed_history.h"
#include "saker/multirobot/merge.h"

namespace saker::autonomy {

/// Most iterations of a solve when a whole flight is merged.
constexpr int kMergeIterations = 50;

/// A flight that was told, and what became of it.
struct ToldFlight {
  std::string robot;
  std::uint32_t flight = 0;
  int entries = 0;         ///< that were told
  int merged = 0;          ///< of these in the map
  std::string left_out{};  ///< why it is not, or not all of it; empty: it is
};

/// What one robot knows of its team: reads flights that were told (`exchange`), makes their map and
/// what this robot plans with.
///
/// Frame: `base` where this robot's take-off was surveyed; then flights whose take-off was surveyed
/// are merged first, others where the map says surely where they were. Without it the frame is this
/// robot's own `world`, and nothing is merged before it has flown.
///
/// Method: multirobot::MultiRobotSlam, as `saker mission` merges. Cost: bounded by the budget; a
/// flight of two minutes takes a second.
class Team {
 public:
  /// Throws Error on an invalid configuration.
  Team(const TeamConfig& config, const multirobot::MergeConfig& merge, const slam::SlamConfig& slam,
       const objects::ClassTable& table);

  /// Merges what is new of these; what does not fit into the budget can be given again.
  void add(std::span<const exchange::UnpackedHistory> told, const core::Budget& budget);
  /// This robot's own flight, now that it has been flown.
  void add_own(const slam::History& history, const core::Budget& budget);

  [[nodiscard]] const std::optional<slam::PosePrior>& takeoff() const { return takeoff_; }
  /// Of others, as far as they were told: robot by robot.
  [[nodiscard]] const std::vector<ToldFlight>& told() const { return told_; }
  /// "R2 flight 1 (41 of 41 keyframes); R3 flight 2 (left out: …)"
  [[nodiscard]] std::string text() const;

  /// All that was merged, with covariances.
  [[nodiscard]] objects::ObjectMap map() const;
  /// What this robot flies to, as TeamPrior but in its `world`. Its take-off has to be surveyed.
  /// \param said  beforehand, in its `world`
  /// Throws Error on more targets than `config` allows.
  [[nodiscard]] TeamPrior prior(const objects::ObjectMap& said,
                                const active::TargetsConfig& config) const;

 private:
  void merge(const exchange::UnpackedHistory& told, bool placed, const core::Budget& budget);
  [[nodiscard]] ToldFlight& told_of(const slam::History& history);

  TeamConfig config_;
  objects::ClassTable table_;
  std::optional<slam::PosePrior> takeoff_;
  Lot lot_;
  multirobot::MultiRobotSlam merged_;
  std::vector<ToldFlight> told_;
};

}  // namespace saker::autonomy
