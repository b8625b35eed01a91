#pragma once

#include "saker/core/config.h"
#include "saker/slam/hidden_ends.h"
#include "saker/slam/landmark.h"

namespace saker::slam {

struct GraphConfig {
  int iterations = 4;
  double function_tolerance = 1e-5;
  double trust_radius = 1e4;
  double robust_scale = 3;
  HiddenEndConfig hidden_ends;
  LengthAxisConfig length_axis;
  int movable_keyframes = 600;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("iterations", iterations, {0, 1000}, "",
            "most Levenberg-Marquardt steps a cycle; the start is the last cycle's estimate");
    v.field("function_tolerance", function_tolerance, {0, 1}, "",
            "relative decrease of the cost at which a cycle ends");
    v.field(
        "trust_radius", trust_radius, {1, 1e12}, "",
        "a parameter's own curvature over this damps a cycle's first step: what bends the whole "
        "flight waits for the next cycles");
    v.field(
        "robust_scale", robust_scale, {0.1, 1000}, "",
        "Cauchy's scale on whitened errors of objects: half weight at 9, the mean of nine degrees "
        "of freedom; parts taken for wholes, far from where covariances hold, weigh little");
    v.group("hidden_ends", hidden_ends, "ends of vehicles that were hidden");
    v.group("length_axis", length_axis, "windows that took a side for the length are left out");
    v.field("movable_keyframes", movable_keyframes, {1, 100000}, "",
            "the newest so many move; older ones are held where they are: what a cycle costs does "
            "not grow for ever. Ten minutes at 1 m/s");
  }
};

}  // namespace saker::slam
