#pragma once

#include <vector>

#include "saker/slam/landmark.h"

/// Nearest-neighbour association with fixed thresholds (the paper, section IV-B.2). Two that became
/// one later: duplicates.h; two in one cluster: detection/gap.h.
namespace saker::slam {

struct AssociationConfig {
  double cuboid_gate_m = 1.5;
  double cylinder_gate_m = 0.8;
  double height_gate_m = 1.5;
  double other_class_factor = 0.7;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("cuboid_gate_m", cuboid_gate_m, {0.1, 10}, "m",
            "between centres in x-y: less than between vehicles parked side by side");
    v.field("cylinder_gate_m", cylinder_gate_m, {0.05, 10}, "m", "between roots in x-y");
    v.field("height_gate_m", height_gate_m, {0.1, 100}, "m",
            "between places in z: less than a storey");
    v.field("other_class_factor", other_class_factor, {0, 1}, "",
            "of the gate, where the classes differ (a trunk taken for a pole)");
  }
};

/// Whether two models may be one object, and how far apart they are in x-y: infinity when not.
/// Vehicles match within the gate, or where the centre of one lies on the footprint of the other.
[[nodiscard]] double association_distance(const Model& a, const Model& b, bool same_class,
                                          const AssociationConfig& config);

/// For each candidate the index of its landmark, or −1: the nearest pairs first, one to one, ties
/// to the older landmark.
[[nodiscard]] std::vector<int> associate(const std::vector<Candidate>& candidates,
                                         const std::vector<Landmark>& landmarks,
                                         const objects::ClassTable& table,
                                         const AssociationConfig& config);

}  // namespace saker::slam
