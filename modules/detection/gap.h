#pragma once

#include "saker/core/config.h"
#include "saker/detection/vehicle_fitter.h"

namespace saker::detection {

/// The space that a vehicle fills: what beams go through is more than one.
struct GapConfig {
  double inset_m = 0.35;
  double lowest_m = 0.35;
  double highest_m = 0.75;
  double side_inset_m = 0.15;
  double side_depth_m = 0.2;
  double side_share = 0.4;
  double strip_m = 0.25;
  double outside_m = 0.65;
  double least_length_m = 3.6;
  int beams = 4;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("inset_m", inset_m, {0, 2}, "m",
            "from the plan's edges: rounded corners and a heading that is off");
    v.field("side_inset_m", side_inset_m, {0, 2}, "m",
            "from a side that was looked at, where what lies behind it was not seen: its noise");
    v.field("side_depth_m", side_depth_m, {0.01, 2}, "m",
            "from there: as deep as beams come aslant between two vehicles half a metre apart");
    v.field("side_share", side_share, {0.01, 1}, "",
            "of the length, in its middle, where such is looked for: between the wheel arches");
    v.field("strip_m", strip_m, {0.05, 2}, "m",
            "of a side, on which nothing was met, where beams go on behind it: half of the least "
            "gap between parked vehicles");
    v.field("lowest_m", lowest_m, {0, 2}, "m", "above the ground: higher than beams pass below");
    v.field("highest_m", highest_m, {0.1, 3}, "m", "above the ground: lower than windows");
    v.field("outside_m", outside_m, {0, 20}, "m",
            "that a sensor is outside of a side's plane: it looks at the side");
    v.field("least_length_m", least_length_m, {0, 20}, "m",
            "of a side behind which beams are looked for: the widths of two cars");
    v.field("beams", beams, {1, 1000}, "", "that make sure; of those kept (window.beam_stride)");
  }
};

/// Whether beams went through what a vehicle fills: its inner part, or what lies just behind the
/// middle of a side that was looked at, where two that stand beside each other show their ends and
/// nothing of their depth.
/// \param outline  of its points, the length first
[[nodiscard]] bool parted(const Plan& outline, const Sight& sight, const GapConfig& config);

}  // namespace saker::detection
