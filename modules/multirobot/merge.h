#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "saker/core/budget.h"
#include "saker/multirobot/constellation.h"
#include "saker/multirobot/merge_config.h"
#include "saker/slam/history.h"
#include "saker/slam/slam.h"

namespace saker::multirobot {

enum class MergeStatus {
  merged,
  nothing_new,  ///< the history has no entry that is not in the graph
  not_aligned,  ///< nobody knows where it took off, and its map does not say so surely
  invalid,      ///< an entry that is not finite, or older than the one before; nothing changed
};

/// What adding a history did.
struct MergeReport {
  MergeStatus status = MergeStatus::merged;
  Alignment alignment;      ///< where the take-off pose was not known
  int entries = 0;          ///< new keyframes
  int matched = 0;          ///< measurements of objects that were in the map
  int created = 0;          ///< objects that were not
  int refused = 0;          ///< measurements that are not usable
  int loops = 0;            ///< constellations that closed one
  int split = 0;            ///< objects that one robot took for another's, told apart again
  slam::SolveReport solve;  ///< the last one, of the whole graph
};

/// One flight's trajectory in the merged graph.
struct MergedFlight {
  std::string robot;
  std::uint32_t flight = 0;
  std::optional<slam::PosePrior> prior;  ///< of the first keyframe; the first flight without one
                                         ///< holds the frame
  std::vector<slam::Keyframe> keyframes;
};

/// Several robots' flights in one graph: reads histories, makes one map and every trajectory.
///
/// Frame: that of the take-off poses given; without any, the first flight's own.
///
/// Method: the paper, "Multi-robot Semantic SLAM": an odometry chain a flight, everybody's
/// measurements associated as a robot's own. A take-off pose is a factor with its covariance, not a
/// constant. New entries are tracked through the map by solving the last few keyframes and what was
/// measured from them, everything else held; then the whole graph is solved under a robust kernel
/// that starts wide and narrows (graduated non-convexity: Yang et al., RA-L 2020), objects on which
/// two flights disagree are told apart, and it is solved again. Take-off poses that nobody knows,
/// and loops of one flight that drift has opened beyond the association's gates, are found by
/// constellations.
///
/// Cost: a history costs what it would cost alone, and the solves of the whole graph: the final
/// ones, and one for each loop.
class MultiRobotSlam {
 public:
  /// Throws Error on an invalid value.
  MultiRobotSlam(const MergeConfig& config, const slam::SlamConfig& slam,
                 const objects::ClassTable& table);

  /// Adds what is new of a history; entries that are in the graph already are skipped. Where the
  /// budget has a deadline, those that are left then wait for the next call.
  /// \param T_world_odom of a flight that is new: where its odometry starts, if anybody knows.
  MergeReport add(const slam::History& history, const std::optional<slam::PosePrior>& T_world_odom,
                  const core::Budget& budget);

  [[nodiscard]] const std::vector<MergedFlight>& flights() const { return flights_; }

  /// All objects, by ascending id; histories tell nothing of the ground.
  [[nodiscard]] objects::ObjectMap map() const;
  /// The same with covariances in the world frame, poses marginalised where that succeeds.
  [[nodiscard]] slam::Slam::MapWithCovariance map_with_covariance() const;
  /// The same as it is given out: widened by what windows share, with what all measurements of an
  /// object have in common (`slam.noise`). Not of maps that were taken for flights: theirs have it.
  [[nodiscard]] objects::ObjectMap reported_map() const;

 private:
  using OnPath = std::function<bool(std::size_t chain, const slam::Keyframe&)>;

  [[nodiscard]] std::vector<slam::Chain> chains();
  [[nodiscard]] std::optional<slam::PosePrior> take_off(
      const slam::History& history, const std::optional<slam::PosePrior>& T_world_odom,
      const core::Budget& budget, MergeReport& report) const;
  static void append(MergedFlight& flight, const slam::HistoryEntry& entry);
  [[nodiscard]] std::vector<slam::Candidate> candidates(const slam::HistoryEntry& entry, int chain,
                                                        bool moving, MergeReport& report) const;
  void integrate(const slam::HistoryEntry& entry, int chain, MergeReport& report);
  void take_back(const std::vector<slam::Candidate>& moving, int chain);
  void track(std::size_t chain);
  void close_loop(std::size_t chain, MergeReport& report);
  void spread();
  void join(const Alignment& loop);
  [[nodiscard]] slam::GraphConfig whole_graph(double scale) const;  ///< of the robust kernel
  slam::SolveReport solve_flight(std::size_t chain, double scale, const core::Budget& budget);
  slam::SolveReport solve_narrowing(std::size_t chain, const core::Budget& budget);
  void settle(std::size_t chain, const core::Budget& budget, MergeReport& report);
  [[nodiscard]] int split();
  [[nodiscard]] std::vector<int> disagreeing(const slam::Landmark& landmark,
                                             slam::Chains chains) const;
  [[nodiscard]] Survey survey(const std::vector<const slam::Landmark*>& landmarks,
                              const OnPath& on_path) const;
  [[nodiscard]] Survey survey() const;

  MergeConfig config_;
  slam::SlamConfig slam_;
  slam::LandmarkConfig landmark_config_;
  objects::ClassTable table_;
  std::vector<MergedFlight> flights_;
  std::vector<slam::Landmark> landmarks_;  ///< ascending id
  int next_id_ = 0;
};

}  // namespace saker::multirobot
