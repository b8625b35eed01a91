#include "slam/duplicates.h"

#include <cmath>

namespace saker::slam {
namespace {

bool one_object(const Landmark& a, const Landmark& b, const DuplicateConfig& config) {
  const AssociationConfig gates{config.cuboid_distance_m, config.cylinder_distance_m,
                                AssociationConfig{}.height_gate_m, 1};
  return std::isfinite(association_distance(a.model, b.model, true, gates));
}

}  // namespace

int merge_duplicates(std::vector<Landmark>& landmarks, const DuplicateConfig& config,
                     const LandmarkConfig& landmark_config) {
  int merged = 0;
  for (std::size_t a = 0; a < landmarks.size(); ++a) {
    for (std::size_t b = a + 1; b < landmarks.size();) {
      if (!one_object(landmarks[a], landmarks[b], config)) {
        ++b;
        continue;
      }
      if (landmarks[b].seen >
          landmarks[a].seen) {  // the better known one's estimate, the older one's id
        std::swap(landmarks[a], landmarks[b]);
        std::swap(landmarks[a].id, landmarks[b].id);
      }
      absorb(landmarks[a], landmarks[b], landmark_config);
      landmarks.erase(landmarks.begin() + static_cast<std::ptrdiff_t>(b));
      ++merged;
    }
  }
  return merged;
}

}  // namespace saker::slam
