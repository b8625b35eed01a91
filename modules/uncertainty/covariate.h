#pragma once

#include <string>
#include <vector>

#include "saker/uncertainty/view.h"

namespace saker::uncertainty {

/// An input beside range and angle.
enum class Covariate { elevation, reflectivity };

/// Names in the order of the values: what model files say.
[[nodiscard]] inline std::vector<std::string> enum_names(Covariate) {
  return {"elevation", "reflectivity"};
}

/// rad or as the sensor says it; NaN where it is unknown.
[[nodiscard]] inline double value_of(const View& view, Covariate covariate) {
  return covariate == Covariate::elevation ? view.elevation : view.reflectivity;
}

/// (value − mean) / spread, within what was flown; 0 where the value is unknown, so that it is
/// averaged over.
[[nodiscard]] double standardised(double value, double mean, double spread);

}  // namespace saker::uncertainty
