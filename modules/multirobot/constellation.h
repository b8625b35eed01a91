#pragma once

#include <string>
#include <utility>
#include <vector>

#include "saker/core/config.h"
#include "saker/objects/object_map.h"
#include "saker/slam/trajectory.h"

/// Where one map lies in another when nobody knows where the robots took off.
namespace saker::multirobot {

struct ConstellationConfig {
  double place_sd_m = 0.1;
  double size_sd_m = 0.1;
  double radius_sd_m = 0.04;
  double heading_sd_deg = 2;
  double gate = 3;
  double sight_m = 12;
  double neighbourhood_m = 15;
  double missed = 0.25;
  double independent = 0.5;
  double level_sd_deg = 0.3;
  int least_matches = 5;
  int hypotheses = 4;
  int most_steps = 2000000;
  int most_candidates = 20000;
  double most_wrong = 1e-4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("place_sd_m", place_sd_m, {0.01, 10}, "m",
            "least sd of an object's place in its map along x, y and z, its map's drift over a "
            "constellation included");
    v.field("size_sd_m", size_sd_m, {0.01, 10}, "m", "of a vehicle's length, width and height");
    v.field("radius_sd_m", radius_sd_m, {0.001, 10}, "m", "of a trunk's or pole's radius");
    v.field("heading_sd_deg", heading_sd_deg, {0.1, 90}, "degree", "of a vehicle's heading");
    v.field("gate", gate, {1, 10}, "", "standard deviations within which two things agree");
    v.field("sight_m", sight_m, {1, 200}, "m",
            "from the path of a robot, within which it would have mapped an object");
    v.field("neighbourhood_m", neighbourhood_m, {1, 200}, "m",
            "within which objects are alike and as dense: a street, a parking lot");
    v.field("missed", missed, {0.01, 0.9}, "",
            "probability that an object in one map is not in the other where both robots looked: "
            "missed, invented, or hidden");
    v.field("independent", independent, {0.05, 1}, "",
            "share of a match's evidence that counts: objects stand in rows and on kerbs, so that "
            "one in place puts its neighbours in place");
    v.field("level_sd_deg", level_sd_deg, {0.01, 10}, "degree",
            "of roll and pitch between two maps that were levelled each for itself");
    v.field("least_matches", least_matches, {3, 1000}, "",
            "objects in common before anything is said");
    v.field("hypotheses", hypotheses, {2, 20}, "",
            "alignments that are weighed against each other, the largest cliques first");
    v.field("most_steps", most_steps, {1000, 1000000000}, "",
            "branches of one search for a clique; a search that was cut short is not believed");
    v.field("most_candidates", most_candidates, {100, 100000}, "",
            "pairs of objects that might be one; more are refused: their graph fills 50 MB");
    v.field("most_wrong", most_wrong, {1e-12, 0.5}, "",
            "probability of being wrong up to which an alignment is accepted");
  }
};

/// A map and the path it was seen from; without a path the objects' own places stand for it.
struct Survey {
  objects::ObjectMap map;
  std::vector<Eigen::Vector3d> path;  ///< in the map's frame
};

/// How far the frames may be off from what is believed: for closing loops. Not set: any pose.
struct AlignmentBounds {
  double shift_m = 0;
  double turn_deg = 180;
};

enum class AlignmentStatus {
  accepted,
  too_few,    ///< no constellation in common
  ambiguous,  ///< another alignment, or chance, explains as much
  too_large,  ///< more candidates or branches than the ceilings allow
};

[[nodiscard]] std::string to_string(AlignmentStatus status);

struct Alignment {
  AlignmentStatus status = AlignmentStatus::too_few;
  slam::PosePrior T_a_b;                     ///< set where there is a hypothesis, accepted or not
  double probability_wrong = 1;              ///< of the best hypothesis
  double evidence = 0, next_evidence = 0;    ///< log odds of the best and the second one
  std::vector<std::pair<int, int>> matches;  ///< ids in a and b
};

/// Aligns b to a by the constellations of objects that they share: yaw and translation, levelled.
///
/// Method: pairs of alike objects are nodes, connected where distance, height and headings between
/// two pairs agree; maximum cliques (Mangelson et al., "Pairwise Consistent Measurement Set
/// Maximization", ICRA 2018) give hypotheses, each fitted to all it explains. A hypothesis'
/// evidence is the log-likelihood of both maps, given the alignment, over that of two unrelated
/// maps: a match counts by how much nearer and more alike the two are than neighbours by chance, an
/// object without a match where the other robot looked counts against it. Chance and every other
/// hypothesis are the alternatives, weighed by Bayes' rule with a uniform prior over poses
/// (Laplace's approximation of the peak): `probability_wrong` is what is left for them. A parking
/// row that fits shifted by one slot is such an alternative, and so nothing is accepted.
[[nodiscard]] Alignment align(const Survey& a, const Survey& b, const ConstellationConfig& config,
                              const std::optional<AlignmentBounds>& bounds = std::nullopt);

}  // namespace saker::multirobot
