#pragma once

#include <vector>

#include "slam/association.h"

namespace saker::slam {

struct DuplicateConfig {
  double cuboid_distance_m = 1.3;
  double cuboid_overlap = 0.2;
  double cylinder_distance_m = 0.5;
  double touching_m = 0.1;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("cuboid_distance_m", cuboid_distance_m, {0, 10}, "m",
            "between centres; or the centre of one lies on the footprint of the other: two "
            "vehicles cannot");
    v.field("cuboid_overlap", cuboid_overlap, {0.01, 1}, "",
            "of the smaller footprint: two vehicles cannot stand on one ground; what errors of "
            "size and heading make vehicles side by side seem to share is less than half of it");
    v.field("cylinder_distance_m", cylinder_distance_m, {0, 10}, "m", "between roots");
    v.field("touching_m", touching_m, {0, 10}, "m",
            "between the surfaces of two cylinders: a pole cannot stand in a trunk; the error of a "
            "radius");
  }
};

/// Merges what turned out to be one object into the one with the lower id, until none are left. The
/// class does not matter: a trunk and a pole at one place are one object, whose class is fused.
/// \return how many went.
int merge_duplicates(std::vector<Landmark>& landmarks, const DuplicateConfig& config,
                     const LandmarkConfig& landmark_config);

}  // namespace saker::slam
