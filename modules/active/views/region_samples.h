#pragma once

#include <string>
#include <vector>

#include "saker/active/views/viewpoint.h"

/// Samples of the region of good views.
///
/// Reads the lattice of candidates and which of them lie in the region, makes indices of samples.
/// Method: the paper, "Uncertainty minimization". Cost: linear in the lattice.
namespace saker::active {

/// How the region of good views is sampled (paper, "Uncertainty minimization", figure of the
/// sampling strategies).
enum class Sampling { uniform, centroids };

[[nodiscard]] inline std::vector<std::string> enum_names(Sampling) {
  return {"uniform", "centroids"};
}

/// The samples of a region, as indices into the lattice of candidates around a target (directions ×
/// rings, as `sample_viewpoints` makes it). Uniform: all that lie in it. Centroids: of each of its
/// connected parts (neighbours in direction or ring) the one that is nearest to the part's mean; so
/// that of a ring, whose mean is the target, lies on the ring.
/// \param in_region  one a candidate.
[[nodiscard]] std::vector<int> region_samples(const std::vector<ViewpointCandidate>& lattice,
                                              const std::vector<bool>& in_region, Sampling sampling,
                                              int rings);

}  // namespace saker::active
