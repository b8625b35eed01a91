#pragma once

#include "core/config.h"
#include "slam/model_algebra.h"

namespace saker::slam {

struct MeasurementNoiseConfig {
  double covariance_scale = 2;
  double lean_deg = 3;
  double roof_m = 0.3;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field(
        "covariance_scale", covariance_scale, {1, 100}, "",
        "windows of 1 s twice a second share half of their points: two of them say as much as one");
    v.field(
        "lean_deg", lean_deg, {0, 45}, "degree",
        "sd of a measured axis about the middle of what was seen: trunks taper and bend, so that "
        "each side leans its own way");
    v.field("roof_m", roof_m, {0, 5}, "m",
            "sd of a vehicle's top over its bottom: from afar the roof is not seen");
  }
};

/// A measurement with the errors that a fit to one window cannot see, for they are the same in
/// every window from one side. Taken for independent and small, they turn the robot: landmarks hand
/// the tilt on from one to the next (measured on flights: 0.4° and 0.5 m of height in 70 m).
///
/// A cylinder's axis turns about the middle of the part that was seen, so that its root moves with
/// it. A vehicle's height takes half of itself along to the centre; the bottom stays.
///
/// \param fitted the covariance is that of a fitted model, whose windows share their view cell:
/// then nothing is scaled, and an axis leans without its root, whose whole error the model knows.
[[nodiscard]] Gaussian with_common_errors(const Gaussian& measured,
                                          const MeasurementNoiseConfig& config,
                                          bool fitted = false);

}  // namespace saker::slam
