#include "saker/slam/duplicates.h"

#include <algorithm>
#include <cmath>

namespace saker::slam {
namespace {

/// How far apart the axes of two cylinders may be at the ground: side by side, or one inside the
/// other, as a thick trunk that was fitted around a pole.
double cylinder_gate_m(const Model& a, const Model& b, const DuplicateConfig& config) {
  if (is_cuboid(a) || is_cuboid(b)) return config.cylinder_distance_m;
  const double overlap = std::get<objects::Cylinder>(a).radius +
                         std::get<objects::Cylinder>(b).radius + config.touching_m;
  return std::max(config.cylinder_distance_m, overlap);
}

/// Of the smaller footprint, 0 … 1; of cylinders 0.
double overlap(const Model& a, const Model& b) {
  if (!is_cuboid(a) || !is_cuboid(b)) return 0;
  return footprint_overlap(std::get<objects::Cuboid>(a), std::get<objects::Cuboid>(b));
}

/// As when a first view had the heading wrong: the centres may lie outside of each other then.
bool stand_on_one_ground(const Model& a, const Model& b, double least_overlap,
                         double height_gate_m) {
  if (std::abs(objects::place(a).z() - objects::place(b).z()) > height_gate_m) return false;
  return overlap(a, b) > least_overlap;
}

bool one_object(const Landmark& a, const Landmark& b, const DuplicateConfig& config) {
  AssociationConfig gates;
  gates.cuboid_gate_m = config.cuboid_distance_m;
  gates.cylinder_gate_m = cylinder_gate_m(a.model, b.model, config);
  return std::isfinite(association_distance(a.model, b.model, true, gates)) ||
         stand_on_one_ground(a.model, b.model, config.cuboid_overlap, gates.height_gate_m);
}

bool knows_more(const Landmark& a, const Landmark& b, const LandmarkConfig& config) {
  const bool believed_a = believed(a, config);
  return believed_a != believed(b, config) ? believed_a : a.seen > b.seen;
}

/// Boxes about parts of vehicles lie between neighbours, and hold windows of both: about a vehicle
/// whose ends were seen they tell nothing.
bool is_part_of(const Landmark& part, const Landmark& whole, const LandmarkConfig& config) {
  return is_cuboid(part.model) && !part.moving && believed(whole, config) &&
         !believed(part, config);
}

}  // namespace

void count_on_ground(std::vector<Landmark>& landmarks, std::span<const Candidate> candidates,
                     const DuplicateConfig& config) {
  for (Landmark& landmark : landmarks) {
    bool measured = false;
    std::vector<const Model*> in_part;
    for (const Candidate& candidate : candidates) {
      const double shared = overlap(candidate.in_world, landmark.model);
      if (candidate.measurement->moving || shared <= config.cuboid_overlap) continue;
      if (place_sd(candidate) > config.most_place_sd_m) continue;
      measured = true;
      if (shared < config.part_overlap) in_part.push_back(&candidate.in_world);
    }
    if (!measured) continue;
    const bool two = std::ranges::any_of(in_part, [&](const Model* a) {
      return std::ranges::any_of(
          in_part, [&](const Model* b) { return overlap(*a, *b) <= config.beside_overlap; });
    });
    ++(two ? landmark.seen_as_two : landmark.seen_as_one);
  }
}

int merge_duplicates(std::vector<Landmark>& landmarks, const DuplicateConfig& config,
                     const LandmarkConfig& landmark_config) {
  int merged = 0;
  for (std::size_t a = 0; a < landmarks.size(); ++a) {
    for (std::size_t b = a + 1; b < landmarks.size();) {
      if (!one_object(landmarks[a], landmarks[b], config)) {
        ++b;
        continue;
      }
      if (knows_more(landmarks[b], landmarks[a], landmark_config)) {  // and the older one's id
        std::swap(landmarks[a], landmarks[b]);
        std::swap(landmarks[a].id, landmarks[b].id);
      }
      if (!is_part_of(landmarks[b], landmarks[a], landmark_config))
        absorb(landmarks[a], landmarks[b]);
      landmarks.erase(landmarks.begin() + static_cast<std::ptrdiff_t>(b));
      ++merged;
    }
  }
  return merged;
}

}  // namespace saker::slam
