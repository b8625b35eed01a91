#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "saker/detection/window.h"
#include "saker/objects/models.h"

namespace saker::detection {

/// How far a face stands back from its outermost line: a superellipse of the fourth order.
struct Bow {
  double depth = 0;       ///< m, at its corners
  double half_width = 1;  ///< m
  double middle = 0;      ///< m, across

  /// \param across m
  [[nodiscard]] double at(double across) const {
    const double share = std::min(std::abs(across - middle) / half_width, 1.0);
    return depth * share * share * share * share;
  }
};

/// What the beams of a window went through on their way: space that is free, the other half of
/// what a scan tells (Elfes, "Using Occupancy Grids for Mobile Robot Perception and Navigation",
/// Computer 1989). Keeps its memory between calls.
class Beams {
 public:
  void fill(const Window& window);

  /// \param box in the window's levelled frame; one with a negative size holds nothing
  /// \return beams (of those that the window keeps) that entered it, left it and ended behind it.
  [[nodiscard]] int through(const objects::Cuboid& box) const;

  /// \return of the beams that go through it those that do not end in `body`, either
  [[nodiscard]] int through(const objects::Cuboid& box, const objects::Cuboid& body) const;

  /// \return beams that ended in it
  [[nodiscard]] int ended(const objects::Cuboid& box) const;

  /// How near to the low face of the box's x axis, a face that bows away from x along y, beams come
  /// within the box: the most that the face's outermost line lies farther on.
  /// \param count    of beams that must come so near
  /// \param least_m  from the low face: what comes nearer, as through glass or arches, tells
  /// nothing \return m from the low face; infinite where there are fewer
  [[nodiscard]] double nearest(const objects::Cuboid& box, int count, double least_m,
                               const Bow& bow) const;

 private:
  /// Calls `take(from, to)` for each beam towards the box, in the box's frame.
  template <class Take>
  void for_each_towards(const objects::Cuboid& box, const Take& take) const;
  /// Calls `take(from, to, passage)` for each beam that enters the box, in the box's frame.
  template <class Take>
  void for_each_in(const objects::Cuboid& box, const Take& take) const;
  [[nodiscard]] std::size_t bin(const Beam& beam) const;

  std::vector<Eigen::Vector3f> sensors_;  ///< of each scan
  std::vector<Eigen::Vector3f> ends_;     ///< by scan, azimuth and slope
  std::vector<std::uint32_t> bins_;       ///< of each beam, kept for its memory
  std::vector<std::uint32_t> first_;      ///< of each bin in `ends_`, and the end of the last
};

}  // namespace saker::detection
