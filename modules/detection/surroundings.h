#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/config.h"
#include "detection/ground.h"

/// What stands around a trunk or a pole. A wall's corner, a fence post and the edge of a hedge look
/// like one in a range image, but belong to something that goes on beside them; a trunk or pole
/// stands free between its foot and its crown.
namespace saker::detection {

struct SurroundingsConfig {
  double lowest_m = 0.3;
  double highest_m = 1.8;
  double gap_m = 0.1;
  double width_m = 0.5;
  double most_share = 1.0;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("lowest_m", lowest_m, {0, 5}, "m", "above the ground: grass grows below");
    v.field("highest_m", highest_m, {0.2, 10}, "m", "crowns begin above");
    v.field("gap_m", gap_m, {0, 2}, "m",
            "from the surface outwards that is not looked at: noise and mixed returns");
    v.field("width_m", width_m, {0.05, 3}, "m", "of the ring around it that should be empty");
    v.field("most_share", most_share, {0, 100}, "",
            "points of no object in the ring, relative to the object's own between these heights; "
            "more is part of a "
            "wall, fence or hedge");
  }
};

/// A grid over the points of no object between the two heights. Keeps its memory between calls.
class Surroundings {
 public:
  explicit Surroundings(const SurroundingsConfig& config) : config_(config) {}

  /// \param stride  every which point of the scans `others` holds
  void fill(std::span<const Eigen::Vector3f> others, int stride, const Ground& ground);

  /// Points (of all, not of every stride-th) in the ring around a cylinder with its foot there.
  [[nodiscard]] int count(const Eigen::Vector2f& foot, double radius) const;

 private:
  struct Cell {
    std::int64_t key;
    Eigen::Vector2f place;
  };
  [[nodiscard]] static std::int64_t key(int x, int y);
  [[nodiscard]] int cell_of(float v) const;

  SurroundingsConfig config_;
  int stride_ = 1;
  std::vector<Cell> cells_;  ///< one a point, ascending key
};

}  // namespace saker::detection
