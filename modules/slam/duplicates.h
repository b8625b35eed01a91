#pragma once

#include <span>
#include <vector>

#include "saker/slam/association.h"

namespace saker::slam {

struct DuplicateConfig {
  double cuboid_distance_m = 1.3;
  double cuboid_overlap = 0.2;
  double beside_overlap = 0.1;
  double part_overlap = 0.6;
  double cylinder_distance_m = 0.5;
  double touching_m = 0.1;
  double most_place_sd_m = 1.3;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("cuboid_distance_m", cuboid_distance_m, {0, 10}, "m",
            "between centres; or the centre of one lies on the footprint of the other: two "
            "vehicles cannot");
    v.field("cuboid_overlap", cuboid_overlap, {0.01, 1}, "",
            "of the smaller footprint: two vehicles cannot stand on one ground; what errors of "
            "size and heading make vehicles side by side seem to share is less than half of it");
    v.field("beside_overlap", beside_overlap, {0, 1}, "",
            "of the smaller footprint, up to which two measured vehicles stand beside each other: "
            "what errors of size and heading make");
    v.field(
        "part_overlap", part_overlap, {0, 1}, "",
        "of the smaller footprint, from which on a measured vehicle, or a piece of one, is what "
        "the map has there: neighbours across which a box lies share less with it");
    v.field("cylinder_distance_m", cylinder_distance_m, {0, 10}, "m", "between roots");
    v.field("touching_m", touching_m, {0, 10}, "m",
            "between the surfaces of two cylinders: a pole cannot stand in a trunk; the error of a "
            "radius");
    v.field("most_place_sd_m", most_place_sd_m, {0.01, 10}, "m",
            "of a measured vehicle's place, above which it may be a piece of any: half of what "
            "lies between vehicles side by side");
  }
};

/// Counts for each cuboid whether a window measured on its ground two objects beside each other,
/// neither of which it can be, or anything else. Pieces of vehicles, whose place nobody saw, tell
/// nothing.
void count_on_ground(std::vector<Landmark>& landmarks, std::span<const Candidate> candidates,
                     const DuplicateConfig& config);

/// Merges what turned out to be one object into the one with the lower id, until none are left. The
/// class does not matter: a trunk and a pole at one place are one object, whose class is fused.
/// \return how many went.
int merge_duplicates(std::vector<Landmark>& landmarks, const DuplicateConfig& config,
                     const LandmarkConfig& landmark_config);

}  // namespace saker::slam
