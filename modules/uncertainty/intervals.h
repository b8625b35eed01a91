#pragma once

#include <vector>

#include "saker/uncertainty/view.h"

namespace saker::uncertainty {

/// The paper's discretisation of what measurements depend on: range × viewing angle. Left and right
/// of an object are mirror images: an interval holds both, a cell one of them.
struct Intervals {
  std::vector<double> range_edges;  ///< m, ascending, at least two
  int sectors = 1;                  ///< of |angle| in [0, π]; 1: the angle does not matter

  [[nodiscard]] int ranges() const { return static_cast<int>(range_edges.size()) - 1; }
  [[nodiscard]] int size() const { return ranges() * sectors; }
  [[nodiscard]] int index(int range, int sector) const { return range * sectors + sector; }

  [[nodiscard]] double range_centre(int range) const;    ///< m
  [[nodiscard]] double sector_centre(int sector) const;  ///< rad

  /// The interval of a view; of a range beyond the edges, the nearest one.
  [[nodiscard]] int of(const View& view) const;
  /// The interval and its side.
  [[nodiscard]] int cell_of(const View& view) const {
    return 2 * of(view) + (mirrored(view) ? 1 : 0);
  }
  /// Seen from the right, where the angle matters.
  [[nodiscard]] bool mirrored(const View& view) const { return sectors > 1 && view.angle < 0; }
  [[nodiscard]] bool contains(double range) const {
    return range >= range_edges.front() && range <= range_edges.back();
  }
};

}  // namespace saker::uncertainty
