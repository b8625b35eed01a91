#pragma once

#include <array>
#include <limits>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/time.h"
#include "saker/objects/measurement.h"
#include "saker/objects/object_map.h"
#include "saker/slam/model_algebra.h"
#include "saker/slam/trajectory.h"

namespace saker::slam {

struct LandmarkConfig {
  int confirm_observations = 3;
  double confirm_span_s = 0.9;
  double surely_seen_m = 8;
  double track_s = 3;
  int still_windows = 20;
  double still_m = 0.4;
  double class_clamp = 0.05;
  double clutter_probability = 0.6;
  double clutter_points = 100;
  double missed_log_odds = 0.5;
  double least_log_odds = 6;
  int two_windows = 3;
  double two_share = 0.2;
  double moving_distance_m = 1.0;
  double sure_sd = 1.4;
  double most_length_sd_m = 0.45;
  int most = 1000;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("confirm_observations", confirm_observations, {1, 1000}, "",
            "windows in which an object was measured before it enters the map");
    v.field(
        "confirm_span_s", confirm_span_s, {0, 100}, "s",
        "between the first and the last of them: more than the overlap of neighbouring windows");
    v.field("surely_seen_m", surely_seen_m, {0, 100}, "m",
            "from this distance on a sensor in flight does not look over an object");
    v.field("track_s", track_s, {0, 60}, "s",
            "for which a moving object that is out of sight is remembered");
    v.field(
        "still_windows", still_windows, {1, 1000}, "",
        "in which what moved must stand before it counts as an object again, and after which one "
        "false window makes nothing move: 10 s, longer than most stops in traffic");
    v.field("still_m", still_m, {0, 5}, "m",
            "between windows: less is standing, the noise of a measured centre");
    v.field("class_clamp", class_clamp, {1e-4, 0.3}, "",
            "least probability of a class that one measurement may state, so that no single one "
            "decides");
    v.field("clutter_probability", clutter_probability, {0.05, 0.95}, "",
            "probability of its shape in a window that speaks neither for nor against an object: "
            "segmentation wavers about bushes and walls");
    v.field("clutter_points", clutter_points, {0, 1e5}, "",
            "of such a window, which count with those of each window: a few points that hang "
            "together all err alike (scripts/clutter-fit)");
    v.field(
        "missed_log_odds", missed_log_odds, {0, 10}, "",
        "that a window takes off which should have measured the object and did not: a quarter of "
        "what others bring, for they come in runs, while what is not in the map hides it");
    v.field("least_log_odds", least_log_odds, {-100, 100}, "",
            "of an object against clutter, all windows' summed, before it is believed");
    v.field("two_windows", two_windows, {1, 1000}, "",
            "in which two objects beside each other were measured on a vehicle's ground: it was "
            "laid across both");
    v.field("two_share", two_share, {0, 1}, "",
            "that those must be of all windows that measured something there: from afar two "
            "fronts seem one, but one vehicle seldom seems two");
    v.field("moving_distance_m", moving_distance_m, {0.2, 20}, "m",
            "by which an object's measured footprints reach beyond one object's length: it moves");
    v.field("sure_sd", sure_sd, {0, 10}, "",
            "standard deviations by which a part that was not seen may lie nearer");
    v.field("most_length_sd_m", most_length_sd_m, {0.01, 10}, "m",
            "standard deviation of a cuboid's length by two windows that saw its ends best, above "
            "which it says no more than makers' lengths do (length_sd_m of the class table): the "
            "class's mean is no object yet");
    v.field("most", most, {1, 100000}, "",
            "objects kept; the one with the fewest observations goes first");
  }
};

/// Which axis of a cuboid is its length.
struct LengthAxisConfig {
  double elongation = 1.5;
  double most_width_sd_m = 0.6;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field(
        "elongation", elongation, {1, 10}, "",
        "of length to width, from which on the longer side is the length: parts of vehicles are "
        "squarer");
    v.field("most_width_sd_m", most_width_sd_m, {0.01, 10}, "m",
            "standard deviation of a width up to which its window tells which side is the length: "
            "where the heading is a guess, detection states more");
  }
};

/// A measurement on its way into the map: in the newest keyframe's frame, with the covariance it
/// has there.
struct Candidate {
  const objects::Measurement* measurement = nullptr;
  Gaussian in_keyframe;
  Model in_world;                ///< by the current estimate
  double distance = 0;           ///< from the lidar, m
  double shape_probability = 0;  ///< of all classes of its shape together
  int chain = 0;                 ///< of the keyframe, among those of the graph
};

/// Of where a cuboid was measured in x-y, m: of a piece of one, how far its middle may lie.
[[nodiscard]] double place_sd(const Candidate& candidate);

/// What one keyframe says about one object from one view cell; several measurements are fused.
struct Observation {
  int keyframe = 0;   ///< serial
  Gaussian measured;  ///< in the keyframe's lidar frame, cuboids named as the landmark's; of a
                      ///< cell: the windows' mean, as uncertain as one of them
  int cell = -1;      ///< Measurement::view_cell
  int windows = 1;    ///< that were measured
  int chain = 0;      ///< of the keyframe, among those of the graph
};

/// Where a cuboid was measured in one window: its bottom, in the world frame as it was estimated
/// then.
struct Footprint {
  Eigen::Vector3d centre;
  Eigen::Vector2d size;
  double sd = 0;  ///< of the centre, m: what was not seen may lie elsewhere
};

/// How well the low and the high end of a cuboid along an axis were seen, m, each in the windows
/// that saw it best of those that took this axis for the length: one alone may have taken something
/// else for an end.
struct SeenEnds {
  Eigen::Vector2d best = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d next = best;  ///< in the window that saw it best but one

  void see(const Eigen::Vector2d& sds);
};

/// An object of the graph, or a candidate for one.
struct Landmark {
  int id = -1;
  Model model;                            ///< world; the estimate
  std::vector<Observation> observations;  ///< ascending chain and keyframe
  std::vector<double>
      class_log;        ///< of the fused class probability, one an entry of the class table
  double log_odds = 0;  ///< of an object against clutter, by the windows in which it was measured
  Eigen::Vector2d front =
      Eigen::Vector2d::Zero();  ///< log-odds that the front is along +x, along +y
  int seen = 0;                 ///< windows in which it was measured
  int missed = 0;               ///< windows in which it should have been and was not
  int seen_as_one = 0,
      seen_as_two = 0;            ///< windows with one, with two beside each other, on its ground
  int seen_moving = 0;            ///< windows in which what was measured there moved
  std::vector<Footprint> recent;  ///< the last windows', oldest first; one track without a gap
  bool moving =
      false;      ///< found to move: followed, so that it leaves nothing behind, and not in the map
  int still = 0;  ///< windows for which what moved has stood
  Time first_stamp = 0, last_stamp = 0;
  std::array<SeenEnds, 2> ends;  ///< of cuboids, along x and y
  double nearest = std::numeric_limits<double>::infinity(),
         farthest = 0;  ///< distances at which it was measured, m
};

[[nodiscard]] Landmark new_landmark(int id, const Candidate& candidate, int keyframe,
                                    const LandmarkConfig& config);

/// Takes a measurement in: turns its heading to the nearest of four, fuses class and front,
/// remembers it.
void observe(Landmark& landmark, const Candidate& candidate, int keyframe,
             const LandmarkConfig& config);

/// The next place of what moves: older measurements are void. One that stands for long enough is an
/// object again.
void follow(Landmark& landmark, const Candidate& candidate, int keyframe,
            const LandmarkConfig& config);

/// Takes in a second observation from the same keyframe and cell. Without a cell their errors are
/// independent; windows from one cell share theirs, so that their mean is no better than one of
/// them.
void join(Observation& a, const Observation& b);

/// Quarters that turn a measured cuboid to the nearest heading of `reference`, whatever each takes
/// for its length: where one face alone was seen that is a guess. 0 for cylinders.
[[nodiscard]] int turn_between(const Model& model, const Model& reference);

/// The logarithms of probabilities, none of them below `least` or above 1 − least, and back.
[[nodiscard]] std::vector<double> clamped_log(const std::vector<double>& probability, double least);
[[nodiscard]] std::vector<double> normalised(const std::vector<double>& log_probability);

/// Takes over all that `other` knows: two candidates were one object.
void absorb(Landmark& landmark, const Landmark& other);

/// Keeps observations in the order of chains, keyframes and cells, one each: two of the same are
/// joined.
void remember(Landmark& landmark, const Observation& observation);

/// What each weighs: windows of a view cell share their error and weigh as one together, others one
/// each; those that took a vehicle's side for its length nothing, once more views tell otherwise.
[[nodiscard]] std::vector<double> observation_weights(const Landmark& landmark,
                                                      const LengthAxisConfig& config);

[[nodiscard]] std::vector<double> class_probability(const Landmark& landmark);

/// The most probable class of the landmark's shape.
[[nodiscard]] objects::ClassId class_of(const Landmark& landmark, const objects::ClassTable& table);

/// Seen often enough, over long enough, and standing still, and exists: by the log-odds of windows
/// that measured it and that missed it (Musicki, Evans, Stankovic, "Integrated Probabilistic Data
/// Association", 1994).
[[nodiscard]] bool stands(const Landmark& landmark, const LandmarkConfig& config);

/// Of the longer side of a cuboid's estimate.
[[nodiscard]] const SeenEnds& seen_ends(const Landmark& landmark);

/// The same, and its length known.
[[nodiscard]] bool believed(const Landmark& landmark, const LandmarkConfig& config);

/// Whether the footprints that were measured lately cover together more than one object: it moves.
/// Of one that was measured for long, a single window may have an end wrong.
/// What is seen of a parked vehicle wanders too, as the robot passes, but stays within the vehicle.
/// \param footprint_m  of its class (objects/class_table.h)
[[nodiscard]] bool moves(const Landmark& landmark, double footprint_m,
                         const LandmarkConfig& config);

/// Whether the last footprint stands where it stood before others stood elsewhere: what was taken
/// for one object are two.
[[nodiscard]] bool comes_back(const Landmark& landmark, const LandmarkConfig& config);

/// Whether what was measured on its ground are two objects beside each other: a first view joined
/// them.
[[nodiscard]] bool lies_across_two(const Landmark& landmark, const LandmarkConfig& config);

/// Quarters that turn a cuboid's frame to its name: the longer edge is the length, x points to the
/// front.
[[nodiscard]] int naming_turn(const Landmark& landmark);

/// The landmark as maps hold it, without a covariance; and its covariance by that name.
[[nodiscard]] objects::MapObject map_object(const Landmark& landmark,
                                            const objects::ClassTable& table);
[[nodiscard]] Eigen::MatrixXd named_covariance(const Landmark& landmark,
                                               const Eigen::MatrixXd& covariance);
/// How well the rear and the front of a cuboid by that name were seen in two windows, m; infinite
/// where they were not.
[[nodiscard]] Eigen::Vector2d named_ends(const Landmark& landmark);

}  // namespace saker::slam
