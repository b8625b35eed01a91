#include "saker/active/views/sides.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace saker::active {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kRounding = 1e-9;  // rad: sides just as far apart as asked for are apart

}  // namespace

bool Sides::add(double bearing, double seconds) {
  const int bins = static_cast<int>(dwell_s_.size());
  const int nearest = static_cast<int>(std::lround(bearing / kTurn * bins));
  const int bin = (nearest % bins + bins) % bins;
  dwell_s_[bin] += seconds;
  const double middle = kTurn * bin / bins;
  if (dwell_s_[bin] < least_dwell_s_ || !apart(middle)) return false;
  sides_.push_back(middle);
  return true;
}

bool Sides::apart(double bearing) const {
  return std::all_of(sides_.begin(), sides_.end(), [&](double side) {
    return std::abs(std::remainder(bearing - side, kTurn)) >= separation_ - kRounding;
  });
}

}  // namespace saker::active
