#include "saker/active/views/region_samples.h"

#include <algorithm>

namespace saker::active {
namespace {

/// The neighbours of a place in the lattice: directions go round, rings do not.
std::vector<int> neighbours(int place, int directions, int rings) {
  const int direction = place / rings, ring = place % rings;
  std::vector<int> found = {(direction + 1) % directions * rings + ring,
                            (direction + directions - 1) % directions * rings + ring};
  if (ring > 0) found.push_back(place - 1);
  if (ring + 1 < rings) found.push_back(place + 1);
  return found;
}

/// The connected part that holds `seed`; what is taken leaves `open`.
std::vector<int> take_part(int seed, std::vector<bool>& open, int rings) {
  const int directions = static_cast<int>(open.size()) / rings;
  std::vector<int> part = {seed};
  open[seed] = false;
  for (std::size_t next = 0; next < part.size(); ++next) {
    for (const int neighbour : neighbours(part[next], directions, rings)) {
      if (!open[neighbour]) continue;
      open[neighbour] = false;
      part.push_back(neighbour);
    }
  }
  return part;
}

int nearest_to_mean(const std::vector<int>& part, const std::vector<ViewpointCandidate>& lattice) {
  const auto place = [&](int index) { return lattice[index].viewpoint.position; };
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int index : part) mean += place(index) / static_cast<double>(part.size());
  return *std::min_element(part.begin(), part.end(), [&](int a, int b) {
    return (place(a) - mean).squaredNorm() < (place(b) - mean).squaredNorm();
  });
}

}  // namespace

std::vector<int> region_samples(const std::vector<ViewpointCandidate>& lattice,
                                const std::vector<bool>& in_region, Sampling sampling, int rings) {
  std::vector<bool> open = in_region;
  std::vector<int> samples;
  for (int index = 0; index < static_cast<int>(lattice.size()); ++index) {
    if (!open[index]) continue;
    if (sampling == Sampling::uniform) {
      samples.push_back(index);
    } else {
      samples.push_back(nearest_to_mean(take_part(index, open, rings), lattice));
    }
  }
  return samples;
}

}  // namespace saker::active
