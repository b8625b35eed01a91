#include "saker/slam/association.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace saker::slam {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Pair {
  double distance;
  int candidate, landmark;
};

std::vector<Pair> pairs_in_gate(const std::vector<Candidate>& candidates,
                                const std::vector<Landmark>& landmarks,
                                const objects::ClassTable& table, const AssociationConfig& config) {
  std::vector<Pair> pairs;
  for (std::size_t l = 0; l < landmarks.size(); ++l) {
    const objects::ClassId id = class_of(landmarks[l], table);
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      const double distance =
          association_distance(candidates[c].in_world, landmarks[l].model,
                               candidates[c].measurement->class_id == id, config);
      if (distance < kNever) pairs.push_back({distance, static_cast<int>(c), static_cast<int>(l)});
    }
  }
  return pairs;
}

}  // namespace

double association_distance(const Model& a, const Model& b, bool same_class,
                            const AssociationConfig& config) {
  if (is_cuboid(a) != is_cuboid(b)) return kNever;
  const Eigen::Vector3d between = objects::place(a) - objects::place(b);
  if (std::abs(between.z()) > config.height_gate_m) return kNever;
  const double distance = between.head<2>().norm();
  const double gate = (is_cuboid(a) ? config.cuboid_gate_m : config.cylinder_gate_m) *
                      (same_class ? 1 : config.other_class_factor);
  if (distance <= gate) return distance;
  if (!is_cuboid(a)) return kNever;
  const bool inside = on_footprint(std::get<objects::Cuboid>(a), objects::place(b)) ||
                      on_footprint(std::get<objects::Cuboid>(b), objects::place(a));
  return inside ? distance : kNever;
}

std::vector<int> associate(const std::vector<Candidate>& candidates,
                           const std::vector<Landmark>& landmarks, const objects::ClassTable& table,
                           const AssociationConfig& config) {
  std::vector<Pair> pairs = pairs_in_gate(candidates, landmarks, table, config);
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.distance, a.landmark, a.candidate) <
           std::tie(b.distance, b.landmark, b.candidate);
  });
  std::vector<int> landmark_of(candidates.size(), -1);
  std::vector<bool> taken(landmarks.size(), false);
  for (const Pair& pair : pairs) {
    const auto c = static_cast<std::size_t>(pair.candidate),
               l = static_cast<std::size_t>(pair.landmark);
    if (landmark_of[c] >= 0 || taken[l]) continue;
    landmark_of[c] = pair.landmark;
    taken[l] = true;
  }
  return landmark_of;
}

}  // namespace saker::slam
