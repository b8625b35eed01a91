#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saker/core/budget.h"
#include "saker/objects/measurement.h"
#include "saker/objects/object_map.h"
#include "saker/slam/association.h"
#include "saker/slam/duplicates.h"
#include "saker/slam/graph.h"
#include "saker/slam/ground_map.h"
#include "saker/slam/history_recorder.h"
#include "saker/slam/landmark.h"
#include "saker/slam/measurement_noise.h"
#include "saker/slam/trajectory.h"

namespace saker::slam {

/// Where the covariances of measurements come from: detection's own, or a model fitted to flights.
enum class NoiseSource { fixed, fitted };

[[nodiscard]] inline std::vector<std::string> enum_names(NoiseSource) {
  return {"fixed", "fitted"};
}

struct SlamConfig {
  KeyframeConfig keyframes;
  AssociationConfig association;
  LandmarkConfig landmarks;
  DuplicateConfig duplicates;
  GraphConfig graph;
  GroundMapConfig ground;
  HistoryConfig history;
  NoiseSource measurement_noise = NoiseSource::fitted;
  MeasurementNoiseConfig noise;

  template <class Visitor>
  void visit(Visitor& v) {
    v.group("keyframes", keyframes, "poses of the graph");
    v.group("association", association, "which object a measurement is of");
    v.group("landmarks", landmarks, "when an object belongs to the map");
    v.group("duplicates", duplicates, "when two objects are one");
    v.group("graph", graph, "the optimisation");
    v.group("ground", ground, "the map's local ground planes");
    v.group("history", history, "what other robots are told");
    v.setting("measurement_noise", measurement_noise, "",
              "Covariances of measurements come from uncertainty.model (fitted) or from detection "
              "alone (fixed).");
    v.group("noise", noise, "what is added to the covariances of detection");
  }
};

/// Widens what a graph says of an object by what windows share of their errors, which the graph
/// takes for independent: of the measurements alone, not of the poses. With fitted noise a width
/// that was not measured is known by its class.
void widen(Eigen::MatrixXd& covariance, const Landmark& landmark, Chains chains,
           const SlamConfig& config, const objects::ClassTable& table);

/// What the stage reads in a cycle.
struct SlamInput {
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
  /// Of the motion since the previous input: [rotation, translation], right tangent at the new
  /// pose.
  Matrix6d odometry_covariance = Matrix6d::Constant(NAN);
  objects::Detections detections;  ///< in the lidar frame at `stamp`
};

enum class SlamStatus {
  updated,
  old_input,      ///< not newer than the last one; nothing changed
  invalid_input,  ///< a pose that is not finite; nothing changed
};

/// What a cycle did.
struct SlamUpdate {
  SlamStatus status = SlamStatus::updated;
  SE3 T_world_lidar = SE3::Identity();  ///< at the input's stamp
  bool keyframe_added = false;
  int matched = 0;    ///< measurements of objects that were known
  int created = 0;    ///< new candidates
  int refused = 0;    ///< measurements that are not finite, or one too many
  int moving = 0;     ///< measurements of what moves, kept out
  int merged = 0;     ///< duplicates that became one
  int removed = 0;    ///< objects that turned out to move, or made room
  int confirmed = 0;  ///< objects in the map now
  SolveReport solve;
};

/// Stage 4: reads odometry and detections (from `odometry` and `detection`), makes the trajectory
/// and the object map.
///
/// Frames: detections come in the lidar frame; `odom` drifts and never jumps; `world` is odom at
/// the first input and is corrected, so that T_world_odom jumps. Keyframes are poses of the graph;
/// what is measured between two attaches to the newest one by odometry's motion, whose covariance
/// is added.
///
/// Method: the paper, section IV-B. Nearest-neighbour association; odometry factor, cuboid factor
/// (eq. 1), cylinder factor (eq. 2) in one graph, minimised by Levenberg–Marquardt from the last
/// estimate. Added to the paper: the class is fused by Bayes' rule, front and back outside the
/// graph, an object enters the map after several observations and leaves it when it moves or is not
/// seen where it should be.
///
/// Cost: see README.md; linear in keyframes and observations but for the factorisation.
class Slam {
 public:
  Slam(const SlamConfig& config,
       const objects::ClassTable& table);  ///< throws Error on an invalid value

  SlamUpdate update(const SlamInput& input, const core::Budget& budget);

  [[nodiscard]] SE3 T_world_odom() const { return trajectory_.T_world_odom(); }

  /// The objects that are believed and those whose ends are still to be seen, by ascending id, and
  /// the ground. Covariances stay empty.
  [[nodiscard]] objects::ObjectMap map() const;

  /// The same with covariances given the poses, widened as in `reported_map`: what is known of the
  /// objects beside the robot. As cheap as one linearisation.
  [[nodiscard]] objects::ObjectMap map_given_poses() const;

  /// The same with covariances in the world frame, poses marginalised; costs about as much as a few
  /// cycles. Where that fails the covariance given the poses stands instead, and `marginal` is
  /// false.
  struct MapWithCovariance {
    objects::ObjectMap map;
    bool marginal = true;
  };
  [[nodiscard]] MapWithCovariance map_with_covariance() const;

  /// The same as it is given out: widened by what windows, or with fitted noise cells, share.
  /// Incomplete objects, which are not in the graph, have theirs given the poses, and no end of
  /// them is known better than the window that saw it best.
  [[nodiscard]] objects::ObjectMap reported_map() const;

  /// What was measured but not often enough, or not well enough, to be in the map: candidates that
  /// windows speak for and that do not move, and objects whose ends nobody has seen. By ascending
  /// id, without covariances.
  [[nodiscard]] std::vector<objects::MapObject> tentative() const;

  /// Covariances of the named objects, in the order of `ids`; empty matrices for ids that are not
  /// in the map.
  [[nodiscard]] CovarianceReport covariance(std::span<const int> ids) const;

  [[nodiscard]] const std::vector<Keyframe>& keyframes() const { return trajectory_.keyframes(); }

  /// All keyframes but the newest one, and what was measured from them; `robot` and `flight` are
  /// left for the caller to know.
  [[nodiscard]] const History& history() const { return recorder_.history(); }

  /// T_world_lidar for any scan's odometry pose: the correction of the neighbouring keyframes,
  /// interpolated.
  [[nodiscard]] SE3 corrected(Time stamp, const SE3& T_odom_lidar) const {
    return trajectory_.corrected(stamp, T_odom_lidar);
  }

 private:
  [[nodiscard]] objects::ObjectMap map_with(
      const std::function<Eigen::MatrixXd(const Landmark&)>& covariance) const;
  [[nodiscard]] Chain chain();
  void record();
  void retire();
  [[nodiscard]] std::vector<Candidate> accepted(const objects::Detections& detections,
                                                SlamUpdate& report) const;
  void integrate(const std::vector<Candidate>& candidates, SlamUpdate& report);
  void take(Landmark& landmark, const Candidate& candidate);
  void expect(const std::vector<int>& measured);  ///< counts what was in view and not measured
  void review(SlamUpdate& report);
  [[nodiscard]] bool wanders(const Landmark& landmark) const;
  void optimise(const core::Budget& budget, SlamUpdate& report);

  SlamConfig config_;
  objects::ClassTable table_;
  Trajectory trajectory_;
  std::vector<Landmark> landmarks_;  ///< ascending id
  GroundMap ground_;
  HistoryRecorder recorder_;
  int next_id_ = 0;
  std::optional<Time> last_stamp_;
};

}  // namespace saker::slam
