#pragma once

#include <map>
#include <optional>
#include <vector>

#include "saker/slam/history.h"
#include "saker/slam/landmark.h"

namespace saker::slam {

struct HistoryConfig {
  int gather_keyframes = 4;
  int most_measurements = 8;
  int most_entries = 4000;
  double agreement = 2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("gather_keyframes", gather_keyframes, {0, 100}, "",
            "keyframes over which what was measured of an object is gathered into one measurement: "
            "odometry is as good as exact for so long");
    v.field("most_measurements", most_measurements, {1, 500}, "",
            "of one keyframe in the history; the others wait for the next");
    v.field("most_entries", most_entries, {1, 100000}, "",
            "keyframes in the history: over an hour; what comes after is not told to others");
    v.field("agreement", agreement, {0.1, 100}, "",
            "root mean squared error, in standard deviations, up to which two "
            "measurements are gathered into one; beyond, one of them is an outlier and both are "
            "kept");
  }
};

/// Writes down, keyframe by keyframe, what a robot tells others: what it measured of the objects
/// that it believes in, a few keyframes' measurements gathered into one. What was measured of an
/// object before it was believed goes into its first measurement; one that turns out to move is
/// told by its last measurement with `moving` set. Nothing that was written ever changes.
class HistoryRecorder {
 public:
  explicit HistoryRecorder(const HistoryConfig& config) : config_(config) {}

  /// What the newest keyframe says about a landmark.
  void measured(const Landmark& landmark, const Candidate& candidate, const LandmarkConfig& config);

  /// No more will be measured from `keyframe`: writes its entry and goes on to `next`.
  void close(const Keyframe& keyframe, const Keyframe& next, const std::vector<Landmark>& landmarks,
             const LandmarkConfig& config);

  [[nodiscard]] const History& history() const { return history_; }

 private:
  /// Several windows' measurements of one object, in the newest keyframe's frame.
  struct Gathered {
    Observation observation;
    objects::Measurement newest;
    std::vector<double> class_log;
    double front_log_odds = 0;  ///< along x of the observation's cuboid
    int points = 0;
    double length_sd = std::numeric_limits<double>::infinity();
    int age = 0;  ///< keyframes since the first of them
  };
  struct Written {
    std::size_t entry = 0, measurement = 0;
  };
  struct Track {
    std::optional<Gathered> gathering, complete;
    std::optional<Written> last;
  };

  static Gathered gathered(const Landmark& landmark, const Candidate& candidate,
                           const LandmarkConfig& config, const Gathered* before);
  [[nodiscard]] bool agree(const Gathered& a, const Gathered& b) const;
  void write_due(HistoryEntry& entry, const std::vector<Landmark>& landmarks,
                 const LandmarkConfig& config);
  void write_moving(HistoryEntry& entry, const std::vector<Landmark>& landmarks);
  void write(HistoryEntry& entry, Track& track);
  void carry_to(const Keyframe& next, const SE3& T_keyframe_next);

  HistoryConfig config_;
  History history_;
  std::map<int, Track> tracks_;  ///< by the landmark's id
};

}  // namespace saker::slam
