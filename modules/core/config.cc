#include "saker/core/config.h"

#include <fmt/format.h>

#include "saker/core/error.h"

namespace saker::core {

void BoundsCheck::check(const char* name, double value, Bounds bounds) const {
  if (value >= bounds.low && value <= bounds.high) return;
  throw Error(
      fmt::format("{}{}: {}, expected {} … {}", prefix_, name, value, bounds.low, bounds.high));
}

}  // namespace saker::core
