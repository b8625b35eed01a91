#pragma once

#include "saker/core/config.h"
#include "saker/detection/vehicle_fitter.h"

namespace saker::detection {

struct HullConfig {
  double low_percentile = 5;
  double high_percentile = 95;
  double edge_m = 0.04;
  double edge_per_m = 0.003;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("low_percentile", low_percentile, {0, 49}, "%",
            "of the hull's vertices along an axis: the lower edge (paper: 5)");
    v.field("high_percentile", high_percentile, {51, 100}, "%",
            "of the hull's vertices along an axis: the upper edge (paper: 95)");
    v.field("edge_m", edge_m, {0.001, 2}, "m", "standard deviation of an edge");
    v.field("edge_per_m", edge_per_m, {0, 0.1}, "m/m", "more of it by range");
  }
};

/// The paper's (IV-A): the first principal component of the convex hull's vertices is the length's
/// direction, percentiles over these vertices are the edges, whatever of the vehicle was seen.
class HullFitter final : public VehicleFitter {
 public:
  explicit HullFitter(const HullConfig& config) : config_(config) {}
  [[nodiscard]] Plan outline(const VehicleView& view) const override;
  [[nodiscard]] Plan fit(const VehicleView& view, const Plan& outline) const override;

 private:
  HullConfig config_;
};

}  // namespace saker::detection
