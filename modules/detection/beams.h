#pragma once

#include <vector>

#include "detection/window.h"
#include "objects/models.h"

namespace saker::detection {

/// What the beams of a window went through on their way: space that is free, the other half of
/// what a scan tells (Elfes, "Using Occupancy Grids for Mobile Robot Perception and Navigation",
/// Computer 1989). Keeps its memory between calls.
class Beams {
 public:
  void fill(const Window& window);

  /// \param box in the window's levelled frame; one with a negative size holds nothing
  /// \return beams (of those that the window keeps) that entered it, left it and ended behind it.
  [[nodiscard]] int through(const objects::Cuboid& box) const;

  /// \return of that many equal parts of the box, one after another along its x axis, those in
  /// which `count` beams and more ended.
  [[nodiscard]] int filled(const objects::Cuboid& box, int parts, int count) const;

  /// How near to the low face of the box's x axis beams come within the box: what they met there,
  /// if anything, lies farther on.
  /// \param count   of beams that must come so near
  /// \param least_m  way within the box from which on a beam counts
  /// \return m from that face; infinite where there are fewer
  [[nodiscard]] double nearest(const objects::Cuboid& box, int count, double least_m) const;

 private:
  /// Calls `take(from, to)` for each beam towards the box, in the box's frame.
  template <class Take>
  void for_each_towards(const objects::Cuboid& box, const Take& take) const;
  /// Calls `take(from, to, passage)` for each beam that enters the box, in the box's frame.
  template <class Take>
  void for_each_in(const objects::Cuboid& box, const Take& take) const;
  [[nodiscard]] std::size_t bin(const Beam& beam) const;

  std::vector<Eigen::Vector3f> sensors_;  ///< of each scan
  std::vector<Eigen::Vector3f> ends_;     ///< by scan and azimuth
  std::vector<std::size_t> first_;        ///< of each bin in `ends_`, and the end of the last
};

}  // namespace saker::detection
