#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "core/config.h"
#include "detection/beams.h"
#include "detection/footprint.h"
#include "detection/interval.h"
#include "detection/motion.h"
#include "detection/surroundings.h"
#include "objects/measurement.h"

/// The virtual sensor of vehicles: a cluster's points to a cuboid with covariance.
///
/// Reads points in the local ground's frame (z = 0 the ground), with the scan each came from, and
/// what their beams went through. Motion, footprint (footprint.h), then the edges (edges.h): one
/// beside which beams went on is measured; of one that was hidden the class's size says where it
/// likely is, with a covariance that says so (interval.h); one amid points of no object, or
/// beyond which a side goes on, is doubtful. What beams go through in the middle is more than one
/// vehicle. The lower end is the front (paper, III-A).
namespace saker::detection {

/// Where in its shadow, between what was seen of it and where beams went through, an end lies that
/// no sensor looked at: behind the rounded edge of a bonnet the bumper stands out, an upright tail
/// throws a long shadow beyond itself. The lower end is the front (paper, III-A).
struct ShadowConfig {
  double bonnet_m = 0.75;
  double place = 0.85;
  double place_per_m = 1.3;
  double least_place = 0.2;
  double apart_m = 0.05;
  double spread = 0.85;
  double depth_m = 0.4;
  double top_percentile = 90;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("bonnet_m", bonnet_m, {0, 5}, "m", "height of a low bonnet's end above the ground");
    v.field(
        "place", place, {0, 1}, "",
        "of the shadow, from what was seen on, at which the lower end lies where it is as high");
    v.field("place_per_m", place_per_m, {0, 10}, "1/m",
            "less of it by how much higher it is: with both, the median fronts of 101 vehicles in "
            "eight simulated flights");
    v.field("least_place", least_place, {0, 1}, "",
            "of however high a one, and of the higher end: their median tails");
    v.field("apart_m", apart_m, {0.001, 1}, "m",
            "by which the lower end must be lower to be surely the front");
    v.field("spread", spread, {0, 10}, "",
            "of the shadow, the width in which it lies about its place: theirs scatter by 0.2 "
            "(tails) and 0.3 of the shadow (fronts)");
    v.field("depth_m", depth_m, {0.05, 2}, "m",
            "inward from the end: how high what was seen of it is, is told there");
    v.field("top_percentile", top_percentile, {50, 100}, "%", "of the heights there");
  }
};

/// The space beside an edge in which beams show that the vehicle ends there.
struct BeyondConfig {
  double near_m = 0.15;
  double far_m = 1.5;
  double inset_m = 0.07;
  double lowest_m = 0.25;
  double highest_m = 0.65;
  double least_way_m = 0.2;
  int beams = 3;
  ShadowConfig shadow;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("near_m", near_m, {0, 2}, "m", "from the edge: beyond its noise");
    v.field("far_m", far_m, {0.05, 5}, "m",
            "from the edge: what was free farther on says no more than the class's size");
    v.field("inset_m", inset_m, {0, 1}, "m",
            "from the sides: what passes along a side tells nothing of the end");
    v.field("lowest_m", lowest_m, {0, 2}, "m", "above the ground: grass and kerbs");
    v.field("highest_m", highest_m, {0.1, 3}, "m",
            "above the ground: lower than hoods and load beds, over which beams pass");
    v.field("least_way_m", least_way_m, {0, 2}, "m",
            "of a beam within: deeper than what is met in a wheel arch");
    v.field("beams", beams, {1, 1000}, "", "that make sure; of those kept (window.beam_stride)");
    v.group("shadow", shadow, "where in its shadow an end lies that no sensor looked at");
  }
};

/// The space that a vehicle fills: what beams go through is more than one.
struct GapConfig {
  double inset_m = 0.35;
  double lowest_m = 0.35;
  double highest_m = 0.75;
  double side_inset_m = 0.15;
  double side_depth_m = 0.2;
  double side_share = 0.4;
  double strip_m = 0.25;
  int beams = 4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("inset_m", inset_m, {0, 2}, "m",
            "from the footprint's edges: rounded corners and a heading that is off");
    v.field("side_inset_m", side_inset_m, {0, 2}, "m",
            "from a side that was looked at, where what lies behind it was not seen: its noise");
    v.field("side_depth_m", side_depth_m, {0.01, 2}, "m",
            "from there: as deep as beams come aslant between two vehicles half a metre apart");
    v.field("side_share", side_share, {0.01, 1}, "",
            "of the length, in its middle, where such is looked for: between the wheel arches");
    v.field("strip_m", strip_m, {0.05, 2}, "m",
            "of a side, on which nothing was met, where beams go on behind it: half of the least "
            "gap between parked vehicles");
    v.field("lowest_m", lowest_m, {0, 2}, "m", "above the ground: higher than beams pass below");
    v.field("highest_m", highest_m, {0.1, 3}, "m", "above the ground: lower than windows");
    v.field("beams", beams, {1, 1000}, "", "that make sure; of those kept (window.beam_stride)");
  }
};

/// Faces that no sensor looked at: over a roof and a hood only their upper edges are seen.
struct SetbackConfig {
  double mean_m = 0.1;
  double sd_m = 0.1;
  double outline = 0.5;
  double outside_m = 1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("mean_m", mean_m, {0, 1}, "m",
            "by which upper edges stand back behind the lower part: sides lean in, screens slope");
    v.field("sd_m", sd_m, {0, 1}, "m", "its standard deviation among vehicles and views");
    v.field("outline", outline, {0, 1}, "",
            "of that deviation for a face that is seen from beside: an outline, which shows the "
            "lower part too, but rounded");
    v.field("outside_m", outside_m, {0.01, 20}, "m",
            "that a sensor is outside of a face's plane: it looks at the face");
  }
};

/// An end amid points of no object: what stands there, a bush behind the vehicle, say, may have
/// been taken for a part of it.
struct AmidOthersConfig {
  double depth_m = 0.4;
  double sure_probability = 0.9;
  double share = 0.85;
  double sd_m = 0.7;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("depth_m", depth_m, {0.05, 2}, "m",
            "inward from the end, and outward beyond.near_m: where they are counted");
    v.field("sure_probability", sure_probability, {0, 1}, "",
            "of its class, from which on a point counts as the vehicle's: one in nine is below, of "
            "leaves taken for a vehicle all that were looked at");
    v.field("share", share, {0, 1}, "",
            "of these points and those of no object together, above which the end is doubtful; "
            "below 0.85 right ends of a real drive are, too");
    v.field("sd_m", sd_m, {0, 10}, "m",
            "more standard deviation of such an end: in simulation, above 0.7 of all points, they "
            "erred by 0.71, others by 0.06");
  }
};

/// Ends of what was seen beyond which one of its sides goes on in its line: a pillar hides a part
/// of the vehicle, or a load bed was taken for something else.
struct GoesOnConfig {
  double near_m = 0.1;
  double reach_m = 1.0;
  double step_m = 0.15;
  double aside_m = 0.1;
  double lowest_m = 0.3;
  double highest_m = 1.3;
  int beams = 2;
  double share = 0.45;
  double sd_m = 0.7;

  [[nodiscard]] int steps() const { return static_cast<int>(std::ceil(reach_m / step_m)); }

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("near_m", near_m, {0, 2}, "m", "from the end: beyond its noise");
    v.field("reach_m", reach_m, {0.1, 5}, "m", "from there: how far a side is followed beyond it");
    v.field("step_m", step_m, {0.05, 1}, "m", "in steps of this length");
    v.field("aside_m", aside_m, {0.01, 1}, "m", "of the side's line, to both sides");
    v.field("lowest_m", lowest_m, {0, 2}, "m", "above the ground: grass and kerbs");
    v.field("highest_m", highest_m, {0.1, 3}, "m", "above the ground: of load beds");
    v.field("beams", beams, {1, 1000}, "",
            "that end in a step; of those kept (window.beam_stride)");
    v.field("share", share, {0, 1}, "",
            "of the steps, from which on the end is doubtful: a vehicle in line with it, half a "
            "metre away, fills less");
    v.field("sd_m", sd_m, {0, 10}, "m", "more standard deviation of such an end, as amid_others'");
  }
};

struct VehicleNoiseConfig {
  double edge_m = 0.02;
  double edge_per_m = 0.0015;
  double unseen_m = 1.0;
  double yaw_deg = 2;
  double tilt_deg = 2;
  double ground_m = 0.06;
  double top_m = 0.08;
  BeyondConfig beyond;
  SetbackConfig setback;
  AmidOthersConfig amid_others;
  GoesOnConfig goes_on;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("edge_m", edge_m, {0.001, 2}, "m",
            "standard deviation of an edge whose face was looked at: of single windows 0.01 to "
            "0.02 m in simulated flights");
    v.field("edge_per_m", edge_per_m, {0, 0.1}, "m/m",
            "more of it by range: half the spacing of beams");
    v.field("unseen_m", unseen_m, {0.1, 10}, "m",
            "standard deviation of an edge that was not seen");
    v.field("yaw_deg", yaw_deg, {0.01, 90}, "deg", "of the heading, both sides well seen");
    v.field("tilt_deg", tilt_deg, {0.01, 90}, "deg", "of the local ground's normal");
    v.field("ground_m", ground_m, {0.001, 2}, "m", "of the local ground's height");
    v.field("top_m", top_m, {0.001, 2}, "m", "of the top");
    v.group("beyond", beyond, "free space that shows an edge");
    v.group("setback", setback, "faces that no sensor looked at");
    v.group("amid_others", amid_others, "ends amid points of no object");
    v.group("goes_on", goes_on, "ends beyond which a side goes on");
  }
};

/// A higher vehicle is a longer and a wider one: the class's size, for what is hidden, goes by the
/// top that was seen. A low top may be all that was seen of a high vehicle: it says nothing.
struct TallConfig {
  double from_m = 1.5;
  double most_m = 2.2;
  double length_per_m = 1.4;
  double width_per_m = 0.28;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("from_m", from_m, {0, 10}, "m", "top of the class's mean: up to here nothing is added");
    v.field("most_m", most_m, {0, 10}, "m", "from here on no more is: vans are of one length");
    v.field("length_per_m", length_per_m, {0, 10}, "m/m",
            "longer by that: a line through a dozen common makes, a Fiat 500 to a Sprinter");
    v.field("width_per_m", width_per_m, {0, 10}, "m/m",
            "wider by that: 1.80 m of saloons, 1.86 m of a Tiguan or RAV4, 1.93 m of vans");
  }
};

struct VehicleConfig {
  double lowest_m = 0.2;
  double highest_m = 2.6;
  double top_percentile = 98;
  int least_points = 25;
  double least_length_m = 1.0;
  double least_height_m = 0.8;
  double most_length_m = 7.5;
  double most_width_m = 3.0;
  double length_m = 4.4;
  double length_sd_m = 0.45;
  double width_m = 1.8;
  double width_sd_m = 0.12;
  TallConfig tall;
  double prior_windows = 20;
  double heading_cost = 0.7;
  double thin_m = 0.05;
  double front_sd_m = 0.15;
  double most_front_log_odds = 3;
  FootprintConfig footprint;
  MotionConfig motion;
  GapConfig gap;
  VehicleNoiseConfig noise;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("lowest_m", lowest_m, {-1, 2}, "m",
            "lower end of the elevation window above the local ground: leaves the road out");
    v.field("highest_m", highest_m, {0.5, 10}, "m", "its upper end: leaves branches out");
    v.field("top_percentile", top_percentile, {50, 100}, "%", "of the points' heights: the top");
    v.field("least_points", least_points, {5, 100000}, "points", "fewer are no vehicle");
    v.field("least_length_m", least_length_m, {0.1, 10}, "m",
            "a cluster whose longer side is shorter is refused");
    v.field("least_height_m", least_height_m, {0.1, 10}, "m", "a lower one is refused");
    v.field("most_length_m", most_length_m, {1, 50}, "m", "a longer one is split, else refused");
    v.field("most_width_m", most_width_m, {1, 50}, "m", "a wider one is split, else refused");
    v.field("length_m", length_m, {1, 20}, "m", "mean length of the class, for unseen ends");
    v.field("length_sd_m", length_sd_m, {0.01, 10}, "m", "its standard deviation");
    v.field("width_m", width_m, {0.5, 5}, "m", "mean width of the class, for unseen sides");
    v.field("width_sd_m", width_sd_m, {0.01, 5}, "m", "its standard deviation");
    v.group("tall", tall, "how the class's length and width go by the top");
    v.field("prior_windows", prior_windows, {1, 10000}, "",
            "that say as much of the class's size as one of them: all say the same, and many that "
            "hide a side would outvote the few that saw both");
    v.field("heading_cost", heading_cost, {0.01, 100}, "",
            "by which a heading must be costlier than the one across it for e times the odds that "
            "it is wrong: below 0.5 a third are, from 1 to 2 one in twenty");
    v.field("thin_m", thin_m, {0.01, 0.5}, "m",
            "squares to which the footprint's points are thinned");
    v.field("front_sd_m", front_sd_m, {0.01, 2}, "m",
            "how far the ends' heights of one vehicle scatter: scale of the front's log-odds");
    v.field("most_front_log_odds", most_front_log_odds, {0, 20}, "", "of one measurement");
    v.group("footprint", footprint, "rectangle on the ground");
    v.group("motion", motion, "vehicles that move");
    v.group("gap", gap, "free space within");
    v.group("noise", noise, "standard deviations of a measurement");
  }
};

/// A point of a cluster in the local ground's frame.
struct BodyPoint {
  Eigen::Vector3f position;
  float seconds = 0;
  float probability = 1;  ///< of the class that it is labelled
};

/// `parted`: beams went through the middle of it, it is more than one thing.
enum class VehicleStatus { fitted, too_few, too_small, too_large, parted };

struct VehicleFit {
  VehicleStatus status = VehicleStatus::too_few;
  objects::Cuboid cuboid;  ///< local ground's frame
  Matrix9d covariance = Matrix9d::Constant(NAN);
  double front_log_odds = 0;
  Motion motion;
};

/// From where a cluster was looked at.
struct Sight {
  std::vector<Eigen::Vector3d> sensors;  ///< where the scans were taken, in the frame of the points
  const Beams& beams;
  const Surroundings& surroundings;
  SE3 T_level_local;  ///< from the frame of the points to that of the beams and the surroundings

  /// \param box in the frame of the points
  [[nodiscard]] int through(const objects::Cuboid& box) const {
    return beams.through(objects::transformed(T_level_local, box));
  }
  [[nodiscard]] int filled(const objects::Cuboid& box, int parts, int count) const {
    return beams.filled(objects::transformed(T_level_local, box), parts, count);
  }
  [[nodiscard]] double nearest(const objects::Cuboid& box, int count, double least_m) const {
    return beams.nearest(objects::transformed(T_level_local, box), count, least_m);
  }
  /// \return points of no object in the box, between the heights of `SurroundingsConfig`
  [[nodiscard]] int others(const objects::Cuboid& box) const {
    return surroundings.inside(objects::transformed(T_level_local, box));
  }
};

[[nodiscard]] VehicleFit fit_vehicle(const std::vector<BodyPoint>& points, const Sight& sight,
                                     const VehicleConfig& config);

}  // namespace saker::detection
