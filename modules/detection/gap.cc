#include "saker/detection/gap.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

/// Lower than its windows.
objects::Cuboid inner_part(const Plan& r, const GapConfig& gap) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(gap.inset_m);
  return upright(r.heading,
                 {Eigen::Vector2d(r.axis[0].low, r.axis[1].low) + margin,
                  Eigen::Vector2d(r.axis[0].high, r.axis[1].high) - margin},
                 {gap.lowest_m, gap.highest_m});
}

/// What beams through windows end in: seats, doors.
objects::Cuboid body(const Plan& r, const GapConfig& gap) {
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(gap.side_inset_m);
  constexpr double kTop = 4;  // m
  return upright(r.heading,
                 {Eigen::Vector2d(r.axis[0].low, r.axis[1].low) - margin,
                  Eigen::Vector2d(r.axis[0].high, r.axis[1].high) + margin},
                 {0.5 * gap.lowest_m, kTop});
}

/// Upright along the low or the high side, between distances inward from it and along its middle.
objects::Cuboid along_side(const Plan& r, int side, const Eigen::Vector2d& inward,
                           const Eigen::Vector2d& along, const GapConfig& gap) {
  const double middle = r.axis[0].centre();
  const Eigen::Vector2d across =
      side == 0 ? Eigen::Vector2d(r.axis[1].low + inward[0], r.axis[1].low + inward[1])
                : Eigen::Vector2d(r.axis[1].high - inward[1], r.axis[1].high - inward[0]);
  return upright(r.heading,
                 {Eigen::Vector2d(middle + along[0], across[0]), {middle + along[1], across[1]}},
                 {gap.lowest_m, gap.highest_m});
}

/// Whether somewhere in its middle nothing was met on a side, but beams went on behind it.
bool open(const Plan& r, int side, const Sight& sight, const GapConfig& gap) {
  const Eigen::Vector2d face(-gap.side_inset_m, gap.side_inset_m);
  const Eigen::Vector2d behind(gap.side_inset_m, gap.side_inset_m + gap.side_depth_m);
  const objects::Cuboid whole = body(r, gap);
  const double half = 0.5 * gap.side_share * r.axis[0].size();
  const auto enter = [&](const Eigen::Vector2d& along) {
    return sight.through(along_side(r, side, behind, along, gap), whole) >= gap.beams;
  };
  if (!enter({-half, half})) return false;
  for (double at = -half; at + gap.strip_m <= half; at += 0.5 * gap.strip_m) {
    const Eigen::Vector2d strip(at, at + gap.strip_m);
    const objects::Cuboid at_face = along_side(r, side, face, strip, gap);
    const bool met = sight.ended(at_face) > 0;
    if (!met && sight.through(at_face, whole) >= gap.beams && enter(strip)) return true;
  }
  return false;
}

bool looked_at(const Plan& r, int side, const Sight& sight, const GapConfig& gap) {
  const Eigen::Vector2d left(-std::sin(r.heading), std::cos(r.heading));
  return std::ranges::any_of(sight.sensors, [&](const Eigen::Vector3d& sensor) {
    const double at = left.dot(sensor.head<2>());
    return (side == 0 ? r.axis[1].low - at : at - r.axis[1].high) > gap.outside_m;
  });
}

}  // namespace

bool parted(const Plan& outline, const Sight& sight, const GapConfig& config) {
  if (sight.through(inner_part(outline, config), body(outline, config)) >= config.beams)
    return true;
  if (outline.axis[0].size() < config.least_length_m) return false;
  for (int side = 0; side < 2; ++side) {
    if (looked_at(outline, side, sight, config) && open(outline, side, sight, config)) return true;
  }
  return false;
}

}  // namespace saker::detection
