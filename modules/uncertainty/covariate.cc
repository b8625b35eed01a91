#include "saker/uncertainty/covariate.h"

#include <algorithm>
#include <cmath>

namespace saker::uncertainty {

double standardised(double value, double mean, double spread) {
  constexpr double kMost = 2.5;  // spreads: beyond, there are hardly any data
  if (!std::isfinite(value) || !(spread > 0)) return 0;
  return std::clamp((value - mean) / spread, -kMost, kMost);
}

}  // namespace saker::uncertainty
