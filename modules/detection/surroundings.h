#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "saker/core/config.h"
#include "saker/detection/ground.h"
#include "saker/objects/models.h"

/// The points of no object in and around an object. A wall's corner, a fence post and the edge of a
/// hedge look like a trunk or pole in a range image, but belong to something that goes on beside
/// them; a trunk or pole stands free between its foot and its crown, and only a trunk has one. What
/// lies inside a model speaks against it: a patch of a bush that was taken for a vehicle.
namespace saker::detection {

struct SurroundingsConfig {
  double lowest_m = 0.3;
  double highest_m = 1.8;
  double gap_m = 0.1;
  double width_m = 0.5;
  double most_share = 1.0;
  double crown_reach_m = 1.5;
  double crown_highest_m = 8;
  double bare_share = 0.5;
  double leafy_share = 1.0;
  double bare_odds = 30;
  double leafy_odds = 2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("lowest_m", lowest_m, {0, 5}, "m", "above the ground: grass grows below");
    v.field("highest_m", highest_m, {0.2, 10}, "m", "crowns begin above");
    v.field("gap_m", gap_m, {0, 2}, "m",
            "from the surface outwards that belongs to the object: noise and mixed returns");
    v.field("width_m", width_m, {0.05, 3}, "m", "of the ring around it that should be empty");
    v.field("most_share", most_share, {0, 100}, "",
            "points of no object in the ring, relative to the object's own between these heights; "
            "more is part of a "
            "wall, fence or hedge");
    v.field("crown_reach_m", crown_reach_m, {0.1, 10}, "m", "from the axis: what counts as crown");
    v.field("crown_highest_m", crown_highest_m, {2, 50}, "m", "above the ground: its upper end");
    v.field("bare_share", bare_share, {0, 100}, "",
            "points of the crown relative to the object's own, below which there is none: 3 in 4 "
            "poles, 1 in 50 trees");
    v.field("leafy_share", leafy_share, {0, 100}, "",
            "above which there is one: 1 in 5 poles (a tree's beside it), 19 in 20 trees");
    v.field("bare_odds", bare_odds, {1, 1000}, "",
            "for a class without a crown where there is none");
    v.field("leafy_odds", leafy_odds, {1, 1000}, "",
            "for a class with a crown where there is one: little, the network has seen it too");
  }
};

/// A grid over the points of no object between the two heights. Keeps its memory between calls.
class Surroundings {
 public:
  explicit Surroundings(const SurroundingsConfig& config) : config_(config) {}

  /// \param stride  every which point of the scans `others` holds
  void fill(std::span<const Eigen::Vector3f> others, int stride, const Ground& ground);

  /// Points (of all, not of every stride-th) in the ring around a cylinder with its foot there.
  [[nodiscard]] int around(const Eigen::Vector2f& foot, double radius) const;

  /// The same inside a model, given in the frame of the points.
  [[nodiscard]] int inside(const objects::Cylinder& cylinder) const;
  [[nodiscard]] int inside(const objects::Cuboid& cuboid) const;

  /// Odds for a class with a crown against one without, by what stands around the upper part.
  /// \param own  points of the object itself
  [[nodiscard]] double crown_odds(const objects::Cylinder& cylinder, int own) const;

 private:
  struct Cell {
    std::int64_t key;
    Eigen::Vector2f place;
    float height;  ///< above the ground
  };
  [[nodiscard]] static std::int64_t key(int x, int y);
  [[nodiscard]] int cell_of(float v) const;
  /// Points within the square of half side `reach` for which `counts` holds.
  template <class Predicate>
  [[nodiscard]] int count_if(const Eigen::Vector2f& middle, float reach, Predicate counts) const;
  /// Of these the ones between the two heights where a trunk or pole stands free.
  template <class Predicate>
  [[nodiscard]] int count_low(const Eigen::Vector2f& middle, float reach, Predicate counts) const;

  SurroundingsConfig config_;
  int stride_ = 1;
  std::vector<Cell> cells_;  ///< one a point, ascending key
};

}  // namespace saker::detection
