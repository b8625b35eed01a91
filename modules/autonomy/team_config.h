#pragma once

#include <optional>
#include <vector>

#include "saker/core/config.h"
#include "saker/slam/trajectory.h"

namespace saker::autonomy {

/// How well take-off poses are known.
struct SurveyConfig {
  double place_sd_m = 0.1;
  double heading_sd_deg = 1;
  double level_sd_deg = 0.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("place_sd_m", place_sd_m, {0.001, 10}, "m",
              "The take-off place was measured with this standard deviation along each axis.");
    v.setting("heading_sd_deg", heading_sd_deg, {0.01, 45}, "°",
              "The heading was set with this standard deviation.");
    v.setting("level_sd_deg", level_sd_deg, {0.01, 10}, "°",
              "The level was measured with this standard deviation.");
  }
};

/// Of a surveyed pose: [rotation, translation], right tangent.
[[nodiscard]] Matrix6d covariance_of(const SurveyConfig& config);

/// Where a robot takes off in `base`, the team's frame.
struct TakeoffConfig {
  std::vector<double> position_m;
  double yaw_deg = 0;
  SurveyConfig survey;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("position_m", position_m, {-1e5, 1e5}, "m",
              "Body at take-off in base, the team's frame: x, y, z; empty: not measured, what "
              "others mapped is not planned with.");
    v.setting("yaw_deg", yaw_deg, {-360, 360}, "°",
              "Heading of the body there, from base's x axis.");
    survey.visit(v);
  }
};

/// T_base_world; nothing where nobody measured it. Throws Error where the place is no point.
[[nodiscard]] std::optional<slam::PosePrior> takeoff_pose(const TakeoffConfig& config);

/// What a robot needs to make use of what others mapped.
struct TeamConfig {
  TakeoffConfig takeoff;
  std::vector<double> lot_m;
  double known_gate_m = 3;
  double merge_s = 20;

  template <class Visitor>
  void visit(Visitor& v) {
    v.group("takeoff", takeoff, "where this robot takes off");
    v.setting("lot_m", lot_m, {-1e5, 1e5}, "m",
              "Corners x1, y1, x2, y2, … in base of what this robot covers; empty: everything.");
    v.field("known_gate_m", known_gate_m, {0.1, 50}, "m",
            "between what was said of an object beforehand and what robots mapped: three "
            "deviations of a prior of 1 m");
    v.field("merge_s", merge_s, {0.1, 300}, "s",
            "for merging what was heard, before take-off and again after landing: twenty flights "
            "of two minutes; what does not fit in is left out, and said");
  }
};

}  // namespace saker::autonomy
