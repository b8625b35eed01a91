#pragma once

#include <vector>

#include "slam/association.h"

namespace saker::slam {

struct DuplicateConfig {
  double cuboid_distance_m = 1.3;
  double cylinder_distance_m = 0.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("cuboid_distance_m", cuboid_distance_m, {0, 10}, "m",
            "between centres; or the centre of one lies on the footprint of the other: two "
            "vehicles cannot");
    v.field("cylinder_distance_m", cylinder_distance_m, {0, 10}, "m", "between roots");
  }
};

/// Merges what turned out to be one object into the one with the lower id, until none are left.
/// \return how many went.
int merge_duplicates(std::vector<Landmark>& landmarks, const DuplicateConfig& config,
                     const LandmarkConfig& landmark_config);

}  // namespace saker::slam
